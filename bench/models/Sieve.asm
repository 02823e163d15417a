/* The sieve of Eratosthenes over 10 000 numbers, a candidate a step, beside 10 000 counters that all move on in every
   step. The twin of ../native/sieve.cpp, step by step. */
asm Sieve

import ../../library/std/StandardLibrary

signature:
	domain Index subsetof Integer
	domain Number subsetof Integer
	domain Factor subsetof Integer

	controlled x: Index -> Integer
	controlled composite: Number -> Boolean
	controlled p: Integer

definitions:
	domain Index = {0 : 9999}
	domain Number = {0 : 10000}
	domain Factor = {2 : 5000}

	main rule r_Main =
		par
			forall $i in Index with true do
				x($i) := (x($i) * 75 + 74) mod 65537
			if p <= 10000 then
				if not composite(p) then
					forall $k in Factor with p * $k <= 10000 do
						composite(p * $k) := true
				endif
			endif
			p := p + 1
		endpar

default init s0:
	function x($i in Index) = $i
	function composite($n in Number) = false
	function p = 2
