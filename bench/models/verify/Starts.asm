/* Many initial states, and no step: 7 to the 6th = 117 649, each choice of six amounts. */
asm Starts

import ../../../library/std/StandardLibrary

signature:
	domain Place subsetof Integer
	domain Amount subsetof Integer

	controlled amount: Place -> Amount

definitions:
	domain Place = {1 : 6}
	domain Amount = {0 : 6}

	main rule r_Main = skip

default init s0:
	function amount($p in Place) = chooseone(Amount)
