asm Blink

import StandardLibrary

signature:
	enum domain Doing = { REST | SHINE | WAIT_FOR_LAMP }
	abstract domain Button
	static left: Button
	static right: Button
	controlled clock: Integer
	derived doing: Button -> Doing
	derived done: Button -> Integer

definitions:
	function doing($b in Button) =
		if $b = left then (if clock mod 4 < 2 then SHINE else REST endif)
		else
			switch clock mod 4
				case 1: WAIT_FOR_LAMP
				case 2: SHINE
				otherwise REST
			endswitch
		endif
	function done($b in Button) = idiv(clock + 1, 4)

	invariant inv_alone over clock: not (doing(left) = SHINE and doing(right) = SHINE)

	main rule r_Main = clock := clock + 1

default init s0:
	function clock = 0
