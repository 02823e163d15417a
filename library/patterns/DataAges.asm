/* How old data get on their way through channels, to the tick. It stands beside the machines of ControlTask and changes nothing of
   theirs: an application runs `r_ages` after each step, in sequence.

   A way begins when a cycle of its first component begins, leads over channels, and ends when a cycle of its last component ends. Each
   of its channels is a hop. A component takes what it has read last when the elaboration ends in which its next results are decided;
   without an elaboration, when it writes. The age of a result is the time from the beginning of the way to its end. A cycle with which
   no datum has come by then has no age. */
module DataAges

import ../std/StandardLibrary
import Task
import SwingingBuffer
import MessageQueue
import SharedValue
import Scheduler

export *

signature:
	// a channel as a part of a way; ways that begin alike share it
	abstract domain AgeHop
	abstract domain AgeWay

	// Configuration
	// undef: a way begins in the writer's cycle
	controlled hop_before: AgeHop -> AgeHop
	controlled hop_writer: AgeHop -> Scheduler
	// the elaboration in which the writer decides what it writes; undef: there is none
	controlled hop_decided: AgeHop -> SchedulePhase
	// the channel: one of them
	controlled hop_buffer: AgeHop -> SwingingBuffer
	controlled hop_queue: AgeHop -> MessageQueue
	controlled hop_value: AgeHop -> SharedValue
	// undef: the way has no channel, its component has both ends
	controlled way_hop: AgeWay -> AgeHop
	controlled way_end: AgeWay -> Scheduler
	controlled way_decided: AgeWay -> SchedulePhase
	// the age that is allowed
	controlled way_limit: AgeWay -> Integer

	// When the data came that are on their way
	controlled cycleStart: Scheduler -> Integer
	controlled hop_taken: AgeHop -> Integer
	controlled hop_slot: Prod(AgeHop, QueueSlot) -> Integer
	controlled hop_received: AgeHop -> Integer
	controlled way_taken: AgeWay -> Integer

	// As it was after the step before
	controlled phaseBefore: Scheduler -> SchedulePhase
	controlled hop_written: AgeHop -> Integer
	controlled hop_read: AgeHop -> Integer

	// What came of it
	controlled way_oldest: AgeWay -> Integer
	controlled way_tooOld: AgeWay -> Integer

	derived hasLeft: Prod(Scheduler, SchedulePhase) -> Boolean
	derived hasEnded: Scheduler -> Boolean
	derived hasBegun: Scheduler -> Boolean
	derived numberWritten: AgeHop -> Integer
	derived numberRead: AgeHop -> Integer
	derived slotWritten: AgeHop -> Integer
	derived slotRead: AgeHop -> Integer
	derived origin: AgeHop -> Integer
	derived wayOrigin: AgeWay -> Integer

definitions:
	function hasLeft($c in Scheduler, $p in SchedulePhase) =
		phaseBefore($c) = $p and scheduler_currentPhase($c) != $p

	// The last phase of its cycle is over.
	function hasEnded($c in Scheduler) =
		scheduler_currentPhase($c) != phaseBefore($c) and action(nextPhase(phaseBefore($c))) = WAITING_TRIGGER

	// A cycle begins in the phase that follows the waiting one.
	function hasBegun($c in Scheduler) =
		scheduler_currentPhase($c) != phaseBefore($c)
		and (exists $p in SchedulePhase with
			action($p) = WAITING_TRIGGER and nextPhase($p) = scheduler_currentPhase($c))

	function numberWritten($h in AgeHop) =
		if isDef(hop_buffer($h)) then
			sb_written(hop_buffer($h))
		else
			if isDef(hop_queue($h)) then mq_sent(hop_queue($h)) else sv_sequence(hop_value($h)) endif
		endif

	function numberRead($h in AgeHop) =
		if isDef(hop_buffer($h)) then
			sb_receivedSequence(hop_buffer($h))
		else
			if isDef(hop_queue($h)) then mq_taken(hop_queue($h)) else sv_receivedSequence(hop_value($h)) endif
		endif

	function slotWritten($h in AgeHop) =
		if isDef(hop_buffer($h)) then
			sb_writingArray(hop_buffer($h))
		else
			if isDef(hop_queue($h)) then (mq_sent(hop_queue($h)) - 1) mod mq_capacity(hop_queue($h)) else 0 endif
		endif

	function slotRead($h in AgeHop) =
		if isDef(hop_buffer($h)) then
			sb_readingArray(hop_buffer($h))
		else
			if isDef(hop_queue($h)) then (mq_taken(hop_queue($h)) - 1) mod mq_capacity(hop_queue($h)) else 0 endif
		endif

	// When that came which the writer of a hop has at hand.
	function origin($h in AgeHop) =
		if isDef(hop_before($h)) then hop_received(hop_before($h)) else cycleStart(hop_writer($h)) endif

	function wayOrigin($w in AgeWay) =
		if isDef(way_hop($w)) then hop_received(way_hop($w)) else cycleStart(way_end($w)) endif

	// What is decided rests on what was read before.
	rule r_take =
		par
			forall $h in AgeHop with isDef(hop_decided($h)) do
				if hasLeft(hop_writer($h), hop_decided($h)) then
					hop_taken($h) := origin($h)
				endif
			forall $w in AgeWay with true do
				if isDef(way_decided($w)) then
					if hasLeft(way_end($w), way_decided($w)) then
						way_taken($w) := wayOrigin($w)
					endif
				else
					way_taken($w) := wayOrigin($w)
				endif
		endpar

	rule r_arrive =
		forall $w in AgeWay with hasEnded(way_end($w)) do
			if isDef(way_taken($w)) then
				let ($age = clock - way_taken($w)) in
					par
						way_oldest($w) := max(way_oldest($w), $age)
						if $age > way_limit($w) then
							way_tooOld($w) := way_tooOld($w) + 1
						endif
						way_taken($w) := undef
					endpar
				endlet
			endif

	rule r_pass($h in AgeHop) =
		par
			hop_slot($h, slotWritten($h)) := if isDef(hop_decided($h)) then hop_taken($h) else origin($h) endif
			hop_taken($h) := undef
		endpar

	// Messages and values are written when a phase ends. What begins in the same step, or is read in it, comes after that, and the
	// reader of the channel does not see it yet.
	rule r_begin =
		par
			forall $c in Scheduler with hasBegun($c) do
				cycleStart($c) := clock
			forall $h in AgeHop with numberRead($h) != hop_read($h) do
				hop_received($h) := hop_slot($h, slotRead($h))
			forall $g in AgeHop with isUndef(hop_buffer($g)) and numberWritten($g) != hop_written($g) do r_pass[$g]
		endpar

	// A buffer is written when a phase begins, which may be the first one of a cycle.
	rule r_passBuffers =
		forall $h in AgeHop with isDef(hop_buffer($h)) and numberWritten($h) != hop_written($h) do r_pass[$h]

	rule r_rememberAges =
		par
			forall $c in Scheduler with true do
				phaseBefore($c) := scheduler_currentPhase($c)
			forall $h in AgeHop with true do
				par
					hop_written($h) := numberWritten($h)
					hop_read($h) := numberRead($h)
				endpar
		endpar

	// What a step of the tasks does to the ages.
	rule r_ages =
		seq
			r_take[]
			r_arrive[]
			r_begin[]
			r_passBuffers[]
			r_rememberAges[]
		endseq
