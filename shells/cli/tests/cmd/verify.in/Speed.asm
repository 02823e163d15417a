asm Speed

import StandardLibrary

signature:
	domain Level subsetof Integer
	monitored wanted: Level
	controlled speed: Level

definitions:
	domain Level = {0 : 3}

	main rule r_Main =
		speed := wanted

default init s0:
	function speed = 0
