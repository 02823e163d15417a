/* A counting semaphore that is safe under true concurrency.

   Tasks that step in the same instant cannot see each other's request, so none of them may decide
   alone that the semaphore is free, and none may decrement a shared counter: two decrements in one
   step are the same update, and a permit is handed out twice. Therefore
   - no counter is shared: a task writes its own `sem_state`, the arbiter alone writes `semaq`;
   - asking and entering are two steps: a task asks (WAITING), and enters (EXECUTION) in a later step
     in which `sem_granted` holds for it; the grant is a function of the state, the same for all;
   - grants go by arrival, whatever the kind of task; requests of the same step go by the priority
     order `sem_users`. A later request never overtakes an earlier one, so nobody starves.
   The free permits are counted from the tasks inside, never stored. */
module Semaphore

import ../std/StandardLibrary
import Task

export *

signature:
	abstract domain Semaphore

	// State of a task with respect to one semaphore: outside, in line, inside.
	enum domain TaskCSState = {READY | WAITING | EXECUTION}

	// Configuration
	controlled sem_permits: Semaphore -> Integer
	// who may use it, the most urgent task first
	controlled sem_users: Semaphore -> Seq(Task)

	// Written by the task alone
	controlled sem_state: Prod(Semaphore, Task) -> TaskCSState
	// Raised by the post of a task that is not inside, never lowered: several may raise it at once.
	controlled sem_illegalPost: Semaphore -> Boolean

	// Written by the arbiter alone: the tasks known to be waiting, first come first
	controlled semaq: Semaphore -> Seq(Task)

	derived semacount: Semaphore -> Integer
	derived isLocked: Semaphore -> Boolean
	derived sem_line: Semaphore -> Seq(Task)
	derived sem_granted: Prod(Semaphore, Task) -> Boolean
	derived sem_sound: Semaphore -> Boolean

definitions:
	function semacount($s in Semaphore) =
		sem_permits($s) - length([$t in sem_users($s) | sem_state($s, $t) = EXECUTION : $t])

	function isLocked($s in Semaphore) =
		semacount($s) < 1

	// Those queued earlier and still waiting, then the newcomers in order of priority.
	function sem_line($s in Semaphore) =
		union(
			[$t in semaq($s) | sem_state($s, $t) = WAITING : $t],
			[$u in sem_users($s) | sem_state($s, $u) = WAITING and not contains(semaq($s), $u) : $u])

	function sem_granted($s in Semaphore, $t in Task) =
		if sem_state($s, $t) = WAITING then indexOf(sem_line($s), $t) < semacount($s) else false endif

	// Never more tasks inside than permits, and nobody has left without being inside.
	function sem_sound($s in Semaphore) =
		semacount($s) >= 0 and not sem_illegalPost($s)

	// Ask, and enter as soon as granted; to be called again in every step until the task is inside.
	rule r_sem_wait($s in Semaphore, $t in Task) =
		if sem_granted($s, $t) then
			sem_state($s, $t) := EXECUTION
		else
			if sem_state($s, $t) = READY then
				sem_state($s, $t) := WAITING
			endif
		endif

	// Stop waiting. The permit goes to the next in line in the very next state: no wake-up is lost.
	rule r_sem_giveUp($s in Semaphore, $t in Task) =
		if sem_state($s, $t) = WAITING then
			sem_state($s, $t) := READY
		endif

	rule r_sem_post($s in Semaphore, $t in Task) =
		if sem_state($s, $t) = EXECUTION then
			sem_state($s, $t) := READY
		else
			sem_illegalPost($s) := true
		endif

	// The arbiter: remembers the order of arrival. Runs beside the tasks, in every step.
	rule r_sem_arbitrate($s in Semaphore) =
		if not isEmpty(semaq($s)) or (exists $t in asSet(sem_users($s)) with sem_state($s, $t) = WAITING) then
			semaq($s) := sem_line($s)
		endif
