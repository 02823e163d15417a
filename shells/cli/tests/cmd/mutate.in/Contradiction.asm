/* No state satisfies what it assumes: nothing can be judged by it. */
asm Contradiction

import StandardLibrary

signature:
	domain Level subsetof Integer
	controlled level: Level

definitions:
	domain Level = {0 : 3}

	INVAR level > 2

	invariant inv_level over level: level <= 3

	main rule r_Main = level := (level + 1) mod 4

default init s0:
	function level = 0
