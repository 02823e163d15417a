/* The sieve of Eratosthenes on sets: a step takes the smallest candidate, which is prime, and strikes
   out its multiples. */
asm Sieve

import ../../library/std/StandardLibrary
import ../../library/std/CTLLibrary

signature:
	static limit: Integer
	controlled candidates: Powerset(Integer)
	controlled primes: Powerset(Integer)
	derived smallest: Integer
	derived isPrime: Integer -> Boolean

definitions:
	function limit = 100

	function smallest =
		chooseone({$n in candidates | (forall $m in candidates with $n <= $m) : $n})

	// the definition of a prime, to compare the sieve with
	function isPrime($n in Integer) =
		not (exists $d in {2 : 10} with $d < $n and $n mod $d = 0) and contains(union(candidates, primes), $n)

	invariant inv_disjoint over candidates, primes: isEmpty(intersection(candidates, primes))
	invariant inv_primes over primes: (forall $p in primes with isPrime($p))

	// the sieve gets empty, and all 25 primes are found
	CTLSPEC ctlSpec_ends: af(isEmpty(candidates) and size(primes) = 25)
	CTLSPEC ctlSpec_begins: isEmpty(primes) and size(candidates) = 99

	main rule r_Main =
		if notEmpty(candidates) then
			let ($p = smallest) in
				par
					primes := including(primes, $p)
					candidates := {$n in candidates | $n mod $p != 0 : $n}
				endpar
			endlet
		endif

default init s0:
	function candidates = {2 : 100}
	function primes = {}
