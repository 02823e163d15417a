/* Made from Classifier.chart. The elements, the main rule and the initial state are written
   anew from there; all else is kept. */
asm Classifier

import ../../library/std/StandardLibrary
import ../../library/patterns/ControlTask

signature:
	static camera: Scheduler
	static camera_task: Task
	static classifier: Scheduler
	static classifier_task: Task
	static sorter: Scheduler
	static sorter_task: Task
	static sequencer: Scheduler
	static sequencer_task: Task
	static lines: SwingingBuffer
	static lines_lock: Semaphore
	static classes: SwingingBuffer
	static classes_lock: Semaphore
	static orders: SwingingBuffer
	static orders_lock: Semaphore
	static camera_scan: SchedulePhase
	static camera_write_lines: SchedulePhase
	static camera_wait: SchedulePhase
	static classifier_read_lines: SchedulePhase
	static classifier_classify: SchedulePhase
	static classifier_write_classes: SchedulePhase
	static classifier_wait: SchedulePhase
	static sorter_read_classes: SchedulePhase
	static sorter_decide: SchedulePhase
	static sorter_write_orders: SchedulePhase
	static sorter_wait: SchedulePhase
	static sequencer_read_orders: SchedulePhase
	static sequencer_wait: SchedulePhase

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
			case sorter_task: ASYNCHRONOUS
			otherwise SYNCHRONOUS
		endswitch
	function task_period($t in Task) =
		switch $t
			case camera_task: 50
			case sequencer_task: 100
			otherwise undef
		endswitch
	function task_timeForElaboration($t in Task) =
		switch $t
			case camera_task: 34
			case sequencer_task: 2
			otherwise undef
		endswitch
	function task_periodStart($t in Task) =
		switch $t
			case camera_task: -50
			case sequencer_task: -100
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
			case classes_lock: [classifier_task, sorter_task]
			otherwise [sequencer_task, sorter_task]
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
			case classes: classes_lock
			otherwise orders_lock
		endswitch
	function sb_master($b in SwingingBuffer) =
		switch $b
			case lines: classifier_read_lines
			case classes: sorter_read_classes
			otherwise sorter_write_orders
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
	function scheduler_mainThread($c in Scheduler) =
		switch $c
			case camera: camera_task
			case classifier: classifier_task
			case sorter: sorter_task
			otherwise sequencer_task
		endswitch
	function scheduler_currentPhase($c in Scheduler) =
		switch $c
			case camera: camera_wait
			case classifier: classifier_wait
			case sorter: sorter_wait
			otherwise sequencer_wait
		endswitch
	function scheduler_actionStart($c in Scheduler) = 0
	function action($p in SchedulePhase) =
		switch $p
			case camera_scan: ELABORATING
			case camera_write_lines: WRITING_ON_SB
			case classifier_read_lines: READING_FROM_SB
			case classifier_classify: ELABORATING
			case classifier_write_classes: WRITING_ON_SB
			case sorter_read_classes: READING_FROM_SB
			case sorter_decide: ELABORATING
			case sorter_write_orders: WRITING_ON_SB
			case sequencer_read_orders: READING_FROM_SB
			otherwise WAITING_TRIGGER
		endswitch
	function time($p in SchedulePhase) =
		switch $p
			case camera_scan: 30
			case camera_write_lines: 3
			case classifier_read_lines: 2
			case classifier_classify: 200
			case classifier_write_classes: 4
			case sorter_decide: 20
			case sorter_write_orders: 2
			otherwise 1
		endswitch
	function nextPhase($p in SchedulePhase) =
		switch $p
			case camera_scan: camera_write_lines
			case camera_write_lines: camera_wait
			case camera_wait: camera_scan
			case classifier_read_lines: classifier_classify
			case classifier_classify: classifier_write_classes
			case classifier_write_classes: classifier_wait
			case classifier_wait: classifier_read_lines
			case sorter_read_classes: sorter_decide
			case sorter_decide: sorter_write_orders
			case sorter_write_orders: sorter_wait
			case sorter_wait: sorter_read_classes
			case sequencer_read_orders: sequencer_wait
			otherwise sequencer_read_orders
		endswitch
	function sharedMemory($p in SchedulePhase) =
		switch $p
			case camera_write_lines: lines
			case classifier_read_lines: lines
			case classifier_write_classes: classes
			case classifier_wait: lines
			case sorter_read_classes: classes
			case sorter_write_orders: orders
			case sorter_wait: classes
			case sequencer_read_orders: orders
			otherwise undef
		endswitch
	function elaborationRule($p in SchedulePhase) = undef
	agent Scheduler: r_controlTask[]
