/* Two processes that share a critical section, by Peterson's algorithm (1981): who wants to enter says so, lets the other go
   first, and waits until the other does not want to or has let it go. A step is one move of one process, chosen. */
asm Peterson

import ../../library/std/StandardLibrary
import ../../library/std/CTLLibrary
import ../../library/std/LTLLibrary

signature:
	enum domain Process = {LEFT | RIGHT}
	enum domain Place = {IDLE | ASKING | YIELDING | WAITING | CRITICAL}

	controlled place: Process -> Place
	controlled wants: Process -> Boolean
	// who may go first
	controlled turn: Process

	static other: Process -> Process

definitions:
	function other($p in Process) =
		if $p = LEFT then RIGHT else LEFT endif

	rule r_move($p in Process) =
		switch place($p)
			case IDLE: place($p) := ASKING
			case ASKING:
				par
					wants($p) := true
					place($p) := YIELDING
				endpar
			case YIELDING:
				par
					turn := other($p)
					place($p) := WAITING
				endpar
			case WAITING:
				if not wants(other($p)) or turn = $p then
					place($p) := CRITICAL
				endif
			case CRITICAL:
				par
					wants($p) := false
					place($p) := IDLE
				endpar
		endswitch

	CTLSPEC ctlSpec_exclusion: ag(not (place(LEFT) = CRITICAL and place(RIGHT) = CRITICAL))
	// Both are elsewhere at first. Whoever wants to enter has said so, and whoever leaves is elsewhere and does not want to any more.
	LTLSPEC ltlSpec_begins: (forall $p in Process with place($p) = IDLE) and turn = LEFT
	LTLSPEC ltlSpec_leaves:
		(forall $p in Process with g(y(place($p) = CRITICAL) implies place($p) = CRITICAL or place($p) = IDLE))
	invariant inv_wants over wants, place:
		(forall $p in Process with wants($p) iff place($p) != IDLE and place($p) != ASKING)
	CTLSPEC ctlSpec_canEnter: (forall $p in Process with ag(ef(place($p) = CRITICAL)))
	// Nobody enters who has not asked since it was there last.
	LTLSPEC ltlSpec_asked:
		(forall $p in Process with g(place($p) = CRITICAL implies s(place($p) != IDLE, place($p) = ASKING)))
	// Who asks, enters: if both go on moving as long as they can (`--fair-agents`).
	LTLSPEC ltlSpec_served: (forall $p in Process with g(place($p) = ASKING implies f(place($p) = CRITICAL)))
	// Who waits is overtaken once at most.
	LTLSPEC ltlSpec_overtakenOnce:
		(forall $p in Process with
			g(
				place($p) = WAITING and place(other($p)) = CRITICAL
				implies x(
					v(
						place($p) = CRITICAL,
						place(other($p)) = CRITICAL or v(place($p) = CRITICAL, place(other($p)) != CRITICAL)))))

	main rule r_Main =
		choose $p in Process with true do r_move[$p]

default init s0:
	function place($p in Process) = IDLE
	function wants($p in Process) = false
	function turn = LEFT
