asm Peak

import StandardLibrary

signature:
	monitored reading: Integer
	controlled peak: Integer

definitions:
	main rule r_Main = peak := max(peak, reading)

default init s0:
	function peak = 0
