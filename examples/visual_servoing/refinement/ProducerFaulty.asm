/* library/verification/PairInTicks with a fault in its producer that a refinement check must find, chosen by `--bound fault=…`: it begins a cycle
   a tick too early; it writes the datum that it made before; it leaves its pattern machine before it has written. */
asm ProducerFaulty

import ../../../library/std/StandardLibrary
import ../../../library/std/CTLLibrary
import ../../../library/patterns/ControlTask
import ../../../library/verification/BufferPair
import ../../../library/verification/Ticking

signature:
	enum domain ProducerFault = {EARLY | STALE | LEAVES}
	monitored fault: ProducerFault
	controlled seeded: ProducerFault

definitions:
	rule r_early =
		if scheduler_currentPhase(producer) = produce_wait and task_kind(producer_task) = SYNCHRONOUS then
			if task_elapsedTimeOfPeriod(producer_task) >= task_period(producer_task) - 1 then
				r_startCycle[producer, produce_wait]
			endif
		else
			r_scheduler_execute[producer]
		endif

	// The elaboration ends before its datum is there: the one before is staged again.
	rule r_stale =
		seq
			r_scheduler_execute[producer]
			if isDef(sb_writingArray(buffer)) then
				sb_data(buffer, sb_writingArray(buffer)) := (sb_staged(buffer) + 2) mod 3
			endif
		endseq

	// It finds the lock busy, and goes on.
	rule r_leaves =
		if scheduler_currentPhase(producer) = produce_write
			and sb_ctrlState(produce_write) = MANAGING_SB
			and master != producer then
			par
				r_giveUpSb[producer]
				r_leavePattern[producer]
			endpar
		else
			r_scheduler_execute[producer]
		endif

	rule r_faultyProducer =
		switch seeded
			case EARLY: r_early[]
			case STALE: r_stale[]
			case LEAVES: r_leaves[]
		endswitch

	main rule r_Main =
		let ($written = sb_written(buffer), $read = indexRead(buffer), $wasReading = isDef(sb_readingArray(buffer))) in
			seq
				r_setTimes[]
				r_noteTimes[]
				par
					r_faultyProducer[]
					r_scheduler_execute[consumer]
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
	function seeded = fault
