/* Every pair of machines on a swinging buffer, in ticks: all tasks step at once and the clock goes on.

   The producer's period is 6 and the consumer's 7, so every shift of the two against each other comes up; actions last
   one or two ticks, each time anew. A synchronous task may wait for as long as its period leaves it. */
asm PairInTicks

import ../std/StandardLibrary
import ../std/CTLLibrary
import ../patterns/ControlTask
import BufferPair
import Ticking

signature:

definitions:
	main rule r_Main =
		let ($written = sb_written(buffer), $read = indexRead(buffer), $wasReading = isDef(sb_readingArray(buffer))) in
			seq
				r_setTimes[]
				r_noteTimes[]
				par
					forall $c in Scheduler with true do r_scheduler_execute[$c]
					r_sem_arbitrate[lock]
					clock := clock + 1
				endpar
				r_observe[$written, $read, $wasReading]
				r_observeTimes[]
				r_shiftTimes[]
			endseq
		endlet

default init s0:
	function clock = 0
	function task_kind($t in Task) = kindOf($t)
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
	function indexRead($b in SwingingBuffer) = 1
	function indexUpdated($b in SwingingBuffer) = false
	function sb_pending($b in SwingingBuffer) = false
	function sb_data($b in SwingingBuffer, $n in ArrayIndex) = 0
	function sb_sequence($b in SwingingBuffer, $n in ArrayIndex) = 0
	function sb_staged($b in SwingingBuffer) = 0
	function sb_received($b in SwingingBuffer) = 0
	function sb_receivedSequence($b in SwingingBuffer) = 0
	function sb_fresh($b in SwingingBuffer) = false
	function sb_written($b in SwingingBuffer) = 0
	function sb_swaps($b in SwingingBuffer) = 0
	function sb_delivered($b in SwingingBuffer) = 0
	function sb_overwritten($b in SwingingBuffer) = 0
	function sb_unread($b in SwingingBuffer) = 0
	function sb_dropped($b in SwingingBuffer) = 0

	function scheduler_mainThread($c in Scheduler) = owner($c)
	function scheduler_currentPhase($c in Scheduler) = if $c = producer then produce_wait else consume_wait endif
	function scheduler_actionStart($c in Scheduler) = 0
	function action($p in SchedulePhase) = phaseAction($p)
	function nextPhase($p in SchedulePhase) = phaseAfter($p)
	function sharedMemory($p in SchedulePhase) =
		if $p = produce_write or $p = consume_read or $p = consume_wait then buffer else undef endif
	function elaborationRule($p in SchedulePhase) =
		if $p = produce_elaborate then <<r_make(Scheduler)>> else undef endif

	function newestWritten = 0
	function handedOver = 0
	function unaccounted = 0
	function isUnread = false
	function mustBeFresh = false
	function stays($c in Scheduler) = false
	function isCutShort = false
	function lasted($c in Scheduler) = 0

	function task_period($t in Task) = if $t = producer_task then 6 else 7 endif
	function task_timeForElaboration($t in Task) =
		if $t = owner(master) then
			6
		else
			if kindOf($t) = SYNCHRONOUS and isHasty then (if $t = producer_task then 6 else 7 endif) else 5 endif
		endif
	function task_periodStart($t in Task) =
		if kindOf($t) = SYNCHRONOUS then (if $t = producer_task then -6 else -7 endif) else 0 endif
	function time($p in SchedulePhase) = 1
