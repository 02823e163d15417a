/* Mutual exclusion with a waiting room: B. K. Szymanski, A simple solution to Lamport's concurrent programming problem
   with linear wait, International Conference on Supercomputing 1988. Flags: 0 outside, 1 wants to enter the waiting
   room, 2 waits in it for others, 3 stands in its door, 4 has closed the door. A step is one move of one process, and
   reads or writes the flag of one process.
   Seeded fault: r_Leave does not look at the flags. It violates inv_exclusion after 41 steps. */
asm Szymanski

import ../../../library/std/StandardLibrary

signature:
	domain Process subsetof Integer
	domain Index subsetof Integer
	domain Flag subsetof Integer
	enum domain Place = {IDLE | ASKING | IN_DOOR | STEPPING_IN | IN_ROOM | GOING | CRITICAL | LEAVING}

	controlled place: Process -> Place
	controlled flag: Process -> Flag
	// whom a process looks at next
	controlled seen: Process -> Index

	static processes: Integer

definitions:
	domain Process = {0 : 3}
	domain Index = {0 : 4}
	domain Flag = {0 : 4}

	function processes = 4

	rule r_Go($p in Process, $place in Place, $from in Index) =
		par
			place($p) := $place
			seen($p) := $from
		endpar

	rule r_Raise($p in Process, $flag in Flag, $place in Place) =
		par
			flag($p) := $flag
			r_Go[$p, $place, 0]
		endpar

	// waits until nobody stands in the door
	rule r_Ask($p in Process) =
		if seen($p) = processes then
			r_Raise[$p, 3, IN_DOOR]
		else
			if flag(seen($p)) < 3 then
				seen($p) := seen($p) + 1
			endif
		endif

	// lets in who else wants to
	rule r_LookBack($p in Process) =
		if seen($p) = processes then
			r_Raise[$p, 4, GOING]
		else
			if flag(seen($p)) = 1 then
				r_Go[$p, STEPPING_IN, 0]
			else
				seen($p) := seen($p) + 1
			endif
		endif

	// waits until somebody has closed the door
	rule r_WaitInRoom($p in Process) =
		if seen($p) = processes then
			r_Raise[$p, 4, GOING]
		else
			if flag(seen($p)) = 4 then
				seen($p) := processes
			else
				seen($p) := (seen($p) + 1) mod processes
			endif
		endif

	// waits until those with lower numbers have left
	rule r_WaitForLower($p in Process) =
		if seen($p) = $p then
			r_Go[$p, CRITICAL, 0]
		else
			if flag(seen($p)) < 2 then
				seen($p) := seen($p) + 1
			endif
		endif

	// waits until those with higher numbers know that the door is closed
	rule r_Leave($p in Process) =
		if seen($p) = processes then
			r_Raise[$p, 0, IDLE]
		else
			if flag(seen($p)) < 2 or flag(seen($p)) > 3 then
				seen($p) := seen($p) + 1
			endif
		endif

	rule r_Move($p in Process) =
		switch place($p)
			case IDLE: r_Raise[$p, 1, ASKING]
			case ASKING: r_Ask[$p]
			case IN_DOOR: r_LookBack[$p]
			case STEPPING_IN: r_Raise[$p, 2, IN_ROOM]
			case IN_ROOM: r_WaitInRoom[$p]
			case GOING: r_WaitForLower[$p]
			case CRITICAL: r_Go[$p, LEAVING, $p + 1]
			case LEAVING: r_Leave[$p]
		endswitch

	invariant inv_exclusion over place:
		(forall $p in Process, $q in Process with $p < $q implies not (place($p) = CRITICAL and place($q) = CRITICAL))

	main rule r_Main =
		choose $p in Process with true do r_Move[$p]

default init s0:
	function place($p in Process) = IDLE
	function flag($p in Process) = 0
	function seen($p in Process) = 0
