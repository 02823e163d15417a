/* A pair on a swinging buffer of which either task may be stopped at any time, in the middle of its machine: as by a path out of a
   composite state around the machine's instance. The task then begins its cycle anew. Otherwise as PairInterleaved: without time, one
   task moves or both, and each that moves makes its step or is stopped. */
asm StoppedPair

import ../std/StandardLibrary
import ../std/CTLLibrary
import ../std/LTLLibrary
import ../patterns/ControlTask
import BufferPair
import Interleaving

signature:
	monitored stops: Scheduler -> Boolean
	monitored seededStop: StopFault

	enum domain StopFault = {NONE | LOCK_KEPT | LINE_KEPT | HANDED_OVER_TORN | SECTION_KEPT | LOSS_NOT_COUNTED}

	controlled stopFault: StopFault
	// it was stopped in the step before
	controlled wasStopped: Scheduler -> Boolean

	derived isInMachine: Scheduler -> Boolean

definitions:
	function isInMachine($c in Scheduler) =
		isDef(sb_ctrlState(scheduler_currentPhase($c)))

	// The rule of the library, or one with a fault.
	rule r_giveBack($c in Scheduler) =
		let ($b = sharedMemory(scheduler_currentPhase($c)), $t = scheduler_mainThread($c)) in
			switch stopFault
				case NONE: r_abortPattern[$c]
				case LOCK_KEPT:
					if sem_state(sem($b), $t) != EXECUTION then
						r_abortPattern[$c]
					endif
				case LINE_KEPT:
					if sem_state(sem($b), $t) != WAITING then
						r_abortPattern[$c]
					endif
				case HANDED_OVER_TORN:
					seq
						r_abortPattern[$c]
						if sb_ctrlState(scheduler_currentPhase($c)) = WRITING then
							sb_pending($b) := true
						endif
					endseq
				case SECTION_KEPT:
					if indexUpdated($b) then
						r_SwingingBuffer_releaseLock[$b, $t]
					else
						r_abortPattern[$c]
					endif
				case LOSS_NOT_COUNTED:
					if sb_ctrlState(scheduler_currentPhase($c)) = WRITING then
						par
							r_SwingingBuffer_endWrite[$b]
							sb_pending($b) := false
							sb_cutOff($b) := true
							if sem_state(sem($b), $t) = EXECUTION then
								r_releaseSb[$c]
							endif
						endpar
					else
						r_abortPattern[$c]
					endif
			endswitch
		endlet

	rule r_stop($c in Scheduler) =
		par
			r_giveBack[$c]
			sb_ctrlState(scheduler_currentPhase($c)) := undef
			scheduler_currentPhase($c) := if $c = producer then produce_wait else consume_wait endif
			wasStopped($c) := true
		endpar

	// A datum that is cut off is no datum: nothing newer can be handed over than what was. One that was made and not written is given up.
	rule r_observeStops($wasCutOff in Boolean) =
		if wasStopped(producer) then
			par
				unaccounted := 0
				if sb_cutOff(buffer) = true and not $wasCutOff then
					newestWritten := handedOver
				endif
			endpar
		endif

	// who was stopped holds nothing
	invariant inv_nothingHeld over sem_state:
		(forall $c in Scheduler with
			wasStopped($c)
			implies (
				sem_state(lock, owner($c)) = READY
				and isUndef(if $c = producer then sb_writingArray(buffer) else sb_readingArray(buffer) endif)))
	// and a datum that was cut off is never handed over
	invariant inv_cutOff over sb_cutOff: sb_cutOff(buffer) = true implies not sb_pending(buffer)

	// either may be stopped, also while it holds the lock, and the other one goes on for ever
	CTLSPEC ctlSpec_stops: (forall $c in Scheduler with ag(ef(wasStopped($c))))
	CTLSPEC ctlSpec_stopsInside: (exist $c in Scheduler with ef(isInside($c) and ex(wasStopped($c))))
	CTLSPEC ctlSpec_cutsOff: ef(sb_cutOff(buffer) = true)

	main rule r_Main =
		choose $moves in Moves with true do
			let ($written = sb_written(buffer),
				$read = indexRead(buffer),
				$wasReading = isDef(sb_readingArray(buffer)),
				$wasCutOff = sb_cutOff(buffer) = true) in
				seq
					r_setClocks[$moves]
					par
						forall $c in Scheduler with isMoving($moves, $c) do
							if isInMachine($c) and stops($c) then
								r_stop[$c]
							else
								par
									r_scheduler_execute[$c]
									wasStopped($c) := false
								endpar
							endif
						r_sem_arbitrate[lock]
					endpar
					r_observe[$written, $read, $wasReading]
					r_observeStops[$wasCutOff]
					r_forget[$moves]
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
		if $p = produce_write or $p = consume_read or $p = consume_wait then buffer else undef endif
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
	function wasStopped($c in Scheduler) = false
	function sb_cutOff($b in SwingingBuffer) = false
	function stopFault = seededStop
