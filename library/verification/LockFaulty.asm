/* The semaphore with a fault in it, as Lock.asm is without. */
asm LockFaulty

import ../std/StandardLibrary
import ../std/CTLLibrary
import ../std/LTLLibrary
import ../patterns/Task
import ../patterns/Semaphore
import LockUsers

signature:
	enum domain Fault = {SHARED_COUNTER | PRIORITY_ONLY | NEVER_LOOKS | FOREIGN_POST}

	monitored seeded: Fault
	controlled fault: Fault

definitions:
	// Whoever sees a free permit takes it, as from a counter that all of them read and write.
	rule r_takeWhatIsFree($t in Task) =
		if sem_state(gate, $t) = WAITING and not isLocked(gate) then
			sem_state(gate, $t) := EXECUTION
		else
			r_use[$t]
		endif

	// Having asked he waits to be let in, and does not look whether he is.
	rule r_neverLooks($t in Task) =
		if sem_state(gate, $t) = WAITING then
			if sem_granted(gate, $t) then
				skip
			else
				r_use[$t]
			endif
		else
			r_use[$t]
		endif

	// He leaves twice.
	rule r_postsAgain($t in Task) =
		if sem_state(gate, $t) = READY and not wants($t) then
			r_sem_post[gate, $t]
		else
			r_use[$t]
		endif

	rule r_useBadly($t in Task) =
		switch fault
			case SHARED_COUNTER: r_takeWhatIsFree[$t]
			case NEVER_LOOKS: r_neverLooks[$t]
			case FOREIGN_POST: r_postsAgain[$t]
			otherwise r_use[$t]
		endswitch

	// Without the arbiter's memory the most urgent goes first.
	rule r_arbitrateBadly =
		switch fault
			case PRIORITY_ONLY: skip
			otherwise r_sem_arbitrate[gate]
		endswitch

	main rule r_Main =
		par
			forall $t in Task with moves($t) do r_useBadly[$t]
			forall $u in Task with true do r_observe[$u]
			r_arbitrateBadly[]
		endpar

default init s0:
	function sem_permits($s in Semaphore) = if isPool then 2 else 1 endif
	function sem_users($s in Semaphore) = [high, middle, low]
	function sem_state($s in Semaphore, $t in Task) = READY
	function sem_illegalPost($s in Semaphore) = false
	function semaq($s in Semaphore) = []
	function moved($t in Task) = false
	function waited($t in Task) = false
	function lingered($t in Task) = false
	function fault = seeded
