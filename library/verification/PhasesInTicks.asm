/* The phases of one task, to the tick, whatever is at the other ends of its channels: it elaborates, sends, receives, stores or loads, and
   then elaborates or not, in both kinds of task. It begins with its period, with a message, with a new value, with both or with
   either of them, or at once. Each tick it is
   held to what PhaseTimeline tells beside it. */
asm PhasesInTicks

import ../std/StandardLibrary
import ../std/CTLLibrary
import ../patterns/ControlTask
import Quotient
import PhaseTimeline
import PhaseProperties

signature:

definitions:
	main rule r_Main =
		let ($sent = mq_sent(outbox),
			$taken = mq_taken(inbox),
			$stored = sv_sequence(state),
			$hasMail = mq_sent(inbox) > mq_taken(inbox),
			$hasRoom = mq_sent(outbox) - mq_taken(outbox) < mq_capacity(outbox)) in
			seq
				r_note[]
				r_expectNothing[]
				r_expect[$hasMail, $hasRoom]
				par
					r_scheduler_execute[actor]
					r_others[]
					clock := clock + 1
				endpar
				r_observe[$sent, $taken, $stored]
				r_forget[]
				r_passTime[]
			endseq
		endlet

default init s0:
	function clock = 0
	function task_kind($t in Task) = kind
	function task_period($t in Task) =
		if kind = SYNCHRONOUS then lengthOf(sort) + lengthOfSecond + slack else undef endif
	function task_timeForElaboration($t in Task) =
		if kind = SYNCHRONOUS then task_period($t) - patience else undef endif
	function task_periodStart($t in Task) = if kind = SYNCHRONOUS then -task_period($t) else 0 endif
	function task_timeInWait($t in Task) = 0
	function task_cycles($t in Task) = 0
	function task_deadlinesMet($t in Task) = 0
	function task_deadlinesMissed($t in Task) = 0
	function task_totalWait($t in Task) = 0
	function task_longestWait($t in Task) = 0
	function task_skipped($t in Task) = 0

	function mq_capacity($q in MessageQueue) = 1
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

	function scheduler_mainThread($c in Scheduler) = task
	function scheduler_currentPhase($c in Scheduler) = rest
	function scheduler_actionStart($c in Scheduler) = -9
	function action($p in SchedulePhase) =
		switch $p
			case one: sort
			case two: ELABORATING
			otherwise WAITING_TRIGGER
		endswitch
	function time($p in SchedulePhase) = if $p = two then 1 else 2 endif
	function nextPhase($p in SchedulePhase) =
		switch $p
			case one: if hasSecond then two else rest endif
			case two: rest
			otherwise one
		endswitch
	function sharedMemory($p in SchedulePhase) = undef
	// a phase has a queue and a value at hand, and uses the one that its action is for
	function messageQueue($p in SchedulePhase) =
		switch $p
			case one: if sort = SENDING then outbox else inbox endif
			case rest: if kind = ASYNCHRONOUS and waitsFor = MAIL then inbox else undef endif
			case byMail: inbox
			otherwise undef
		endswitch
	function sharedValue($p in SchedulePhase) =
		switch $p
			case one: if sort = LOADING then level else state endif
			case rest: if kind = ASYNCHRONOUS and waitsFor = LEVEL then level else undef endif
			case byLevel: level
			otherwise undef
		endswitch
	function awaited($p in SchedulePhase) =
		if $p = rest and kind = ASYNCHRONOUS and (waitsFor = BOTH or waitsFor = EITHER) then
			{byMail, byLevel}
		else
			undef
		endif
	function awaitsAll($p in SchedulePhase) = waitsFor = BOTH
	function elaborationRule($p in SchedulePhase) = if hasSecond then <<r_elaborateOnce(Scheduler)>> else undef endif

	function awaits = if kind = ASYNCHRONOUS then waitsFor else NOTHING endif
	function mayWait = if kind = SYNCHRONOUS then patience else 0 endif
	function present = rest
	function left = 0
	function age = if kind = SYNCHRONOUS then lengthOf(sort) + lengthOfSecond + slack else 0 endif
	function waited = 0
	function levelIsNew = false
	function mustBeFresh = false
	function elaborates = false
	function takes = false
	function stores = false
	function sends = false
	function refuses = false
	function waits = false
	function ends = false
	function isRight = true
	function elaborated = 0
