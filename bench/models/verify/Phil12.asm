/* Philosophers who take first their left fork, then their right one, and put them back one by one: one deadlock.
   A step is one move of one philosopher, chosen. */
asm Phil12

import ../../../library/std/StandardLibrary

signature:
	domain Philosopher subsetof Integer
	domain Place subsetof Integer

	controlled place: Philosopher -> Place
	controlled taken: Philosopher -> Boolean

	static right: Philosopher -> Philosopher

definitions:
	domain Philosopher = {0 : 11}
	domain Place = {0 : 3}

	function right($p in Philosopher) = ($p + 1) mod 12

	rule r_Move($p in Philosopher) =
		switch place($p)
			case 0:
				if not taken($p) then
					par
						taken($p) := true
						place($p) := 1
					endpar
				endif
			case 1:
				if not taken(right($p)) then
					par
						taken(right($p)) := true
						place($p) := 2
					endpar
				endif
			case 2:
				par
					taken($p) := false
					place($p) := 3
				endpar
			case 3:
				par
					taken(right($p)) := false
					place($p) := 0
				endpar
		endswitch

	invariant inv_exclusion over place: (forall $p in Philosopher with not (place($p) = 2 and place(right($p)) = 2))

	main rule r_Main =
		choose $p in Philosopher with true do r_Move[$p]

default init s0:
	function place($p in Philosopher) = 0
	function taken($p in Philosopher) = false
