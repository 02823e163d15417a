asm Walkers

import StandardLibrary

signature:
	enum domain Walker = {ANN | BOB | CIM}
	domain Place subsetof Integer
	controlled place: Walker -> Place
	controlled meets: Boolean

definitions:
	domain Place = {0 : 4}

	invariant inv_apart over meets: not meets

	main rule r_Main =
		choose $w in Walker with place($w) < 4 do
			par
				place($w) := place($w) + 1
				if $w = CIM and place(CIM) = 3 then
					meets := true
				endif
			endpar

default init s0:
	function place($w in Walker) = 0
	function meets = false
