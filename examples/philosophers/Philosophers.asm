/* Five dining philosophers, each an agent with its own program. A philosopher takes both forks in one
   step or none, so nobody waits with a single fork in hand; one philosopher moves at a time. */
asm Philosophers

import ../../library/std/StandardLibrary
import ../../library/std/CTLLibrary
import ../../library/std/LTLLibrary

signature:
	domain Philosopher subsetof Agent
	abstract domain Fork

	static aristotle: Philosopher
	static plato: Philosopher
	static hypatia: Philosopher
	static kant: Philosopher
	static arendt: Philosopher
	static fork1: Fork
	static fork2: Fork
	static fork3: Fork
	static fork4: Fork
	static fork5: Fork

	static leftFork: Philosopher -> Fork
	static rightFork: Philosopher -> Fork

	monitored hungry: Philosopher -> Boolean
	controlled owner: Fork -> Philosopher
	controlled meals: Philosopher -> Integer

	derived eating: Philosopher -> Boolean
	derived canEat: Philosopher -> Boolean

definitions:
	function leftFork($p in Philosopher) =
		switch $p
			case aristotle: fork1
			case plato: fork2
			case hypatia: fork3
			case kant: fork4
			case arendt: fork5
		endswitch

	function rightFork($p in Philosopher) =
		switch $p
			case aristotle: fork2
			case plato: fork3
			case hypatia: fork4
			case kant: fork5
			case arendt: fork1
		endswitch

	function eating($p in Philosopher) =
		owner(leftFork($p)) = $p and owner(rightFork($p)) = $p

	function canEat($p in Philosopher) =
		isUndef(owner(leftFork($p))) and isUndef(owner(rightFork($p)))

	rule r_takeForks($p in Philosopher) =
		par
			owner(leftFork($p)) := $p
			owner(rightFork($p)) := $p
			meals($p) := meals($p) + 1
		endpar

	rule r_dropForks($p in Philosopher) =
		par
			owner(leftFork($p)) := undef
			owner(rightFork($p)) := undef
		endpar

	rule r_live =
		if eating(self) then
			if not hungry(self) then r_dropForks[self] endif
		else
			if hungry(self) and canEat(self) then r_takeForks[self] endif
		endif

	// neighbours share a fork
	invariant inv_neighbours over owner:
		not (exists $p in Philosopher, $q in Philosopher with
			$p != $q and eating($p) and eating($q) and rightFork($p) = leftFork($q))
	// nobody holds a single fork
	invariant inv_bothOrNone over owner:
		(forall $p in Philosopher with (owner(leftFork($p)) = $p) iff (owner(rightFork($p)) = $p))

	// each fork lies on the left of one philosopher and on the right of another one
	invariant inv_table over owner:
		(forall $f in Fork with
			(exist unique $p in Philosopher with leftFork($p) = $f)
			and (exist unique $q in Philosopher with rightFork($q) = $f))
		and (forall $p in Philosopher with leftFork($p) != rightFork($p))

	// nobody eats at first; who is hungry can take the forks if both are free, who is not can put them back
	LTLSPEC ltlSpec_begins: (forall $p in Philosopher with not eating($p) and meals($p) = 0)
	CTLSPEC ctlSpec_takes: (forall $p in Philosopher with ag(hungry($p) and canEat($p) implies ex(eating($p))))
	CTLSPEC ctlSpec_drops: (forall $p in Philosopher with ag(eating($p) and not hungry($p) implies ex(canEat($p))))
	LTLSPEC ltlSpec_hungry:
		(forall $p in Philosopher with g(eating($p) and not y(eating($p)) implies y(hungry($p) and canEat($p))))
	LTLSPEC ltlSpec_goesOn: (forall $p in Philosopher with g(y(eating($p) and hungry($p)) implies eating($p)))
	// each meal is counted once
	LTLSPEC ltlSpec_meals:
		(forall $p in Philosopher, $n in {0 : 1} with
			g(
				y(meals($p) = $n)
				implies if eating($p) and not y(eating($p)) then meals($p) = $n + 1 else meals($p) = $n endif))

	main rule r_Main =
		choose $p in Philosopher with true do program($p)

default init s0:
	function meals($p in Philosopher) = 0
	agent Philosopher: r_live[]
