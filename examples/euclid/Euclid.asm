/* The greatest common divisor in three ways that have to agree: a machine that takes a step for each
   division, a turbo rule with local state and a loop, and a recursive turbo rule. */
asm Euclid

import ../../library/std/StandardLibrary
import ../../library/std/CTLLibrary

signature:
	domain Operand subsetof Integer

	static divides: Prod(Integer, Integer) -> Boolean

	controlled larger: Integer
	controlled smaller: Integer
	controlled byLoop: Integer
	controlled byRecursion: Integer
	controlled commonDivisors: Powerset(Integer)

	derived finished: Boolean

definitions:
	domain Operand = {1 : 120}

	function divides($d in Integer, $n in Integer) = $n mod $d = 0

	function finished = smaller = 0

	turbo rule r_gcdLoop($a in Integer, $b in Integer) in Integer =
		local u: Integer [u := $a]
		local v: Integer [v := $b]
		seq
			while v != 0 do
				par
					u := v
					v := u mod v
				endpar
			result := u
		endseq

	turbo rule r_gcdRecursive($a in Integer, $b in Integer) in Integer =
		if $b = 0 then
			result := $a
		else
			result <- r_gcdRecursive($b, $a mod $b)
		endif

	// a step keeps the common divisors, so the last non-zero operand is the greatest of them
	invariant inv_divisors over larger, smaller:
		eq(commonDivisors, {$d in Operand | divides($d, larger) and divides($d, smaller) : $d})
	invariant inv_agree over byLoop, byRecursion: byLoop = byRecursion
	invariant inv_result over larger: not finished or larger = byLoop

	// it comes to an end, and 12 is the result
	CTLSPEC ctlSpec_ends: af(finished and larger = 12 and byLoop = 12)

	main rule r_Main =
		if not finished then
			par
				larger := smaller
				smaller := larger mod smaller
				seq
					byLoop <- r_gcdLoop(larger, smaller)
					byRecursion <- r_gcdRecursive(larger, smaller)
				endseq
			endpar
		endif

default init s0:
	function larger = 84
	function smaller = 120
	// not computed yet
	function byLoop = 0
	function byRecursion = 0
	function commonDivisors = {1, 2, 3, 4, 6, 12}
