/* Three tasks, a lock and a pool of two permits; the environment decides who wants in, who loses
   patience and who is done. All tasks step at once, or one task a step when `oneAtATime` is set:
   the properties may depend on neither. */
asm SemaphoreTest

import ../../std/StandardLibrary
import ../Task
import ../Semaphore

signature:
	static high: Task
	static middle: Task
	static low: Task
	static lock: Semaphore
	static pool: Semaphore

	monitored wants: Prod(Task, Semaphore) -> Boolean
	monitored impatient: Prod(Task, Semaphore) -> Boolean
	monitored done: Prod(Task, Semaphore) -> Boolean
	// the semaphore that is in use by the test
	monitored tested: Semaphore
	monitored oneAtATime: Boolean

	derived inside: Semaphore -> Powerset(Task)

definitions:
	function inside($s in Semaphore) =
		{$t in Task | sem_state($s, $t) = EXECUTION : $t}

	rule r_client($t in Task) =
		switch sem_state(tested, $t)
			case READY:
				if wants($t, tested) then r_sem_wait[tested, $t] endif
			case WAITING:
				if impatient($t, tested) then r_sem_giveUp[tested, $t] else r_sem_wait[tested, $t] endif
			case EXECUTION:
				if done($t, tested) then r_sem_post[tested, $t] endif
		endswitch

	invariant inv_mutualExclusion over sem_state: size(inside(lock)) <= 1
	invariant inv_permits over sem_state: size(inside(pool)) <= 2
	invariant inv_sound over sem_state: (forall $s in Semaphore with sem_sound($s))
	// whoever may enter is in line
	invariant inv_line over semaq:
		(forall $s in Semaphore, $t in Task with sem_granted($s, $t) implies contains(sem_line($s), $t))

	main rule r_Main =
		par
			if oneAtATime then
				choose $one in Task with true do r_client[$one]
			else
				forall $t in Task with true do r_client[$t]
			endif
			forall $s in Semaphore with true do r_sem_arbitrate[$s]
		endpar

default init s0:
	function sem_permits($s in Semaphore) = if $s = lock then 1 else 2 endif
	function sem_users($s in Semaphore) = [high, middle, low]
	function sem_state($s in Semaphore, $t in Task) = READY
	function sem_illegalPost($s in Semaphore) = false
	function semaq($s in Semaphore) = []
