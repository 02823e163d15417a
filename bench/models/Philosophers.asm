/* Five philosophers, one chosen a step: a hungry one takes both forks if both are free, an eating one puts them back,
   a sated one becomes hungry again. The twin of ../native/philosophers.cpp, step by step. */
asm Philosophers

import ../../library/std/StandardLibrary

signature:
	domain Philosopher subsetof Integer

	// fork i lies between philosopher i-1 and philosopher i
	controlled owner: Philosopher -> Philosopher
	controlled eating: Philosopher -> Boolean
	controlled hungry: Philosopher -> Boolean
	controlled meals: Integer
	controlled steps: Integer

definitions:
	domain Philosopher = {0 : 4}

	main rule r_Main =
		par
			choose $p in Philosopher with true do
				let ($right = ($p + 1) mod 5) in
					par
						if hungry($p) and not eating($p) and isUndef(owner($p)) and isUndef(owner($right)) then
							par
								owner($p) := $p
								owner($right) := $p
								eating($p) := true
								meals := meals + 1
							endpar
						endif
						if eating($p) then
							par
								owner($p) := undef
								owner($right) := undef
								eating($p) := false
								hungry($p) := false
							endpar
						endif
						if not hungry($p) and not eating($p) then
							hungry($p) := true
						endif
					endpar
				endlet
			steps := steps + 1
		endpar

default init s0:
	function eating($p in Philosopher) = false
	function hungry($p in Philosopher) = true
	function meals = 0
	function steps = 0
