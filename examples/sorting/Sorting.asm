/* Sorting in place: as long as two items are in the wrong order, some such pair is exchanged. Which
   pair is left open; the exchange needs no third location, since both updates see the old state. */
asm Sorting

import ../../library/std/StandardLibrary

signature:
	domain Position subsetof Integer

	controlled item: Position -> Integer
	controlled exchanges: Integer

	derived inversions: Integer
	derived sorted: Boolean

definitions:
	domain Position = {1 : 12}

	function inversions =
		size({$p in Position, $q in Position | $p < $q and item($p) > item($q) : ($p, $q)})

	function sorted =
		(forall $p in Position with $p = 12 or item($p) <= item(min($p + 1, 12)))

	// the items are always the same ones: nothing is lost, nothing is doubled
	invariant inv_permutation over item: eq({$p in Position : item($p)}, {1 : 12})
	invariant inv_sorted over item: sorted iff inversions = 0
	// an exchange of two items removes at least one inversion of the 66 there can be
	invariant inv_terminates over exchanges: exchanges + inversions <= 66

	main rule r_Main =
		choose $p in Position, $q in Position with $p < $q and item($p) > item($q) do
			par
				item($p) := item($q)
				item($q) := item($p)
				exchanges := exchanges + 1
			endpar

default init s0:
	function exchanges = 0
	function item($p in Position) = ($p * 5) mod 13
