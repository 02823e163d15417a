asm Clash

import StandardLibrary

signature:
	controlled x: Integer

definitions:
	main rule r_Main =
		par
			if x > 1 then x := 0 endif
			x := x + 1
		endpar

default init s0:
	function x = 0
