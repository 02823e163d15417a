asm Far

import StandardLibrary

signature:
	enum domain Light = {RED, GREEN}
	monitored level: Integer
	controlled light: Light

definitions:
	rule r_far = light := GREEN
	main rule r_main = if level > 100 then r_far[] endif

default init s0:
	function light = RED
