/* Made from VisionSystem.chart. The elements, the main rule and the initial state are written anew from there; the
   elaborations are written by hand, and kept. */
asm VisionSystem

import ../../library/std/StandardLibrary
import ../../library/patterns/ControlTask

signature:
	static camera: Scheduler
	static camera_task: Task
	static visual_servoing: Scheduler
	static visual_servoing_task: Task
	static robot: Scheduler
	static robot_task: Task
	static camera_to_vs: SwingingBuffer
	static camera_to_vs_lock: Semaphore
	static vs_to_robot: SwingingBuffer
	static vs_to_robot_lock: Semaphore
	static camera_grab: SchedulePhase
	static camera_write: SchedulePhase
	static camera_wait: SchedulePhase
	static vs_read_image: SchedulePhase
	static vs_elaborate: SchedulePhase
	static vs_write: SchedulePhase
	static visual_servoing_wait: SchedulePhase
	static robot_read_vs: SchedulePhase
	static robot_elaborate: SchedulePhase
	static robot_wait: SchedulePhase

definitions:
	// The datum in a channel is the tick at which the frame behind it was captured.
	rule r_captureImage($c in Scheduler) =
		sb_staged(camera_to_vs) := clock

	// The set-point carries the frame's tick on.
	rule r_computeSetPoint($c in Scheduler) =
		sb_staged(vs_to_robot) := sb_received(camera_to_vs)

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
			case visual_servoing_task: ASYNCHRONOUS
			otherwise SYNCHRONOUS
		endswitch
	function task_period($t in Task) =
		switch $t
			case camera_task: 100
			case robot_task: 50
			otherwise undef
		endswitch
	function task_timeForElaboration($t in Task) =
		switch $t
			case camera_task: 62
			case robot_task: 22
			otherwise undef
		endswitch
	function task_periodStart($t in Task) =
		switch $t
			case camera_task: -100
			case visual_servoing_task: 0
			otherwise -50
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
			case camera_to_vs_lock: [camera_task, visual_servoing_task]
			otherwise [robot_task, visual_servoing_task]
		endswitch
	function sem_state($s in Semaphore, $t in Task) = READY
	function sem_illegalPost($s in Semaphore) = false
	function semaq($s in Semaphore) = []
	function dimension($b in SwingingBuffer) = 2
	function sem($b in SwingingBuffer) =
		switch $b
			case camera_to_vs: camera_to_vs_lock
			otherwise vs_to_robot_lock
		endswitch
	function sb_master($b in SwingingBuffer) =
		switch $b
			case camera_to_vs: vs_read_image
			otherwise vs_write
		endswitch
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
	function scheduler_mainThread($c in Scheduler) =
		switch $c
			case camera: camera_task
			case visual_servoing: visual_servoing_task
			otherwise robot_task
		endswitch
	function scheduler_currentPhase($c in Scheduler) =
		switch $c
			case camera: camera_wait
			case visual_servoing: visual_servoing_wait
			otherwise robot_wait
		endswitch
	function scheduler_actionStart($c in Scheduler) = 0
	function action($p in SchedulePhase) =
		switch $p
			case camera_grab: ELABORATING
			case camera_write: WRITING_ON_SB
			case vs_read_image: READING_FROM_SB
			case vs_elaborate: ELABORATING
			case vs_write: WRITING_ON_SB
			case robot_read_vs: READING_FROM_SB
			case robot_elaborate: ELABORATING
			otherwise WAITING_TRIGGER
		endswitch
	function time($p in SchedulePhase) =
		switch $p
			case camera_grab: 60
			case vs_elaborate: 120
			case robot_elaborate: 20
			otherwise 1
		endswitch
	function nextPhase($p in SchedulePhase) =
		switch $p
			case camera_grab: camera_write
			case camera_write: camera_wait
			case camera_wait: camera_grab
			case vs_read_image: vs_elaborate
			case vs_elaborate: vs_write
			case vs_write: visual_servoing_wait
			case visual_servoing_wait: vs_read_image
			case robot_read_vs: robot_elaborate
			case robot_elaborate: robot_wait
			otherwise robot_read_vs
		endswitch
	function sharedMemory($p in SchedulePhase) =
		switch $p
			case camera_write: camera_to_vs
			case vs_read_image: camera_to_vs
			case vs_write: vs_to_robot
			case visual_servoing_wait: camera_to_vs
			case robot_read_vs: vs_to_robot
			otherwise undef
		endswitch
	function elaborationRule($p in SchedulePhase) =
		switch $p
			case camera_grab: <<r_captureImage(Scheduler)>>
			case vs_elaborate: <<r_computeSetPoint(Scheduler)>>
			otherwise undef
		endswitch
	agent Scheduler: r_controlTask[]
