/* PairInTime with a fault that a refinement check must find, chosen by `--bound seeded=…`: see library/verification/BufferFaults. */
asm PairInTimeFaulty

import ../../../library/std/StandardLibrary
import ../../../library/std/CTLLibrary
import ../../../library/std/LTLLibrary
import ../../../library/patterns/ControlTask
import ../../../library/verification/BufferPair
import ../../../library/verification/Interleaving
import ../../../library/verification/BufferFaults

signature:

definitions:
	INVAR not patienceEnds(producer_task) and not patienceEnds(consumer_task)

	main rule r_Main =
		choose $moves in Moves with true do
			let ($written = sb_written(buffer),
				$read = indexRead(buffer),
				$wasReading = isDef(sb_readingArray(buffer))) in
				seq
					r_setClocks[$moves]
					par
						forall $c in Scheduler with isMoving($moves, $c) do r_faulty[$c]
						r_sem_arbitrate[lock]
					endpar
					r_observe[$written, $read, $wasReading]
					r_forget[$moves]
					forall $c in Scheduler with true do moved($c) := false
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

	function dimension($b in SwingingBuffer) = 2
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
		if $p = produce_write or $p = consume_read then buffer else undef endif
	function elaborationRule($p in SchedulePhase) =
		if $p = produce_elaborate then <<r_make(Scheduler)>> else undef endif

	function newestWritten = 0
	function handedOver = 0
	function unaccounted = 0
	function isUnread = false
	function mustBeFresh = false

	function task_period($t in Task) = 1
	function task_deadline($t in Task) = 1
	function task_timeForElaboration($t in Task) = 0
	function task_periodStart($t in Task) = 0
	function time($p in SchedulePhase) = 0
	function moved($c in Scheduler) = false
	function fault = seeded
