/* How old data become in every pair of machines on a swinging buffer, to the tick: the pair is asked for in the initial state, and
   has the periods and times of PairInTicks. */
asm PairAges

import ../std/StandardLibrary
import ../std/CTLLibrary
import ../patterns/ControlTask
import BufferFaults
import Quotient
import SystemProperties
import SystemInTicks
import Progress
import ../patterns/tests/PatternPair

signature:
	monitored kindOf: Task -> TaskKind
	monitored readerIsMaster: Boolean
	monitored threeArrays: Boolean

	derived ageBound: Integer

definitions:
	// the task's own rule, with the fault that is seeded, if any
	rule r_faultyTask = r_faulty[self]

	// From the making of the datum that the consumer works with, until the next one replaces it. A synchronous slave that waits
	// for its lock to the end of its patience leaves the access out, and so works with older data.
	function ageBound =
		if task_kind(producer_task) = SYNCHRONOUS then
			if task_kind(consumer_task) = SYNCHRONOUS then
				if sb_master(buffer) = consume_read then 37 else 43 endif
			else
				19
			endif
		else
			if task_kind(consumer_task) = SYNCHRONOUS then
				if sb_master(buffer) = consume_read then 32 else 19 endif
			else
				if sb_master(buffer) = consume_read then 20 else 14 endif
			endif
		endif

	invariant inv_ages over sb_received: isWithin(buffer, ageBound)

	main rule r_Verified = r_tick[<<r_Main>>]

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

	function dimension($b in SwingingBuffer) = if threeArrays then 3 else 2 endif
	function sem($b in SwingingBuffer) = lock
	function sb_master($b in SwingingBuffer) = if readerIsMaster then consume_read else produce_write endif
	function indexWrite($b in SwingingBuffer) = 0
	function indexRead($b in SwingingBuffer) = if threeArrays then 2 else 1 endif
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
	function elaborationRule($p in SchedulePhase) =
		switch $p
			case produce_elaborate: <<r_acquire(Scheduler)>>
			otherwise undef
		endswitch

	// what varies, what is observed, what is seeded
	function timeAtLeast($p in SchedulePhase) = if action($p) = WAITING_TRIGGER then undef else 0 endif
	function handedOver($b in SwingingBuffer) = 0
	function unaccounted($b in SwingingBuffer) = 0
	function before_read($b in SwingingBuffer) = indexRead($b)
	function before_written($b in SwingingBuffer) = 0
	function before_phase($c in Scheduler) = scheduler_currentPhase($c)
	function lostSilently($v in SharedValue) = false
	function fault = seeded

	agent Scheduler: r_faultyTask[]
