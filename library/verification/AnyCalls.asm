/* The semaphore under any calls: two tasks ask, give up and leave whenever they like, also where they should not. A task that leaves
   without being inside changes nothing for anybody, and this is remembered for ever. */
asm AnyCalls

import ../std/StandardLibrary
import ../std/CTLLibrary
import ../patterns/Task
import ../patterns/Semaphore

signature:
	enum domain Call = {NOTHING | WAITS | GIVES_UP | POSTS}

	static one: Task
	static other: Task
	static gate: Semaphore

	monitored calls: Task -> Call

	// what has to be after the step, and whether somebody ever left without being inside
	controlled due: Task -> TaskCSState
	controlled hasPosted: Boolean

definitions:
	rule r_call($t in Task, $call in Call) =
		switch $call
			case WAITS: r_sem_wait[gate, $t]
			case GIVES_UP: r_sem_giveUp[gate, $t]
			case POSTS: r_sem_post[gate, $t]
			otherwise skip
		endswitch

	rule r_expect($t in Task, $call in Call) =
		switch sem_state(gate, $t)
			case READY:
				par
					if $call = WAITS then
						due($t) := WAITING
					endif
					if $call = POSTS then
						hasPosted := true
					endif
				endpar
			case WAITING:
				par
					if $call = WAITS and sem_granted(gate, $t) then
						due($t) := EXECUTION
					endif
					if $call = GIVES_UP then
						due($t) := READY
					endif
					if $call = POSTS then
						hasPosted := true
					endif
				endpar
			case EXECUTION:
				if $call = POSTS then
					due($t) := READY
				endif
		endswitch

	invariant inv_state over sem_state: (forall $t in Task with sem_state(gate, $t) = due($t))
	invariant inv_posts over sem_illegalPost: sem_illegalPost(gate) = hasPosted
	// nobody is in line twice
	invariant inv_line over semaq: length(semaq(gate)) = size(asSet(semaq(gate)))
	invariant inv_permits over sem_state: semacount(gate) >= 0
	// what it leads to is told by the property of all applications
	invariant inv_sound over sem_illegalPost: sem_sound(gate) = not hasPosted

	CTLSPEC ctlSpec_posts: ef(hasPosted)
	CTLSPEC ctlSpec_enters: (forall $t in Task with ag(ef(sem_state(gate, $t) = EXECUTION)))

	main rule r_Main =
		par
			forall $t in Task with true do
				par
					r_call[$t, calls($t)]
					r_expect[$t, calls($t)]
				endpar
			r_sem_arbitrate[gate]
		endpar

default init s0:
	function sem_permits($s in Semaphore) = 1
	function sem_users($s in Semaphore) = [one, other]
	function sem_state($s in Semaphore, $t in Task) = READY
	function sem_illegalPost($s in Semaphore) = false
	function semaq($s in Semaphore) = []
	function due($t in Task) = READY
	function hasPosted = false
