/* What every system of tasks on swinging buffers has to keep, whatever its tasks are, and what stands beside the machines to
   tell it: which number was handed over last, and which data were due to be written and not yet written or counted as dropped.

   `patternsSound`, which each system has as an invariant of its own, says the rest: one task inside a lock, reader and
   writer on different arrays, no reading older than the one before, every datum accounted for. */
module SystemProperties

import ../std/StandardLibrary
import ../patterns/ControlTask
import Quotient

export *

signature:
	controlled unaccounted: SwingingBuffer -> Integer
	// a value was replaced that was neither loaded nor counted
	controlled lostSilently: SharedValue -> Boolean
	// as it was before the step
	controlled before_read: SwingingBuffer -> ArrayIndex
	controlled before_written: SwingingBuffer -> Integer
	controlled before_phase: Scheduler -> SchedulePhase

	derived writes: Scheduler -> Boolean
	derived isDue: Prod(Scheduler, SwingingBuffer) -> Boolean
	derived worksAsSlave: Scheduler -> Boolean
	derived isInside: Prod(Scheduler, SwingingBuffer) -> Boolean
	derived isAsking: Task -> Boolean

definitions:
	function writes($c in Scheduler) =
		action(scheduler_currentPhase($c)) = WRITING_ON_SB

	// It has come to its writing, and not yet written.
	function isDue($c in Scheduler, $b in SwingingBuffer) =
		if writes($c) and sharedMemory(scheduler_currentPhase($c)) = $b then
			sb_ctrlState(scheduler_currentPhase($c)) = MANAGING_SB and syncPriority(scheduler_currentPhase($c)) = SLAVE
		else
			false
		endif

	function worksAsSlave($c in Scheduler) =
		if contains({WRITING_ON_SB, READING_FROM_SB}, action(scheduler_currentPhase($c))) then
			syncPriority(scheduler_currentPhase($c)) = SLAVE
			and contains({WRITING, READING}, sb_ctrlState(scheduler_currentPhase($c)))
		else
			false
		endif

	function isInside($c in Scheduler, $b in SwingingBuffer) =
		sem_state(sem($b), scheduler_mainThread($c)) = EXECUTION

	function isAsking($t in Task) =
		(exists $s in Semaphore with sem_state($s, $t) = WAITING)

	rule r_remember =
		par
			forall $b in SwingingBuffer with true do
				par
					before_read($b) := indexRead($b)
					before_written($b) := sb_written($b)
				endpar
			forall $c in Scheduler with true do
				before_phase($c) := scheduler_currentPhase($c)
		endpar

	// What came of the step of the machines, told by what was before it.
	rule r_observe =
		seq
			forall $c in Scheduler with writes($c) and scheduler_currentPhase($c) != before_phase($c) do
				let ($b = sharedMemory(scheduler_currentPhase($c))) in
					unaccounted($b) := unaccounted($b) + 1
				endlet
			par
				forall $b in SwingingBuffer with true do
					par
						if indexRead($b) != before_read($b) then
							handedOver($b) := before_written($b)
						endif
						unaccounted($b) := unaccounted($b) - (sb_written($b) - before_written($b)) - sb_dropped($b)
					endpar
				// the quotient numbers a value that was not loaded yet by 1
				forall $v in SharedValue with true do
					lostSilently($v) := sv_sequence($v) = 2 and sv_receivedSequence($v) = 0 and sv_overwritten($v) = 0
			endpar
		endseq

	// what is not new is what was stored last
	invariant inv_valueNewest over sv_received:
		(forall $v in SharedValue with not sv_isNew($v) implies sv_received($v) = sv_value($v))
	invariant inv_valueCounted over lostSilently: (forall $v in SharedValue with not lostSilently($v))
	// who has updated the indexes is inside
	invariant inv_indexSection over indexUpdated:
		(forall $b in SwingingBuffer with
			indexUpdated($b)
			implies (exists $c in Scheduler with scheduler_currentPhase($c) = sb_master($b) and isInside($c, $b)))
	// a slave who works on an array is inside
	invariant inv_slaveInside over sb_ctrlState:
		(forall $c in Scheduler with worksAsSlave($c) implies isInside($c, sharedMemory(scheduler_currentPhase($c))))
	// what was pending is handed over there
	invariant inv_swapped over indexUpdated:
		(forall $b in SwingingBuffer with
			indexUpdated($b) implies (not sb_pending($b) and handedOver($b) = sb_written($b)))
	// as long as a reading lasts its array holds, untouched, what it gives
	invariant inv_whole over sb_data:
		(forall $b in SwingingBuffer with
			isDef(sb_readingArray($b))
			implies (
				sb_data($b, sb_readingArray($b)) = sb_received($b)
				and sb_sequence($b, sb_readingArray($b)) = sb_receivedSequence($b)))
	// what it gives is the newest datum that was handed over
	invariant inv_handedOver over sb_received:
		(forall $b in SwingingBuffer with isDef(sb_readingArray($b)) implies sb_receivedSequence($b) = handedOver($b))
	// each datum that was due to be written is written, or counted as dropped
	invariant inv_nothingLost over unaccounted:
		(forall $b in SwingingBuffer with
			unaccounted($b) = (if (exists $c in Scheduler with isDue($c, $b)) then 1 else 0 endif))
	// a buffer has two users, and nobody else comes to it
	invariant inv_twoUsers over scheduler_currentPhase:
		(forall $c in Scheduler with
			contains({WRITING_ON_SB, READING_FROM_SB}, action(scheduler_currentPhase($c)))
			implies (
				contains(sem_users(sem(sharedMemory(scheduler_currentPhase($c)))), scheduler_mainThread($c))
				and length(sem_users(sem(sharedMemory(scheduler_currentPhase($c))))) = 2))
	// nobody asks for a lock while holding another, so tasks never wait for each other in a circle
	invariant inv_oneLock over sem_state:
		(forall $t in Task with size({$s in Semaphore | sem_state($s, $t) != READY : $s}) <= 1)
