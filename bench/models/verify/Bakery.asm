/* Mutual exclusion as in a bakery: L. Lamport, A new solution of Dijkstra's concurrent programming problem,
   Communications of the ACM 17, 1974. Who wants to enter takes a number greater than all it sees, and waits for each
   process with a lower one; of two with one number the first goes first. Numbers are bounded here: who would take a
   greater one looks again. A step is one move of one process, and reads or writes variables of one process.
   Seeded fault: r_Look does not wait for who is choosing. It violates inv_exclusion after 26 steps. */
asm Bakery

import ../../../library/std/StandardLibrary

signature:
	domain Process subsetof Integer
	domain Index subsetof Integer
	domain Ticket subsetof Integer
	enum domain Place = {IDLE | CHOOSING | CHOSEN | LOOKING | WAITING | CRITICAL}

	controlled place: Process -> Place
	// shared
	controlled choosing: Process -> Boolean
	controlled ticket: Process -> Ticket
	// of one process: whom it looks at next, and the greatest number seen
	controlled seen: Process -> Index
	controlled greatest: Process -> Ticket

	static processes: Integer
	static tickets: Integer

definitions:
	domain Process = {0 : 2}
	domain Index = {0 : 3}
	domain Ticket = {0 : 8}

	function processes = 3
	function tickets = 8

	rule r_Choose($p in Process) =
		if seen($p) < processes then
			par
				greatest($p) := max(greatest($p), ticket(seen($p)))
				seen($p) := seen($p) + 1
			endpar
		else
			par
				if greatest($p) < tickets then
					par
						ticket($p) := greatest($p) + 1
						place($p) := CHOSEN
					endpar
				endif
				greatest($p) := 0
				seen($p) := 0
			endpar
		endif

	rule r_Look($p in Process) =
		if seen($p) = processes then
			par
				seen($p) := 0
				place($p) := CRITICAL
			endpar
		else
			if not choosing(seen($p)) then
				place($p) := WAITING
			endif
		endif

	rule r_Wait($p in Process) =
		let ($other = ticket(seen($p))) in
			if $other = 0 or ticket($p) < $other or ticket($p) = $other and $p <= seen($p) then
				par
					seen($p) := seen($p) + 1
					place($p) := LOOKING
				endpar
			endif
		endlet

	rule r_Move($p in Process) =
		switch place($p)
			case IDLE:
				par
					choosing($p) := true
					place($p) := CHOOSING
				endpar
			case CHOOSING: r_Choose[$p]
			case CHOSEN:
				par
					choosing($p) := false
					place($p) := LOOKING
				endpar
			case LOOKING: r_Look[$p]
			case WAITING: r_Wait[$p]
			case CRITICAL:
				par
					ticket($p) := 0
					place($p) := IDLE
				endpar
		endswitch

	invariant inv_exclusion over place:
		(forall $p in Process, $q in Process with $p < $q implies not (place($p) = CRITICAL and place($q) = CRITICAL))

	main rule r_Main =
		choose $p in Process with true do r_Move[$p]

default init s0:
	function place($p in Process) = IDLE
	function choosing($p in Process) = false
	function ticket($p in Process) = 0
	function seen($p in Process) = 0
	function greatest($p in Process) = 0
