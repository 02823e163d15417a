/* Made from Handover.chart. The elements, the main rule and the initial state are written
   anew from there; all else is kept. */
asm Handover

import ../../library/std/StandardLibrary
import ../../library/patterns/ControlTask

signature:
	static arm: Scheduler
	static arm_task: Task
	static guard: Scheduler
	static guard_task: Task
	static record: Scheduler
	static record_task: Task
	static pose: SwingingBuffer
	static pose_lock: Semaphore
	static alarm: SharedValue
	static arm_move: SchedulePhase
	static arm_write_pose: SchedulePhase
	static arm_wait: SchedulePhase
	static guard_read_pose: SchedulePhase
	static guard_watch: SchedulePhase
	static guard_write_alarm: SchedulePhase
	static guard_wait: SchedulePhase
	static record_read_alarm: SchedulePhase
	static record_wait: SchedulePhase

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
	function task_kind($t in Task) = SYNCHRONOUS
	function task_period($t in Task) =
		switch $t
			case guard_task: 5
			otherwise 10
		endswitch
	function task_timeForElaboration($t in Task) =
		switch $t
			case arm_task: 7
			case guard_task: 5
			otherwise 1
		endswitch
	function task_periodStart($t in Task) =
		switch $t
			case guard_task: -5
			otherwise -10
		endswitch
	function task_timeInWait($t in Task) = 0
	function task_cycles($t in Task) = 0
	function task_deadlinesMet($t in Task) = 0
	function task_deadlinesMissed($t in Task) = 0
	function task_totalWait($t in Task) = 0
	function task_longestWait($t in Task) = 0
	function task_skipped($t in Task) = 0
	function sem_permits($s in Semaphore) = 1
	function sem_users($s in Semaphore) = [guard_task, arm_task]
	function sem_state($s in Semaphore, $t in Task) = READY
	function sem_illegalPost($s in Semaphore) = false
	function semaq($s in Semaphore) = []
	function dimension($b in SwingingBuffer) = 2
	function sem($b in SwingingBuffer) = pose_lock
	function sb_master($b in SwingingBuffer) = arm_write_pose
	function indexWrite($b in SwingingBuffer) = 0
	function indexRead($b in SwingingBuffer) = 1
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
	function sv_sequence($v in SharedValue) = 0
	function sv_overwritten($v in SharedValue) = 0
	function sv_receivedSequence($v in SharedValue) = 0
	function sv_fresh($v in SharedValue) = false
	function scheduler_mainThread($c in Scheduler) =
		switch $c
			case arm: arm_task
			case guard: guard_task
			otherwise record_task
		endswitch
	function scheduler_currentPhase($c in Scheduler) =
		switch $c
			case arm: arm_wait
			case guard: guard_wait
			otherwise record_wait
		endswitch
	function scheduler_actionStart($c in Scheduler) = 0
	function action($p in SchedulePhase) =
		switch $p
			case arm_move: ELABORATING
			case arm_write_pose: WRITING_ON_SB
			case guard_read_pose: READING_FROM_SB
			case guard_watch: ELABORATING
			case guard_write_alarm: STORING
			case record_read_alarm: LOADING
			otherwise WAITING_TRIGGER
		endswitch
	function time($p in SchedulePhase) =
		switch $p
			case arm_move: 4
			case guard_watch: 2
			otherwise 1
		endswitch
	function nextPhase($p in SchedulePhase) =
		switch $p
			case arm_move: arm_write_pose
			case arm_write_pose: arm_wait
			case arm_wait: arm_move
			case guard_read_pose: guard_watch
			case guard_watch: guard_write_alarm
			case guard_write_alarm: guard_wait
			case guard_wait: guard_read_pose
			case record_read_alarm: record_wait
			otherwise record_read_alarm
		endswitch
	function sharedMemory($p in SchedulePhase) =
		switch $p
			case arm_write_pose: pose
			case guard_read_pose: pose
			otherwise undef
		endswitch
	function sharedValue($p in SchedulePhase) =
		switch $p
			case guard_write_alarm: alarm
			case record_read_alarm: alarm
			otherwise undef
		endswitch
	function elaborationRule($p in SchedulePhase) = undef
	agent Scheduler: r_controlTask[]
