/* The towers of Hanoi: a recursive turbo rule moves the whole tower in one step of the machine, though
   it consists of 2^n - 1 moves one after the other. */
asm Hanoi

import ../../library/std/StandardLibrary

signature:
	enum domain Peg = {LEFT | CENTRE | RIGHT}

	monitored target: Peg
	controlled place: Peg
	controlled discs: Peg -> Seq(Integer)
	controlled moves: Integer

	static thirdPeg: Prod(Peg, Peg) -> Peg
	derived ordered: Peg -> Boolean

definitions:
	function thirdPeg($a in Peg, $b in Peg) =
		chooseone({$p in Peg | $p != $a and $p != $b : $p})

	// smaller discs lie on larger ones; the first one is on top
	function ordered($p in Peg) =
		(forall $d in asSet(discs($p)), $e in asSet(discs($p)) with
			$d = $e or ($d < $e iff indexOf(discs($p), $d) < indexOf(discs($p), $e)))

	rule r_moveDisc($a in Peg, $b in Peg) =
		par
			discs($b) := prepend(first(discs($a)), discs($b))
			discs($a) := tail(discs($a))
			moves := moves + 1
		endpar

	turbo rule r_moveTower($n in Integer, $a in Peg, $b in Peg) =
		if $n > 0 then
			seq
				r_moveTower($n - 1, $a, thirdPeg($a, $b))
				r_moveDisc[$a, $b]
				r_moveTower($n - 1, thirdPeg($a, $b), $b)
			endseq
		endif

	invariant inv_ordered over discs: (forall $p in Peg with ordered($p))
	invariant inv_tower over discs: length(discs(place)) = 6

	main rule r_Main =
		if target != place then
			par
				r_moveTower(length(discs(place)), place, target)
				place := target
			endpar
		endif

default init s0:
	function place = LEFT
	function moves = 0
	function discs($p in Peg) = if $p = LEFT then [1, 2, 3, 4, 5, 6] else [] endif
