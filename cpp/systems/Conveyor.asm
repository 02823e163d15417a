/* Made from Conveyor.chart. The elements, the main rule and the initial state are written
   anew from there; all else is kept. */
asm Conveyor

import ../../library/std/StandardLibrary
import ../../library/patterns/ControlTask

signature:
	static camera: Scheduler
	static camera_task: Task
	static classifier: Scheduler
	static classifier_task: Task
	static sequencer: Scheduler
	static sequencer_task: Task
	static drive: Scheduler
	static drive_task: Task
	static lines: SwingingBuffer
	static lines_lock: Semaphore
	static parts: MessageQueue
	static commands: SwingingBuffer
	static commands_lock: Semaphore
	static speed: SharedValue
	static camera_scan: SchedulePhase
	static camera_write_lines: SchedulePhase
	static camera_wait: SchedulePhase
	static classifier_read_lines: SchedulePhase
	static classifier_classify: SchedulePhase
	static classifier_write_parts: SchedulePhase
	static classifier_wait: SchedulePhase
	static sequencer_read_parts: SchedulePhase
	static sequencer_read_speed: SchedulePhase
	static sequencer_plan: SchedulePhase
	static sequencer_write_commands: SchedulePhase
	static sequencer_wait: SchedulePhase
	static drive_read_commands: SchedulePhase
	static drive_control: SchedulePhase
	static drive_write_speed: SchedulePhase
	static drive_wait: SchedulePhase

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
			case classifier_task: ASYNCHRONOUS
			case sequencer_task: ASYNCHRONOUS
			otherwise SYNCHRONOUS
		endswitch
	function task_period($t in Task) =
		switch $t
			case camera_task: 50
			case drive_task: 20
			otherwise undef
		endswitch
	function task_deadline($t in Task) =
		switch $t
			case drive_task: 15
			otherwise undef
		endswitch
	function task_timeForElaboration($t in Task) =
		switch $t
			case camera_task: 23
			case drive_task: 7
			otherwise undef
		endswitch
	function task_periodStart($t in Task) =
		switch $t
			case camera_task: -50
			case drive_task: -17
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
	function sem_users($s in Semaphore) =
		switch $s
			case lines_lock: [camera_task, classifier_task]
			otherwise [drive_task, sequencer_task]
		endswitch
	function sem_state($s in Semaphore, $t in Task) = READY
	function sem_illegalPost($s in Semaphore) = false
	function semaq($s in Semaphore) = []
	function dimension($b in SwingingBuffer) =
		switch $b
			case lines: 3
			otherwise 2
		endswitch
	function sem($b in SwingingBuffer) =
		switch $b
			case lines: lines_lock
			otherwise commands_lock
		endswitch
	function sb_master($b in SwingingBuffer) =
		switch $b
			case lines: classifier_read_lines
			otherwise sequencer_write_commands
		endswitch
	function indexWrite($b in SwingingBuffer) = 0
	function indexRead($b in SwingingBuffer) =
		switch $b
			case lines: 2
			otherwise 1
		endswitch
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
			case camera: camera_task
			case classifier: classifier_task
			case sequencer: sequencer_task
			otherwise drive_task
		endswitch
	function scheduler_currentPhase($c in Scheduler) =
		switch $c
			case camera: camera_wait
			case classifier: classifier_wait
			case sequencer: sequencer_wait
			otherwise drive_wait
		endswitch
	function scheduler_actionStart($c in Scheduler) = 0
	function action($p in SchedulePhase) =
		switch $p
			case camera_scan: ELABORATING
			case camera_write_lines: WRITING_ON_SB
			case classifier_read_lines: READING_FROM_SB
			case classifier_classify: ELABORATING
			case classifier_write_parts: SENDING
			case sequencer_read_parts: RECEIVING
			case sequencer_read_speed: LOADING
			case sequencer_plan: ELABORATING
			case sequencer_write_commands: WRITING_ON_SB
			case drive_read_commands: READING_FROM_SB
			case drive_control: ELABORATING
			case drive_write_speed: STORING
			otherwise WAITING_TRIGGER
		endswitch
	function time($p in SchedulePhase) =
		switch $p
			case camera_scan: 20
			case camera_write_lines: 2
			case classifier_classify: 70
			case sequencer_plan: 15
			case sequencer_write_commands: 3
			case drive_control: 4
			otherwise 1
		endswitch
	function nextPhase($p in SchedulePhase) =
		switch $p
			case camera_scan: camera_write_lines
			case camera_write_lines: camera_wait
			case camera_wait: camera_scan
			case classifier_read_lines: classifier_classify
			case classifier_classify: classifier_write_parts
			case classifier_write_parts: classifier_wait
			case classifier_wait: classifier_read_lines
			case sequencer_read_parts: sequencer_read_speed
			case sequencer_read_speed: sequencer_plan
			case sequencer_plan: sequencer_write_commands
			case sequencer_write_commands: sequencer_wait
			case sequencer_wait: sequencer_read_parts
			case drive_read_commands: drive_control
			case drive_control: drive_write_speed
			case drive_write_speed: drive_wait
			otherwise drive_read_commands
		endswitch
	function sharedMemory($p in SchedulePhase) =
		switch $p
			case camera_write_lines: lines
			case classifier_read_lines: lines
			case classifier_wait: lines
			case sequencer_write_commands: commands
			case drive_read_commands: commands
			otherwise undef
		endswitch
	function messageQueue($p in SchedulePhase) =
		switch $p
			case classifier_write_parts: parts
			case sequencer_read_parts: parts
			case sequencer_wait: parts
			otherwise undef
		endswitch
	function sharedValue($p in SchedulePhase) =
		switch $p
			case sequencer_read_speed: speed
			case drive_write_speed: speed
			otherwise undef
		endswitch
	function elaborationRule($p in SchedulePhase) = undef
	agent Scheduler: r_controlTask[]
