/* A sender and a receiver of messages, in ticks: an asynchronous sender waits for room in the queue, a synchronous one as long as
   it has time, and then loses its message and counts it. The kinds of both tasks and the capacity are asked for in the initial
   state; elaborations last one tick or four. */
asm SendingInTicks

import ../std/StandardLibrary
import ../std/CTLLibrary
import ../patterns/ControlTask
import Quotient

signature:
	domain Capacity subsetof Integer

	static sender: Scheduler
	static receiver: Scheduler
	static sender_task: Task
	static receiver_task: Task
	static queue: MessageQueue

	static make: SchedulePhase
	static send: SchedulePhase
	static send_wait: SchedulePhase
	static receive: SchedulePhase
	static use: SchedulePhase
	static receive_wait: SchedulePhase

	monitored kindOf: Task -> TaskKind
	monitored capacity: Capacity
	monitored endsEarly: Scheduler -> Boolean

	// whether the last step was as it has to be: the sender's, and the receiver's
	controlled isSentRightly: Boolean
	controlled isTakenRightly: Boolean

	derived hasTime: Boolean

definitions:
	domain Capacity = {1 : 2}

	function hasTime =
		task_kind(sender_task) = ASYNCHRONOUS or task_timeInWait(sender_task) < 2

	rule r_setTimes =
		forall $c in Scheduler with action(scheduler_currentPhase($c)) = ELABORATING do
			time(scheduler_currentPhase($c)) := if endsEarly($c) then 1 else 4 endif

	// A sender leaves its phase at once unless the queue is full and it has time; then exactly one message was sent, or counted
	// as lost if there was no room.
	rule r_observeSender($phase in SchedulePhase, $sent in Integer, $isFull in Boolean, $waits in Boolean) =
		let ($leaves = $phase = send and not $waits) in
			isSentRightly :=
				(scheduler_currentPhase(sender) != $phase or $phase != send) = ($leaves or $phase != send)
				and mq_sent(queue) - $sent = (if $leaves and not $isFull then 1 else 0 endif)
				and mq_refused(queue) = (if $leaves and $isFull then 1 else 0 endif)
				and task_totalWait(sender_task) = (if $waits then 1 else 0 endif)
		endlet

	// A receiver takes a message whenever it begins, if there is one; an asynchronous one begins when there is.
	rule r_observeReceiver($phase in SchedulePhase, $taken in Integer, $isEmpty in Boolean) =
		let ($begins = scheduler_currentPhase(receiver) = receive and $phase != receive) in
			isTakenRightly :=
				mq_taken(queue) - $taken = (if $begins and not $isEmpty then 1 else 0 endif)
				and ($phase = receive_wait and task_kind(receiver_task) = ASYNCHRONOUS implies $begins = not $isEmpty)
		endlet

	invariant inv_sending over mq_sent, mq_refused: isSentRightly
	invariant inv_receiving over mq_taken: isTakenRightly
	invariant inv_sound over mq_sent, mq_taken: mq_sound(queue)
	invariant inv_watchdog over task_timeInWait:
		task_kind(sender_task) = SYNCHRONOUS implies task_timeInWait(sender_task) <= 2

	// each of them goes on, whatever the other does
	CTLSPEC ctlSpec_sends: ag(af(scheduler_currentPhase(sender) = make))
	CTLSPEC ctlSpec_receives: ag(af(scheduler_currentPhase(receiver) = receive))

	main rule r_Main =
		let ($sending = scheduler_currentPhase(sender),
			$receiving = scheduler_currentPhase(receiver),
			$sent = mq_sent(queue),
			$taken = mq_taken(queue),
			$isFull = $sent - $taken = mq_capacity(queue),
			$waits = $sending = send and $isFull and hasTime) in
			seq
				r_setTimes[]
				par
					forall $c in Scheduler with true do r_scheduler_execute[$c]
					clock := clock + 1
				endpar
				par
					r_observeSender[$sending, $sent, $isFull, $waits]
					r_observeReceiver[$receiving, $taken, $sent = $taken]
				endpar
				r_forget[]
			endseq
		endlet

default init s0:
	function clock = 0
	function task_kind($t in Task) = kindOf($t)
	function task_period($t in Task) = if $t = sender_task then 8 else 7 endif
	function task_timeForElaboration($t in Task) = if $t = sender_task then 6 else 7 endif
	function task_periodStart($t in Task) =
		if kindOf($t) = SYNCHRONOUS then (if $t = sender_task then -8 else -7 endif) else 0 endif
	function task_timeInWait($t in Task) = 0
	function task_cycles($t in Task) = 0
	function task_deadlinesMet($t in Task) = 0
	function task_deadlinesMissed($t in Task) = 0
	function task_totalWait($t in Task) = 0
	function task_longestWait($t in Task) = 0
	function task_skipped($t in Task) = 0

	function mq_capacity($q in MessageQueue) = capacity
	function mq_staged($q in MessageQueue) = 0
	function mq_slot($q in MessageQueue, $n in QueueSlot) = 0
	function mq_sent($q in MessageQueue) = 0
	function mq_refused($q in MessageQueue) = 0
	function mq_received($q in MessageQueue) = 0
	function mq_taken($q in MessageQueue) = 0

	function scheduler_mainThread($c in Scheduler) = if $c = sender then sender_task else receiver_task endif
	function scheduler_currentPhase($c in Scheduler) = if $c = sender then send_wait else receive_wait endif
	function scheduler_actionStart($c in Scheduler) = 0
	function action($p in SchedulePhase) =
		switch $p
			case make: ELABORATING
			case send: SENDING
			case receive: RECEIVING
			case use: ELABORATING
			otherwise WAITING_TRIGGER
		endswitch
	function time($p in SchedulePhase) = 1
	function nextPhase($p in SchedulePhase) =
		switch $p
			case make: send
			case send: send_wait
			case send_wait: make
			case receive: use
			case use: receive_wait
			otherwise receive
		endswitch
	function messageQueue($p in SchedulePhase) =
		if $p = send or $p = receive or $p = receive_wait then queue else undef endif
	function sharedMemory($p in SchedulePhase) = undef
	function sharedValue($p in SchedulePhase) = undef
	function elaborationRule($p in SchedulePhase) = undef
	function isSentRightly = true
	function isTakenRightly = true
