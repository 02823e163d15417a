/* Three tasks on a way, and data that carry the tick of their origin, for Ages: a source writes to a relay through a buffer, a queue or a
   shared value, and the relay to a sink through a value. Buffer and value carry the origin as their datum; beside the queue stands what is in
   it. What each task decides by is taken from there, and not from ../patterns/DataAges, which is held to it. */
module CarriedAges

import ../std/StandardLibrary
import ../std/CTLLibrary
import ../patterns/ControlTask
import ../patterns/DataAges
import Quotient
import SystemProperties
import SystemInTicks
import AgesInTicks

export *

signature:
	enum domain Channel = {BUFFER | QUEUE | VALUE}

	static source: Scheduler
	static relay: Scheduler
	static sink: Scheduler
	static source_task: Task
	static relay_task: Task
	static sink_task: Task
	static buffer: SwingingBuffer
	static lock: Semaphore
	static queue: MessageQueue
	static cell: SharedValue
	static outcome: SharedValue

	static source_work: SchedulePhase
	static source_write: SchedulePhase
	static source_wait: SchedulePhase
	static relay_read: SchedulePhase
	static relay_work: SchedulePhase
	static relay_write: SchedulePhase
	static relay_wait: SchedulePhase
	static sink_read: SchedulePhase
	static sink_work: SchedulePhase
	static sink_wait: SchedulePhase

	static to_relay: AgeHop
	static to_sink: AgeHop
	// from the source to the sink, and through the source alone
	static through: AgeWay
	static alone: AgeWay

	// asked for in the initial state
	monitored channel: Channel
	monitored isDecided: Boolean
	monitored readsFirst: Boolean
	monitored isTight: Boolean

	// when the source's cycle began; the origins of what is on its way through the queue, and of what the relay has read last
	controlled began: Integer
	controlled inQueue: Seq(Integer)
	controlled origin: Integer
	// what the relay has decided to write, and the sink to use
	controlled decided: Integer
	controlled used: Integer
	// as it was before the step
	controlled wasAt: Scheduler -> SchedulePhase

	controlled isAgeRight: AgeWay -> Boolean
	controlled isRemembered: Boolean
	controlled wasTooOld: Boolean

	derived lengthOf: Scheduler -> Integer
	derived hasGone: SchedulePhase -> Boolean
	derived isDone: Scheduler -> Boolean
	derived lastPhase: Scheduler -> SchedulePhase
	derived isAged: Prod(AgeWay, Scheduler, Integer) -> Boolean

