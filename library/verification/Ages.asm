/* How old data get, as ../patterns/DataAges tells, against data that carry the tick of their origin. A task writes to a second one through
   a buffer, a queue or a shared value, and the second one to a third through a value. What each decides at the end of its elaboration, or
   when it writes, is asked for in the initial state, and so is whether the second one reads before it elaborates or after. */
asm Ages

import ../std/StandardLibrary
import ../std/CTLLibrary
import ../patterns/ControlTask
import ../patterns/DataAges
import Quotient
import SystemProperties
import SystemInTicks
import AgesInTicks
import CarriedAges

signature:

definitions:
	main rule r_Main =
		let ($sent = mq_sent(queue), $taken = mq_taken(queue), $received = sv_received(outcome)) in
			seq
				r_stage[]
				par
					forall $c in Scheduler with true do r_scheduler_execute[$c]
					r_sem_arbitrate[lock]
					clock := clock + 1
				endpar
				r_ages[]
				r_observe[]
				r_check[$received]
				r_carry[$sent, $taken, $received]
				r_shift[]
				par
					r_forget[]
					r_forgetAges[]
				endpar
				r_turnOn[]
				r_remember[]
				r_rememberAges[]
			endseq
		endlet

default init s0:
	function clock = 0
	function task_kind($t in Task) = SYNCHRONOUS
	function task_period($t in Task) =
		switch $t
			case source_task: lengthOf(source) + (if isTight then 0 else 1 endif)
			case relay_task: lengthOf(relay) + (if isTight then 0 else 1 endif)
			otherwise 3
		endswitch
	function task_timeForElaboration($t in Task) =
		switch $t
			case source_task: lengthOf(source)
			case relay_task: lengthOf(relay)
			otherwise 2
		endswitch
	function task_periodStart($t in Task) = -task_period($t)
	function task_timeInWait($t in Task) = 0
	function task_cycles($t in Task) = 0
	function task_deadlinesMet($t in Task) = 0
	function task_deadlinesMissed($t in Task) = 0
	function task_totalWait($t in Task) = 0
	function task_longestWait($t in Task) = 0
	function task_skipped($t in Task) = 0

	function sem_permits($s in Semaphore) = 1
	function sem_users($s in Semaphore) = [source_task, relay_task]
	function sem_state($s in Semaphore, $t in Task) = READY
	function sem_illegalPost($s in Semaphore) = false
	function semaq($s in Semaphore) = []

	function dimension($b in SwingingBuffer) = 3
	function sem($b in SwingingBuffer) = lock
	function sb_master($b in SwingingBuffer) = source_write
	function indexWrite($b in SwingingBuffer) = 0
	function indexRead($b in SwingingBuffer) = 2
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
	function mq_capacity($q in MessageQueue) = 3
	function mq_staged($q in MessageQueue) = 0
	function mq_slot($q in MessageQueue, $n in QueueSlot) = 0
	function mq_sent($q in MessageQueue) = 0
	function mq_refused($q in MessageQueue) = 0
	function mq_received($q in MessageQueue) = 0
	function mq_taken($q in MessageQueue) = 0
	function sv_sequence($v in SharedValue) = 0
	function sv_overwritten($v in SharedValue) = 0
	function sv_receivedSequence($v in SharedValue) = 0
	function sv_fresh($v in SharedValue) = false

	function scheduler_mainThread($c in Scheduler) =
		switch $c
			case source: source_task
			case relay: relay_task
			otherwise sink_task
		endswitch
	function scheduler_currentPhase($c in Scheduler) =
		switch $c
			case source: source_wait
			case relay: relay_wait
			otherwise sink_wait
		endswitch
	function scheduler_actionStart($c in Scheduler) = 0
	function action($p in SchedulePhase) =
		switch $p
			case source_work: ELABORATING
			case source_write:
				switch channel
					case BUFFER: WRITING_ON_SB
					case QUEUE: SENDING
					otherwise STORING
				endswitch
			case relay_read:
				switch channel
					case BUFFER: READING_FROM_SB
					case QUEUE: RECEIVING
					otherwise LOADING
				endswitch
			case relay_work: ELABORATING
			case relay_write: STORING
			case sink_read: LOADING
			case sink_work: ELABORATING
			otherwise WAITING_TRIGGER
		endswitch
	function time($p in SchedulePhase) = if $p = source_write and isDecided then 2 else 1 endif
	function nextPhase($p in SchedulePhase) =
		switch $p
			case source_work: source_write
			case source_write: source_wait
			case source_wait: source_work
			case relay_read: if readsFirst then relay_work else relay_write endif
			case relay_work: if readsFirst then relay_write else relay_read endif
			case relay_write: relay_wait
			case relay_wait: if readsFirst then relay_read else relay_work endif
			case sink_read: if readsFirst then sink_work else sink_wait endif
			case sink_work: if readsFirst then sink_wait else sink_read endif
			otherwise if readsFirst then sink_read else sink_work endif
		endswitch
	function sharedMemory($p in SchedulePhase) =
		if channel = BUFFER and ($p = source_write or $p = relay_read) then buffer else undef endif
	function messageQueue($p in SchedulePhase) =
		if channel = QUEUE and ($p = source_write or $p = relay_read) then queue else undef endif
	function sharedValue($p in SchedulePhase) =
		if $p = relay_write or $p = sink_read then
			outcome
		else
			if channel = VALUE and ($p = source_write or $p = relay_read) then cell else undef endif
		endif
	function elaborationRule($p in SchedulePhase) = undef

	function hop_before($h in AgeHop) = if $h = to_sink then to_relay else undef endif
	function hop_writer($h in AgeHop) = if $h = to_sink then relay else source endif
	function hop_decided($h in AgeHop) =
		if isDecided then (if $h = to_sink then relay_work else source_work endif) else undef endif
	function hop_buffer($h in AgeHop) = if $h = to_relay and channel = BUFFER then buffer else undef endif
	function hop_queue($h in AgeHop) = if $h = to_relay and channel = QUEUE then queue else undef endif
	function hop_value($h in AgeHop) =
		if $h = to_sink then outcome else if channel = VALUE then cell else undef endif endif
	function way_hop($w in AgeWay) = if $w = through then to_sink else undef endif
	function way_end($w in AgeWay) = if $w = through then sink else source endif
	function way_decided($w in AgeWay) =
		if isDecided then (if $w = through then sink_work else source_work endif) else undef endif
	function way_limit($w in AgeWay) = if $w = through then 9 else 3 endif
	function way_oldest($w in AgeWay) = 0
	function way_tooOld($w in AgeWay) = 0
	function phaseBefore($c in Scheduler) = scheduler_currentPhase($c)
	function hop_written($h in AgeHop) = 0
	function hop_read($h in AgeHop) = 0
	function tooOld = 40

	function inQueue = []
	function handedOver($b in SwingingBuffer) = 0
	function unaccounted($b in SwingingBuffer) = 0
	function before_read($b in SwingingBuffer) = indexRead($b)
	function before_written($b in SwingingBuffer) = 0
	function before_phase($c in Scheduler) = scheduler_currentPhase($c)
	function lostSilently($v in SharedValue) = false
	function isAgeRight($w in AgeWay) = true
	function isRemembered = true
	function wasTooOld = false
