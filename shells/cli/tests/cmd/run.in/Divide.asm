asm Divide

import StandardLibrary

signature:
	controlled x: Integer

definitions:
	rule r_divide($n in Integer) = x := idiv(6, $n)

	main rule r_Main = r_divide[x - 3]

default init s0:
	function x = 3
