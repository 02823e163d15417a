/* A system of tasks, without time: in each step any of its tasks move, one or several at once, freely chosen.

   An action lasts as long as its task does not move, so all lengths are in it: each phase has time 0, and the clock
   stands still. When a period ends and when a watchdog loses patience the environment says, anew in each step. What holds
   here holds for all speeds of the tasks, all periods and all lengths of elaborations. */
module SystemInterleaved

import ../std/StandardLibrary
import ../std/CTLLibrary
import ../std/LTLLibrary
import ../patterns/ControlTask
import Quotient
import SystemProperties

export *

signature:
	monitored moves: Task -> Boolean
	monitored periodEnds: Task -> Boolean
	monitored patienceEnds: Task -> Boolean

	// who of the tasks takes part at all; the others never move
	controlled takesPart: Task -> Boolean

	// who took part in the last step
	controlled moved: Task -> Boolean

	derived isMoving: Task -> Boolean
	derived isHolding: Task -> Boolean
	derived isAtEnd: Scheduler -> Boolean

definitions:
	function isMoving($t in Task) =
		takesPart($t) and moves($t)

	function isHolding($t in Task) =
		(exists $s in Semaphore with sem_state($s, $t) = EXECUTION)

	// The period matters to it.
	function isAtEnd($c in Scheduler) =
		action(nextPhase(scheduler_currentPhase($c))) = WAITING_TRIGGER
		or action(scheduler_currentPhase($c)) = WAITING_TRIGGER

	rule r_setClock($c in Scheduler, $t in Task) =
		if isAsking($t) then
			task_deadline($t) := if patienceEnds($t) then 0 else 1 endif
		else
			if isAtEnd($c) then
				task_period($t) := if periodEnds($t) then 0 else 1 endif
			endif
		endif

	rule r_setClocks =
		forall $c in Scheduler with
			isMoving(scheduler_mainThread($c)) and task_kind(scheduler_mainThread($c)) = SYNCHRONOUS do
			r_setClock[$c, scheduler_mainThread($c)]

	// Nothing of the environment is kept, nor how long somebody waited.
	rule r_forgetEnvironment =
		forall $t in Task with true do
			par
				moved($t) := isMoving($t)
				task_period($t) := 1
				task_deadline($t) := 1
				task_timeInWait($t) := 0
			endpar

	rule r_move =
		seq
			r_setClocks[]
			par
				forall $c in Scheduler with isMoving(scheduler_mainThread($c)) do program($c)
				forall $s in Semaphore with true do r_sem_arbitrate[$s]
			endpar
			r_observe[]
			r_forget[]
			r_forgetEnvironment[]
			r_remember[]
		endseq

	// no deadlock: nobody is ever cut off from a lock or from the end of a cycle
	CTLSPEC ctlSpec_canGoOn:
		(forall $t in Task with ag(ef(not takesPart($t) or moved($t) and not isAsking($t) and not isHolding($t))))
	// nobody starves and no wake-up is lost: who asks gets in, or has given up; and the lock is left again
	LTLSPEC ltlSpec_served: (forall $t in Task with g(isAsking($t) implies f(not isAsking($t))))
	LTLSPEC ltlSpec_leaves: (forall $t in Task with g(isHolding($t) implies f(not isHolding($t))))