definitions:
	// ticks of a cycle that waits for no lock
	function lengthOf($c in Scheduler) =
		switch $c
			case source:
				switch channel
					case BUFFER: if isDecided then 5 else 4 endif
					case QUEUE: 2
					otherwise if isDecided then 3 else 2 endif
				endswitch
			case relay: if channel = BUFFER then 4 else 3 endif
			otherwise 2
		endswitch

	function hasGone($p in SchedulePhase) =
		(exists $c in Scheduler with wasAt($c) = $p and scheduler_currentPhase($c) != $p)

	function lastPhase($c in Scheduler) =
		switch $c
			case source: source_write
			case relay: relay_write
			otherwise if nextPhase(sink_read) = sink_wait then sink_read else sink_work endif
		endswitch

	function isDone($c in Scheduler) =
		hasGone(lastPhase($c))

	// A cycle that ends, and has data, has their age; it is counted if it is too old.
	function isAged($w in AgeWay, $c in Scheduler, $from in Integer) =
		if isDone($c) and isDef($from) then
			way_oldest($w) = max(clock - $from, 1)
			and way_tooOld($w) = (if clock - $from > way_limit($w) then 11 else 10 endif)
		else
			way_oldest($w) = 1 and way_tooOld($w) = 10
		endif

	// The data carry their origin through buffer and value.
	rule r_stage =
		par
			sb_staged(buffer) := began
			sv_staged(cell) := began
			sv_staged(outcome) := if isDef(way_decided(through)) then decided else origin endif
			forall $c in Scheduler with true do
				wasAt($c) := scheduler_currentPhase($c)
			// each begins with another number, so that none is taken for another
			forall $w in AgeWay with true do
				par
					way_oldest($w) := 1
					way_tooOld($w) := 10
				endpar
		endpar

	rule r_carry($sent in Integer, $taken in Integer, $received in Integer) =
		let ($all = if mq_sent(queue) != $sent then append(inQueue, began) else inQueue endif) in
			par
				if hasGone(source_wait) or (isDone(source) and scheduler_currentPhase(source) = source_work) then
					began := clock
				endif
				if mq_taken(queue) != $taken then
					par
						origin := first($all)
						inQueue := tail($all)
					endpar
				else
					par
						inQueue := $all
						if isDef(hop_buffer(to_relay)) then
							origin := sb_received(buffer)
						endif
						if isDef(hop_value(to_relay)) then
							origin := sv_received(cell)
						endif
					endpar
				endif
				if hasGone(relay_work) then
					decided := origin
				endif
				if hasGone(sink_work) then
					used := $received
				endif
			endpar
		endlet

	rule r_check($received in Integer) =
		par
			isRemembered :=
				(forall $c in Scheduler with phaseBefore($c) = scheduler_currentPhase($c))
				and (forall $h in AgeHop with hop_written($h) = numberWritten($h) and hop_read($h) = numberRead($h))
			wasTooOld := way_tooOld(alone) = 11
			isAgeRight(alone) := isAged(alone, source, began)
			isAgeRight(through) :=
				isAged(
					through,
					sink,
					if isDef(way_decided(through)) then
						(if hasGone(sink_work) then $received else used endif)
					else
						$received
					endif)
		endpar

	rule r_shift =
		par
			began := since(began)
			inQueue := [$o in inQueue | true : since($o)]
			origin := since(origin)
			decided := since(decided)
			used := since(used)
		endpar

	// Arrays and slots do not begin with the first one, which is the one of all that is not looked for.
	rule r_turnOn =
		par
			forall $n in {0 : 2} with true do
				par
					sb_data(buffer, ($n + 2) mod 3) := sb_data(buffer, $n)
					sb_sequence(buffer, ($n + 2) mod 3) := sb_sequence(buffer, $n)
				endpar
			indexWrite(buffer) := (indexWrite(buffer) + 2) mod 3
			indexRead(buffer) := (indexRead(buffer) + 2) mod 3
			if isDef(sb_writingArray(buffer)) then
				sb_writingArray(buffer) := (sb_writingArray(buffer) + 2) mod 3
			endif
			if isDef(sb_readingArray(buffer)) then
				sb_readingArray(buffer) := (sb_readingArray(buffer) + 2) mod 3
			endif
			mq_sent(queue) := mq_sent(queue) + 1
			mq_taken(queue) := mq_taken(queue) + 1
			if isDef(hop_buffer(to_relay)) then
				forall $m in {0 : 2} with true do
					hop_slot(to_relay, ($m + 2) mod 3) := hop_slot(to_relay, $m)
			endif
			if isDef(hop_queue(to_relay)) then
				forall $k in {0 : 2} with true do
					hop_slot(to_relay, ($k + 1) mod 3) := hop_slot(to_relay, $k)
			endif
		endpar

	invariant inv_ages over way_oldest, way_tooOld: (forall $w in AgeWay with isAgeRight($w))
	// between two steps it is known how all was
	invariant inv_remembered over phaseBefore, hop_written, hop_read: isRemembered

	// what is to be noticed comes; of a buffer, a relay without slack leaves out every reading for which it would have to wait
	CTLSPEC ctlSpec_aged:
		(isDef(hop_buffer(to_relay)) and task_period(relay_task) = 4) or ag(ef(isDone(sink) and isDef(used)))
	// the source's own way is longer than is allowed if it writes to a buffer for two ticks
	CTLSPEC ctlSpec_tooOld: isDef(hop_buffer(to_relay)) and isDef(hop_decided(to_relay)) implies ag(ef(wasTooOld))
