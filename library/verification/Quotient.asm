/* A system of control tasks, made finite: between two steps what its rules cannot tell apart is made the same.

   The machines are those of ../patterns and of the system, untouched. The rules compare times with `clock` only, so all
   times, and data, which are stamps, are shifted until it is 0; they ask of sequence numbers only which is the greater, so
   each becomes its rank among those in use; of two counters that `sb_accounted` balances the same is taken away on both
   sides; they tell the arrays of a buffer apart only by the way round the ring, which is turned until the producer's comes
   first; of a queue they ask how long it is. Arrays that nobody will read are emptied, timers that nobody will look at
   are stopped, statistics begin anew. */
module Quotient

import ../std/StandardLibrary
import ../patterns/ControlTask

export *

signature:
	// Ticks longer ago are alike: of data, where the bounds on their ages are far below, and, with two periods more, of
	// periods and waitings, where far less violates what a system has to keep.
	static oldest: Integer

	// The number that was handed over last: a reading has to give just this one.
	controlled handedOver: SwingingBuffer -> Integer

	derived isAlive: Prod(SwingingBuffer, Integer) -> Boolean
	derived numbers: SwingingBuffer -> Powerset(Integer)
	static rank: Prod(Powerset(Integer), Integer) -> Integer
	derived stamp: Integer -> Integer
	derived isTimed: Scheduler -> Boolean

definitions:
	function oldest = 1000

	// Somebody works on the array, or may read it.
	function isAlive($b in SwingingBuffer, $n in Integer) =
		$n = indexRead($b)
		or ($n = indexWrite($b) and sb_pending($b))
		or $n = sb_readingArray($b)
		or $n = sb_writingArray($b)

	function numbers($b in SwingingBuffer) =
		union(
			{sb_written($b), sb_receivedSequence($b), handedOver($b)},
			{$n in {0 : dimension($b) - 1} | isAlive($b, $n) : sb_sequence($b, $n)})

	function rank($all in Powerset(Integer), $number in Integer) =
		size({$m in $all | $m < $number : $m})

	function stamp($tick in Integer) =
		if isDef($tick) then max($tick - clock, -oldest) else undef endif

	// Its timer is looked at.
	function isTimed($c in Scheduler) =
		switch action(scheduler_currentPhase($c))
			case WAITING_TRIGGER: false
			case SENDING: false
			case WRITING_ON_SB: sb_ctrlState(scheduler_currentPhase($c)) = WRITING
			case READING_FROM_SB: sb_ctrlState(scheduler_currentPhase($c)) = READING
			otherwise true
		endswitch

	rule r_turn($b in SwingingBuffer, $all in Powerset(Integer)) =
		let ($first = indexWrite($b), $arrays = dimension($b)) in
			par
				forall $n in {0 : $arrays - 1} with true do
					let ($m = ($n + $first) mod $arrays) in
						if isAlive($b, $m) then
							par
								sb_data($b, $n) := stamp(sb_data($b, $m))
								sb_sequence($b, $n) := rank($all, sb_sequence($b, $m))
							endpar
						else
							par
								sb_data($b, $n) := undef
								sb_sequence($b, $n) := 0
							endpar
						endif
					endlet
				indexWrite($b) := 0
				indexRead($b) := (indexRead($b) + $arrays - $first) mod $arrays
				if isDef(sb_writingArray($b)) then
					sb_writingArray($b) := (sb_writingArray($b) + $arrays - $first) mod $arrays
				endif
				if isDef(sb_readingArray($b)) then
					sb_readingArray($b) := (sb_readingArray($b) + $arrays - $first) mod $arrays
				endif
			endpar
		endlet

	rule r_renumber($b in SwingingBuffer, $all in Powerset(Integer)) =
		let ($written = rank($all, sb_written($b)), $less = sb_written($b) - $written - sb_overwritten($b)) in
			par
				sb_written($b) := $written
				sb_receivedSequence($b) := rank($all, sb_receivedSequence($b))
				handedOver($b) := rank($all, handedOver($b))
				sb_staged($b) := stamp(sb_staged($b))
				sb_received($b) := stamp(sb_received($b))
				sb_overwritten($b) := 0
				sb_swaps($b) := sb_swaps($b) - $less
				sb_unread($b) := 0
				sb_delivered($b) := sb_delivered($b) + sb_unread($b) - $less
				sb_dropped($b) := 0
			endpar
		endlet

	rule r_shorten($q in MessageQueue) =
		par
			mq_sent($q) := mq_length($q)
			mq_taken($q) := 0
			mq_staged($q) := 0
			mq_received($q) := 0
			mq_refused($q) := 0
			forall $n in {0 : mq_capacity($q) - 1} with true do mq_slot($q, $n) := 0
		endpar

	rule r_shiftValue($v in SharedValue) =
		par
			sv_staged($v) := stamp(sv_staged($v))
			sv_value($v) := stamp(sv_value($v))
			sv_received($v) := stamp(sv_received($v))
			sv_sequence($v) := if sv_isNew($v) then 1 else 0 endif
			sv_receivedSequence($v) := 0
			sv_overwritten($v) := 0
		endpar

	rule r_shiftTask($t in Task) =
		par
			if task_kind($t) = SYNCHRONOUS then
				par
					task_periodStart($t) := max(task_periodStart($t) - clock, -(oldest + 2 * task_period($t)))
					task_timeInWait($t) := min(task_timeInWait($t), oldest + 2 * task_period($t))
				endpar
			else
				task_timeInWait($t) := 0
			endif
			task_cycles($t) := 0
			task_deadlinesMet($t) := 0
			// one is too many; how many more does not matter
			task_deadlinesMissed($t) := min(task_deadlinesMissed($t), 1)
			task_totalWait($t) := 0
			task_longestWait($t) := 0
			task_skipped($t) := 0
		endpar

	rule r_forget =
		par
			clock := 0
			forall $b in SwingingBuffer with true do
				let ($all = numbers($b)) in
					par
						r_turn[$b, $all]
						r_renumber[$b, $all]
					endpar
				endlet
			forall $q in MessageQueue with true do r_shorten[$q]
			forall $v in SharedValue with true do r_shiftValue[$v]
			forall $t in Task with true do r_shiftTask[$t]
			forall $c in Scheduler with true do
				scheduler_actionStart($c) := if isTimed($c) then scheduler_actionStart($c) - clock else 0 endif
		endpar
