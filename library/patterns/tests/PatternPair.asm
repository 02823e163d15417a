/* One producer and one consumer on one swinging buffer. The initial state is the synchronous slave
   writer (period 5) with the synchronous master reader (period 10); a scenario turns it into any other
   pair by `exec` on the configuration: kinds, master, times, periods, number of arrays.

   With `interleaved` one task moves in each step, chosen freely, instead of all at once. Time goes on
   for all, so deadlines may be missed then; everything else has to hold as well. */
asm PatternPair

import ../../std/StandardLibrary
import ../ControlTask

export *

signature:
	static producer: Scheduler
	static consumer: Scheduler
	static producer_task: Task
	static consumer_task: Task
	static buffer: SwingingBuffer
	static lock: Semaphore

	static produce_elaborate: SchedulePhase
	static produce_write: SchedulePhase
	static produce_wait: SchedulePhase
	static consume_read: SchedulePhase
	static consume_elaborate: SchedulePhase
	static consume_wait: SchedulePhase

	controlled interleaved: Boolean
	// elaborations begun by the consumer, the first one included
	controlled elaborations: Integer

definitions:
	rule r_acquire($c in Scheduler) =
		sb_staged(buffer) := clock

	rule r_use($c in Scheduler) =
		elaborations := elaborations + 1

	rule r_task = r_scheduler_execute[self]

	invariant inv_mutualExclusion over sem_state: sem_sound(lock)
	invariant inv_disjoint over sb_writingArray, sb_readingArray: sb_disjoint(buffer)
	invariant inv_newest over sb_sequence: sb_newest(buffer)
	invariant inv_accounted over sb_written: sb_accounted(buffer)
	invariant inv_deadlines over task_deadlinesMissed:
		interleaved or (forall $t in Task with task_deadlinesMissed($t) = 0)

	main rule r_Main =
		par
			if interleaved then
				choose $one in Scheduler with true do program($one)
			else
				forall $c in Scheduler with true do program($c)
			endif
			forall $s in Semaphore with true do r_sem_arbitrate[$s]
			clock := clock + 1
		endpar

default init s0:
	function clock = 0
	function interleaved = false
	function elaborations = 0

	function task_kind($t in Task) = SYNCHRONOUS
	function task_period($t in Task) = if $t = producer_task then 5 else 10 endif
	function task_timeForElaboration($t in Task) = if $t = producer_task then 3 else 6 endif
	function task_periodStart($t in Task) = if $t = producer_task then -5 else -10 endif
	function task_timeInWait($t in Task) = 0
	function task_cycles($t in Task) = 0
	function task_deadlinesMet($t in Task) = 0
	function task_deadlinesMissed($t in Task) = 0
	function task_totalWait($t in Task) = 0
	function task_longestWait($t in Task) = 0
	function task_skipped($t in Task) = 0

	function sem_permits($s in Semaphore) = 1
	function sem_users($s in Semaphore) = [producer_task, consumer_task]
	function sem_state($s in Semaphore, $t in Task) = READY
	function sem_illegalPost($s in Semaphore) = false
	function semaq($s in Semaphore) = []

	function dimension($b in SwingingBuffer) = 2
	function sem($b in SwingingBuffer) = lock
	function sb_master($b in SwingingBuffer) = consume_read
	function indexWrite($b in SwingingBuffer) = 0
	function indexRead($b in SwingingBuffer) = 1
	function indexUpdated($b in SwingingBuffer) = false
	function sb_pending($b in SwingingBuffer) = false
	function sb_sequence($b in SwingingBuffer, $n in ArrayIndex) = 0
	function sb_receivedSequence($b in SwingingBuffer) = 0
	function sb_fresh($b in SwingingBuffer) = false
	function sb_written($b in SwingingBuffer) = 0
	function sb_swaps($b in SwingingBuffer) = 0
	function sb_delivered($b in SwingingBuffer) = 0
	function sb_overwritten($b in SwingingBuffer) = 0
	function sb_unread($b in SwingingBuffer) = 0
	function sb_dropped($b in SwingingBuffer) = 0

	function scheduler_mainThread($c in Scheduler) = if $c = producer then producer_task else consumer_task endif
	function scheduler_currentPhase($c in Scheduler) = if $c = producer then produce_wait else consume_wait endif
	function scheduler_actionStart($c in Scheduler) = 0

	function action($p in SchedulePhase) =
		switch $p
			case produce_elaborate: ELABORATING
			case produce_write: WRITING_ON_SB
			case consume_read: READING_FROM_SB
			case consume_elaborate: ELABORATING
			otherwise WAITING_TRIGGER
		endswitch
	function time($p in SchedulePhase) = if $p = consume_elaborate then 3 else 1 endif
	function nextPhase($p in SchedulePhase) =
		switch $p
			case produce_elaborate: produce_write
			case produce_write: produce_wait
			case produce_wait: produce_elaborate
			case consume_read: consume_elaborate
			case consume_elaborate: consume_wait
			otherwise consume_read
		endswitch
	function sharedMemory($p in SchedulePhase) =
		if $p = produce_write or $p = consume_read or $p = consume_wait then buffer else undef endif
	function elaborationRule($p in SchedulePhase) =
		switch $p
			case produce_elaborate: <<r_acquire(Scheduler)>>
			case consume_elaborate: <<r_use(Scheduler)>>
			otherwise undef
		endswitch

	agent Scheduler: r_task[]
