/* Mutual exclusion of several processes: G. L. Peterson, Myths about the mutual exclusion problem, Information
   Processing Letters 12, 1981. Who wants to enter goes through levels. At each it says that it is there and that it
   came last, and waits until another has come after it or all others are below. A step is one move of one process, and
   reads or writes one variable of the others. For 4 processes the database of models for explicit checkers (BEEM,
   peterson.4) gives 1 119 560 states and 3 864 896 transitions.
   Seeded fault: who came last goes on (`last(next($p)) = $p`). It violates inv_exclusion after 22 steps. */
asm Peterson

import ../../../library/std/StandardLibrary

signature:
	domain Process subsetof Integer
	domain Level subsetof Integer
	enum domain Place = {IDLE | ENTERING | YIELDING | WAITING | CRITICAL}
	enum domain Look = {AT_WHO_CAME_LAST | AT_ANOTHER}

	controlled place: Process -> Place
	// shared: the level at which a process is, and who came last to a level
	controlled level: Process -> Level
	controlled last: Level -> Process
	// of one process: the level that it goes to, and whom it looks at next
	controlled next: Process -> Level
	controlled seen: Process -> Level

	static processes: Integer

definitions:
	domain Process = {0 : 3}
	domain Level = {0 : 4}

	function processes = 4

	rule r_Climb($p in Process) =
		par
			next($p) := next($p) + 1
			place($p) := ENTERING
		endpar

	rule r_LookAtWhoCameLast($p in Process) =
		if last(next($p)) != $p or seen($p) = processes then
			r_Climb[$p]
		endif

	rule r_LookAtAnother($p in Process) =
		if seen($p) < processes then
			if seen($p) = $p or level(seen($p)) < next($p) then
				seen($p) := seen($p) + 1
			endif
		endif

	rule r_Move($p in Process) =
		switch place($p)
			case IDLE:
				par
					next($p) := 1
					place($p) := ENTERING
				endpar
			case ENTERING:
				if next($p) < processes then
					par
						level($p) := next($p)
						place($p) := YIELDING
					endpar
				else
					place($p) := CRITICAL
				endif
			case YIELDING:
				par
					last(next($p)) := $p
					seen($p) := 0
					place($p) := WAITING
				endpar
			case WAITING:
				choose $look in Look with true do
					switch $look
						case AT_WHO_CAME_LAST: r_LookAtWhoCameLast[$p]
						case AT_ANOTHER: r_LookAtAnother[$p]
					endswitch
			case CRITICAL:
				par
					level($p) := 0
					place($p) := IDLE
				endpar
		endswitch

	invariant inv_exclusion over place:
		(forall $p in Process, $q in Process with $p < $q implies not (place($p) = CRITICAL and place($q) = CRITICAL))

	main rule r_Main =
		choose $p in Process with true do r_Move[$p]

default init s0:
	function place($p in Process) = IDLE
	function level($p in Process) = 0
	function last($l in Level) = 0
	function next($p in Process) = 0
	function seen($p in Process) = 0
