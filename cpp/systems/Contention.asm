/* Made from Contention.chart. The elements, the main rule and the initial state are written
   anew from there; all else is kept. */
asm Contention

import ../../library/std/StandardLibrary
import ../../library/patterns/ControlTask

signature:
	static planner: Scheduler
	static planner_task: Task
	static slow: Scheduler
	static slow_task: Task
	static fast: Scheduler
	static fast_task: Task
	static watcher: Scheduler
	static watcher_task: Task
	static goals: MessageQueue
	static mode: SharedValue
	static position: SwingingBuffer
	static position_lock: Semaphore
	static state: SharedValue
	static planner_plan: SchedulePhase
	static planner_send: SchedulePhase
	static planner_store: SchedulePhase
	static planner_wait: SchedulePhase
	static slow_receive: SchedulePhase
	static slow_load: SchedulePhase
	static slow_law: SchedulePhase
	static slow_write: SchedulePhase
	static slow_wait: SchedulePhase
	static fast_read: SchedulePhase
	static fast_control: SchedulePhase
	static fast_store: SchedulePhase
	static fast_wait: SchedulePhase
	static watcher_load: SchedulePhase
	static watcher_look: SchedulePhase
	static watcher_wait: SchedulePhase

definitions:
	// what each task does when it is its turn
	rule r_controlTask = r_scheduler_execute[self]

	invariant inv_patterns over sem_state, indexRead: patternsSound

	invariant inv_deadlines over task_deadlinesMissed: (forall $t in Task with task_deadlinesMissed($t) = 0)

	main rule r_Main =
		par
			forall $c in Scheduler with true do program($c)
			forall $s in Semaphore with true do r_sem_arbitrate[$s]
			clock := clock + 1
		endpar

default init s0:
	function clock = 0
	function task_kind($t in Task) =
		switch $t
			case slow_task: SYNCHRONOUS
			case fast_task: SYNCHRONOUS
			otherwise ASYNCHRONOUS
		endswitch
	function task_period($t in Task) =
		switch $t
			case slow_task: 13
			case fast_task: 10
			otherwise undef
		endswitch
	function task_deadline($t in Task) =
		switch $t
			case slow_task: 9
			otherwise undef
		endswitch
	function task_timeForElaboration($t in Task) =
		switch $t
			case slow_task: 7
			case fast_task: 9
			otherwise undef
		endswitch
	function task_periodStart($t in Task) =
		switch $t
			case slow_task: -13
			case fast_task: -8
			otherwise 0
		endswitch
	function task_timeInWait($t in Task) = 0
	function task_cycles($t in Task) = 0
	function task_deadlinesMet($t in Task) = 0
	function task_deadlinesMissed($t in Task) = 0
	function task_totalWait($t in Task) = 0
	function task_longestWait($t in Task) = 0
	function task_skipped($t in Task) = 0
	function sem_permits($s in Semaphore) = 1
	function sem_users($s in Semaphore) = [fast_task, slow_task]
	function sem_state($s in Semaphore, $t in Task) = READY
	function sem_illegalPost($s in Semaphore) = false
	function semaq($s in Semaphore) = []
	function dimension($b in SwingingBuffer) = 3
	function sem($b in SwingingBuffer) = position_lock
	function sb_master($b in SwingingBuffer) = slow_write
	function indexWrite($b in SwingingBuffer) = 0
	function indexRead($b in SwingingBuffer) = 2
	function indexUpdated($b in SwingingBuffer) = false
	function sb_pending($b in SwingingBuffer) = false
	function sb_fresh($b in SwingingBuffer) = false
	function sb_sequence($b in SwingingBuffer, $n in ArrayIndex) = 0
	function sb_receivedSequence($b in SwingingBuffer) = 0
	function sb_written($b in SwingingBuffer) = 0
	function sb_swaps($b in SwingingBuffer) = 0
	function sb_delivered($b in SwingingBuffer) = 0
	function sb_overwritten($b in SwingingBuffer) = 0
	function sb_unread($b in SwingingBuffer) = 0
	function sb_dropped($b in SwingingBuffer) = 0
	function mq_capacity($q in MessageQueue) = 2
	function mq_sent($q in MessageQueue) = 0
	function mq_refused($q in MessageQueue) = 0
	function mq_taken($q in MessageQueue) = 0
	function sv_sequence($v in SharedValue) = 0
	function sv_overwritten($v in SharedValue) = 0
	function sv_receivedSequence($v in SharedValue) = 0
	function sv_fresh($v in SharedValue) = false
	function scheduler_mainThread($c in Scheduler) =
		switch $c
			case planner: planner_task
			case slow: slow_task
			case fast: fast_task
			otherwise watcher_task
		endswitch
	function scheduler_currentPhase($c in Scheduler) =
		switch $c
			case planner: planner_wait
			case slow: slow_wait
			case fast: fast_wait
			otherwise watcher_wait
		endswitch
	function scheduler_actionStart($c in Scheduler) = 0
	function action($p in SchedulePhase) =
		switch $p
			case planner_plan: ELABORATING
			case planner_send: SENDING
			case planner_store: STORING
			case slow_receive: RECEIVING
			case slow_load: LOADING
			case slow_law: ELABORATING
			case slow_write: WRITING_ON_SB
			case fast_read: READING_FROM_SB
			case fast_control: ELABORATING
			case fast_store: STORING
			case watcher_load: LOADING
			case watcher_look: ELABORATING
			otherwise WAITING_TRIGGER
		endswitch
	function time($p in SchedulePhase) =
		switch $p
			case planner_plan: 7
			case slow_law: 2
			case fast_read: 6
			case watcher_look: 17
			otherwise 1
		endswitch
	function nextPhase($p in SchedulePhase) =
		switch $p
			case planner_plan: planner_send
			case planner_send: planner_store
			case planner_store: planner_wait
			case planner_wait: planner_plan
			case slow_receive: slow_load
			case slow_load: slow_law
			case slow_law: slow_write
			case slow_write: slow_wait
			case slow_wait: slow_receive
			case fast_read: fast_control
			case fast_control: fast_store
			case fast_store: fast_wait
			case fast_wait: fast_read
			case watcher_load: watcher_look
			case watcher_look: watcher_wait
			otherwise watcher_load
		endswitch
	function sharedMemory($p in SchedulePhase) =
		switch $p
			case slow_write: position
			case fast_read: position
			otherwise undef
		endswitch
	function messageQueue($p in SchedulePhase) =
		switch $p
			case planner_send: goals
			case slow_receive: goals
			otherwise undef
		endswitch
	function sharedValue($p in SchedulePhase) =
		switch $p
			case planner_store: mode
			case slow_load: mode
			case fast_store: state
			case watcher_load: state
			case watcher_wait: state
			otherwise undef
		endswitch
	function elaborationRule($p in SchedulePhase) = undef
	agent Scheduler: r_controlTask[]
