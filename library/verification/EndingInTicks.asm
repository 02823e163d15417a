/* Tasks that end, to the tick: either task of a pair on a swinging buffer may end whenever it rests, and does nothing from then on. The
   other one goes on, and gets what is left. The pair is asked for in the initial state, and has periods of 6 and 7 ticks.

   A task that ends inside the lock is in AccessInTicks: there, the other user may keep it for ever. */
asm EndingInTicks

import ../std/StandardLibrary
import ../std/CTLLibrary
import ../patterns/ControlTask
import BufferFaults
import Quotient
import SystemProperties
import SystemInTicks
import FreshTold
import ../patterns/tests/PatternPair

signature:
	monitored kindOf: Task -> TaskKind
	monitored readerIsMaster: Boolean
	monitored ends: Scheduler -> Boolean

	controlled hasEnded: Scheduler -> Boolean

	derived isResting: Scheduler -> Boolean

definitions:
	function isResting($c in Scheduler) =
		action(scheduler_currentPhase($c)) = WAITING_TRIGGER

	// the task's own rule, with the fault that is seeded, if any, until it ends
	rule r_endingTask =
		if not hasEnded(self) then
			r_faulty[self]
		endif

	// A period that nobody waits for does not go on.
	rule r_end =
		forall $c in Scheduler with isResting($c) do
			if hasEnded($c) then
				task_periodStart(scheduler_mainThread($c)) := 0
			else
				if ends($c) then
					par
						hasEnded($c) := true
						task_periodStart(scheduler_mainThread($c)) := 0
					endpar
				endif
			endif

	// a task that has ended is outside the lock, and not in line
	invariant inv_endedOutside over hasEnded:
		(forall $c in Scheduler with hasEnded($c) implies sem_state(lock, scheduler_mainThread($c)) = READY)

	// either may end, alone and before it ever began
	CTLSPEC ctlSpec_ends: (forall $c in Scheduler with ag(ef(hasEnded($c))))
	// who does not end goes on; an asynchronous reader rests if nobody writes any more
	CTLSPEC ctlSpec_producerWorks: ag(af(hasEnded(producer) or scheduler_currentPhase(producer) = produce_elaborate))
	CTLSPEC ctlSpec_consumerWorks:
		ag(
			af(
				hasEnded(consumer)
				or hasEnded(producer) and task_kind(consumer_task) = ASYNCHRONOUS
				or scheduler_currentPhase(consumer) = consume_read))
	// what was handed over before the producer ended is read, and from then on nothing is new for a reader that goes on reading
	CTLSPEC ctlSpec_rest:
		ag(
			hasEnded(producer)
			implies af(
				hasEnded(consumer)
				or ag(
					handedOver(buffer) = sb_receivedSequence(buffer)
					and (task_kind(consumer_task) = SYNCHRONOUS implies not sb_fresh(buffer)))))
	// a reader that is the master leaves nothing behind
	CTLSPEC ctlSpec_nothingLeft:
		ag(
			hasEnded(producer) and sb_master(buffer) = consume_read
			implies af(hasEnded(consumer) or ag(not sb_pending(buffer))))

	main rule r_Verified =
		seq
			r_tick[<<r_Main>>]
			r_tellFresh[]
			r_end[]
		endseq

default init s0:
	function clock = 0
	function interleaved = false
	function elaborations = 0

	function task_kind($t in Task) = kindOf($t)
	function task_period($t in Task) = if $t = producer_task then 6 else 7 endif
	function task_timeForElaboration($t in Task) = if ($t = consumer_task) = readerIsMaster then 6 else 5 endif
	function task_periodStart($t in Task) =
		if kindOf($t) = SYNCHRONOUS then (if $t = producer_task then -6 else -7 endif) else 0 endif
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
	function sb_master($b in SwingingBuffer) = if readerIsMaster then consume_read else produce_write endif
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
	function time($p in SchedulePhase) = 2
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
	// data are told apart by their numbers; how old they get for a reader that goes on for ever does not matter
	function elaborationRule($p in SchedulePhase) = undef

	// what varies, what is observed, what is seeded
	function timeAtLeast($p in SchedulePhase) = if action($p) = WAITING_TRIGGER then undef else 0 endif
	function handedOver($b in SwingingBuffer) = 0
	function unaccounted($b in SwingingBuffer) = 0
	function before_read($b in SwingingBuffer) = indexRead($b)
	function before_written($b in SwingingBuffer) = 0
	function before_phase($c in Scheduler) = scheduler_currentPhase($c)
	function lostSilently($v in SharedValue) = false
	function fault = seeded
	function mustBeFresh($b in SwingingBuffer) = false
	function isUnread($b in SwingingBuffer) = false
	function wasPending($b in SwingingBuffer) = false
	function wasReading($b in SwingingBuffer) = false
	function wasAt($c in Scheduler) = scheduler_currentPhase($c)
	function hasEnded($c in Scheduler) = false

	agent Scheduler: r_endingTask[]
