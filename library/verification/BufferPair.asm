/* One producer and one consumer on one swinging buffer, made finite: what the models of the eight pairs of machines share.

   The machines are those of ../patterns, untouched. Between two of their steps the state is written down in the smallest
   form that behaves alike: the rules compare times with `clock` only, so all times are shifted until it is 0; they ask of
   sequence numbers only which is the greater, so each becomes its rank among those in use; of two counters that
   `sb_accounted` balances the same is taken away on both sides, so a difference stays one; statistics begin anew.

   Beside them stands what nobody in the program knows: the newest datum, the one handed over last, and the data that
   were made and not yet written or counted as dropped. */
module BufferPair

import ../std/StandardLibrary
import ../std/CTLLibrary
import ../patterns/ControlTask

export *

signature:
	domain Datum subsetof Integer

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

	// The pair, chosen once: asked for in the initial state
	monitored kindOf: Task -> TaskKind
	monitored readerIsMaster: Boolean
	monitored threeArrays: Boolean

	// What nobody in the program knows
	controlled newestWritten: Datum
	controlled handedOver: Datum
	controlled unaccounted: Integer
	// what was handed over last was not read yet; what the last reading or skipping had to say of its datum
	controlled isUnread: Boolean
	controlled mustBeFresh: Boolean

	static owner: Scheduler -> Task
	static phaseAction: SchedulePhase -> PhaseAction
	static phaseAfter: SchedulePhase -> SchedulePhase
	derived master: Scheduler
	derived numbers: Powerset(Integer)
	derived rank: Integer -> Integer
	derived isMade: Boolean
	derived isInside: Scheduler -> Boolean
	derived isWaiting: Scheduler -> Boolean

definitions:
	domain Datum = {0 : 2}

	function owner($c in Scheduler) =
		if $c = producer then producer_task else consumer_task endif

	function phaseAction($p in SchedulePhase) =
		switch $p
			case produce_elaborate: ELABORATING
			case produce_write: WRITING_ON_SB
			case consume_read: READING_FROM_SB
			case consume_elaborate: ELABORATING
			otherwise WAITING_TRIGGER
		endswitch

	function phaseAfter($p in SchedulePhase) =
		switch $p
			case produce_elaborate: produce_write
			case produce_write: produce_wait
			case produce_wait: produce_elaborate
			case consume_read: consume_elaborate
			case consume_elaborate: consume_wait
			otherwise consume_read
		endswitch

	function master =
		if sb_master(buffer) = produce_write then producer else consumer endif

	function numbers =
		{
			sb_written(buffer), sb_receivedSequence(buffer), sb_sequence(buffer, 0), sb_sequence(buffer, 1),
			sb_sequence(buffer, 2)}

	function rank($n in Integer) =
		size({$m in numbers | $m < $n : $m})

	// A datum was made, and not yet written or given up.
	function isMade =
		scheduler_currentPhase(producer) = produce_elaborate
		or (
			scheduler_currentPhase(producer) = produce_write
			and master != producer
			and sb_ctrlState(produce_write) = MANAGING_SB)

	function isInside($c in Scheduler) =
		sem_state(lock, owner($c)) = EXECUTION

	function isWaiting($c in Scheduler) =
		sem_state(lock, owner($c)) = WAITING

	rule r_make($c in Scheduler) =
		par
			sb_staged(buffer) := (sb_staged(buffer) + 1) mod 3
			unaccounted := unaccounted + 1
		endpar

	// What came of the step of the machines, told by what was written and read before it.
	rule r_observe($written in Integer, $read in Integer, $wasReading in Boolean) =
		par
			// a reading that begins has what was handed over before; who goes on without one has nothing new
			if isDef(sb_readingArray(buffer)) and not $wasReading then
				par
					mustBeFresh := isUnread
					isUnread := indexRead(buffer) != $read
				endpar
			else
				par
					if task_skipped(consumer_task) > 0 then
						mustBeFresh := false
					endif
					if indexRead(buffer) != $read then
						isUnread := true
					endif
				endpar
			endif
			if sb_written(buffer) != $written then
				newestWritten := sb_staged(buffer)
			endif
			if indexRead(buffer) != $read then
				handedOver := newestWritten
			endif
			unaccounted := unaccounted - (sb_written(buffer) - $written) - sb_dropped(buffer)
		endpar

	rule r_renumber =
		let ($less = sb_written(buffer) - rank(sb_written(buffer)) - sb_overwritten(buffer)) in
			par
				sb_written(buffer) := rank(sb_written(buffer))
				sb_receivedSequence(buffer) := rank(sb_receivedSequence(buffer))
				forall $n in {0 : 2} with true do sb_sequence(buffer, $n) := rank(sb_sequence(buffer, $n))
				sb_overwritten(buffer) := 0
				sb_swaps(buffer) := sb_swaps(buffer) - $less
				sb_unread(buffer) := 0
				sb_delivered(buffer) := sb_delivered(buffer) + sb_unread(buffer) - $less
				sb_dropped(buffer) := 0
			endpar
		endlet

	rule r_beginStatistics =
		forall $t in Task with true do
			par
				task_cycles($t) := 0
				task_deadlinesMet($t) := 0
				task_totalWait($t) := 0
				task_longestWait($t) := 0
				task_skipped($t) := 0
			endpar

	// Mutual exclusion on the index section; who has updated the indexes is inside.
	invariant inv_mutualExclusion over sem_state: sem_sound(lock) and not (isInside(producer) and isInside(consumer))
	invariant inv_indexSection over indexUpdated: indexUpdated(buffer) implies isInside(master)
	// and works on its array outside, so that the slave need not wait for that
	invariant inv_masterOutside over sb_ctrlState:
		contains({WRITING, READING}, sb_ctrlState(scheduler_currentPhase(master))) implies not isInside(master)
	// what was pending is handed over there
	invariant inv_swapped over indexUpdated:
		indexUpdated(buffer) implies (not sb_pending(buffer) and handedOver = newestWritten)
	invariant inv_disjoint over sb_writingArray, sb_readingArray: sb_disjoint(buffer)
	invariant inv_newest over sb_sequence: sb_newest(buffer)
	invariant inv_accounted over sb_written: sb_accounted(buffer)
	// as long as a reading lasts its array holds, untouched, what it gives
	invariant inv_whole over sb_data:
		isDef(sb_readingArray(buffer))
		implies (
			sb_data(buffer, sb_readingArray(buffer)) = sb_received(buffer)
			and sb_sequence(buffer, sb_readingArray(buffer)) = sb_receivedSequence(buffer))
	// what it gives is the newest datum that was handed over
	invariant inv_handedOver over sb_received: isDef(sb_readingArray(buffer)) implies sb_received(buffer) = handedOver
	// whether it is new, is told truly, also when a reading is left out
	invariant inv_fresh over sb_fresh: sb_fresh(buffer) = mustBeFresh
	// each datum that was made is written, or counted as dropped
	invariant inv_nothingLost over unaccounted: unaccounted = (if isMade then 1 else 0 endif)
