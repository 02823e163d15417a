/* Producer and consumer by message passing, both asynchronous: the producer waits for room in the
   queue, the consumer starts when there is a message. */
asm QueuePair

import ../../std/StandardLibrary
import ../ControlTask

signature:
	static producer: Scheduler
	static consumer: Scheduler
	static producer_task: Task
	static consumer_task: Task
	static queue: MessageQueue

	static produce_elaborate: SchedulePhase
	static produce_send: SchedulePhase
	static produce_wait: SchedulePhase
	static consume_receive: SchedulePhase
	static consume_elaborate: SchedulePhase
	static consume_wait: SchedulePhase

	controlled interleaved: Boolean
	// the messages the consumer has begun to work on
	controlled used: Seq(Integer)

definitions:
	rule r_acquire($c in Scheduler) =
		mq_staged(queue) := mq_sent(queue) + 1

	rule r_use($c in Scheduler) =
		used := append(used, mq_received(queue))

	rule r_task = r_scheduler_execute[self]

	invariant inv_bounds over mq_sent, mq_taken: mq_sound(queue)
	// messages are numbered; each one is used, once and in order
	invariant inv_order over used:
		(forall $n in asSet(used) with indexOf(used, $n) = $n - 1) and length(used) >= mq_taken(queue) - 1

	main rule r_Main =
		par
			if interleaved then
				choose $one in Scheduler with true do program($one)
			else
				forall $c in Scheduler with true do program($c)
			endif
			clock := clock + 1
		endpar

default init s0:
	function clock = 0
	function interleaved = false
	function used = []

	function task_kind($t in Task) = ASYNCHRONOUS
	function task_timeInWait($t in Task) = 0
	function task_cycles($t in Task) = 0
	function task_totalWait($t in Task) = 0
	function task_longestWait($t in Task) = 0
	function task_skipped($t in Task) = 0

	function mq_capacity($q in MessageQueue) = 3
	function mq_sent($q in MessageQueue) = 0
	function mq_refused($q in MessageQueue) = 0
	function mq_taken($q in MessageQueue) = 0

	function scheduler_mainThread($c in Scheduler) = if $c = producer then producer_task else consumer_task endif
	function scheduler_currentPhase($c in Scheduler) = if $c = producer then produce_wait else consume_wait endif
	function scheduler_actionStart($c in Scheduler) = 0
	function action($p in SchedulePhase) =
		switch $p
			case produce_elaborate: ELABORATING
			case produce_send: SENDING
			case consume_receive: RECEIVING
			case consume_elaborate: ELABORATING
			otherwise WAITING_TRIGGER
		endswitch
	function time($p in SchedulePhase) =
		switch $p
			case produce_elaborate: 3
			case consume_elaborate: 8
			otherwise 1
		endswitch
	function nextPhase($p in SchedulePhase) =
		switch $p
			case produce_elaborate: produce_send
			case produce_send: produce_wait
			case produce_wait: produce_elaborate
			case consume_receive: consume_elaborate
			case consume_elaborate: consume_wait
			otherwise consume_receive
		endswitch
	function messageQueue($p in SchedulePhase) =
		if $p = produce_send or $p = consume_receive or $p = consume_wait then queue else undef endif
	function elaborationRule($p in SchedulePhase) =
		switch $p
			case produce_elaborate: <<r_acquire(Scheduler)>>
			case consume_elaborate: <<r_use(Scheduler)>>
			otherwise undef
		endswitch

	agent Scheduler: r_task[]
