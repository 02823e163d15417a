/* Election in a ring: E. Chang and R. Roberts, An improved algorithm for decentralized extrema-finding in circular
   configurations of processes, Communications of the ACM 22, 1979. A process sends its number to the next one when it
   wakes up, by itself or because a message comes. It passes on what is greater than its own number and drops what is
   less; whose own number comes back is elected. Messages between two neighbours stay in order.
   Seeded fault: lesser numbers are passed on, too. It violates inv_greatest after 12 steps. */
asm RingElection

import ../../../library/std/StandardLibrary

signature:
	domain Process subsetof Integer
	domain Number subsetof Integer
	enum domain Place = {ASLEEP | CANDIDATE | LOST | ELECTED}
	enum domain Action = {WAKE_UP | RECEIVE}

	controlled place: Process -> Place
	// what was sent to a process and has not arrived
	controlled queue: Process -> Seq(Number)

	static number: Process -> Number
	static following: Process -> Process
	static greatest: Integer

definitions:
	domain Process = {0 : 10}
	domain Number = {0 : 10}

	function number($p in Process) =
		switch $p
			case 0: 3
			case 1: 0
			case 2: 6
			case 3: 1
			case 4: 9
			case 5: 4
			case 6: 10
			case 7: 7
			case 8: 2
			case 9: 8
			case 10: 5
		endswitch
	function following($p in Process) = ($p + 1) mod 11
	function greatest = 10

	rule r_Send($p in Process, $n in Number) =
		queue(following($p)) := append(queue(following($p)), $n)

	rule r_WakeUp($p in Process) =
		if place($p) = ASLEEP then
			par
				place($p) := CANDIDATE
				r_Send[$p, number($p)]
			endpar
		endif

	rule r_Receive($p in Process) =
		if not isEmpty(queue($p)) then
			let ($n = first(queue($p))) in
				par
					queue($p) := tail(queue($p))
					if $n = number($p) then
						place($p) := ELECTED
					else
						if $n > number($p) then
							par
								place($p) := LOST
								r_Send[$p, $n]
							endpar
						else
							r_WakeUp[$p]
						endif
					endif
				endpar
			endlet
		endif

	invariant inv_greatest over place: (forall $p in Process with place($p) = ELECTED implies number($p) = greatest)
	invariant inv_bounded over queue: (forall $p in Process with length(queue($p)) <= 11)

	main rule r_Main =
		choose $action in Action, $p in Process with true do
			switch $action
				case WAKE_UP: r_WakeUp[$p]
				case RECEIVE: r_Receive[$p]
			endswitch

default init s0:
	function place($p in Process) = ASLEEP
	function queue($p in Process) = []
