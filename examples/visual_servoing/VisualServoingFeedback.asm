/* The visual servoing application with the optional channel of the paper's Figure 2: the robot
   controller tells visual servoing the state of the robot, once a period. */
asm VisualServoingFeedback

import ../../library/std/StandardLibrary
import ../../library/patterns/ControlTask
import VisionTasks

export *

signature:
	static robot_to_vs: SwingingBuffer
	static robot_to_vs_lock: Semaphore
	static vs_read_robot: SchedulePhase
	static robot_write_vs: SchedulePhase

definitions:
	// The datum of this channel is the tick at which the robot data were taken.
	rule r_controlRobot($c in Scheduler) =
		sb_staged(robot_to_vs) := clock

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

	function task_kind($t in Task) = if $t = visual_servoing_task then ASYNCHRONOUS else SYNCHRONOUS endif
	function task_period($t in Task) = vision_period($t)
	// camera: 60 + lock and write; robot: lock and read + 20 + lock and write
	function task_timeForElaboration($t in Task) =
		switch $t
			case camera_task: 62
			case robot_task: 24
			otherwise undef
		endswitch
	function task_periodStart($t in Task) = if isDef(vision_period($t)) then -vision_period($t) else 0 endif
	function task_timeInWait($t in Task) = 0
	function task_cycles($t in Task) = 0
	function task_deadlinesMet($t in Task) = 0
	function task_deadlinesMissed($t in Task) = 0
	function task_totalWait($t in Task) = 0
	function task_longestWait($t in Task) = 0
	function task_skipped($t in Task) = 0

	function sem_permits($s in Semaphore) = 1
	function sem_users($s in Semaphore) =
		if $s = camera_to_vs_lock then
			[camera_task, visual_servoing_task]
		else
			[robot_task, visual_servoing_task]
		endif
	function sem_state($s in Semaphore, $t in Task) = READY
	function sem_illegalPost($s in Semaphore) = false
	function semaq($s in Semaphore) = []

	function dimension($b in SwingingBuffer) = 2
	function sem($b in SwingingBuffer) =
		switch $b
			case camera_to_vs: camera_to_vs_lock
			case vs_to_robot: vs_to_robot_lock
			otherwise robot_to_vs_lock
		endswitch
	// the asynchronous party is the master of all channels
	function sb_master($b in SwingingBuffer) =
		switch $b
			case camera_to_vs: vs_read_image
			case vs_to_robot: vs_write
			otherwise vs_read_robot
		endswitch
	function indexWrite($b in SwingingBuffer) = 0
	function indexRead($b in SwingingBuffer) = 1
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

	function scheduler_mainThread($c in Scheduler) =
		switch $c
			case camera: camera_task
			case visual_servoing: visual_servoing_task
			otherwise robot_task
		endswitch
	function scheduler_currentPhase($c in Scheduler) =
		switch $c
			case camera: camera_wait
			case visual_servoing: vs_wait
			otherwise robot_wait
		endswitch
	function scheduler_actionStart($c in Scheduler) = 0
	function action($p in SchedulePhase) =
		switch $p
			case vs_read_robot: READING_FROM_SB
			case robot_write_vs: WRITING_ON_SB
			otherwise vision_action($p)
		endswitch
	function time($p in SchedulePhase) = vision_time($p)
	function nextPhase($p in SchedulePhase) =
		switch $p
			case vs_read_image: vs_read_robot
			case vs_read_robot: vs_elaborate
			case robot_elaborate: robot_write_vs
			case robot_write_vs: robot_wait
			otherwise vision_nextPhase($p)
		endswitch
	function sharedMemory($p in SchedulePhase) =
		if $p = vs_read_robot or $p = robot_write_vs then robot_to_vs else vision_buffer($p) endif
	function elaborationRule($p in SchedulePhase) =
		switch $p
			case camera_grab: <<r_captureImage(Scheduler)>>
			case vs_elaborate: <<r_computeSetPoint(Scheduler)>>
			case robot_elaborate: <<r_controlRobot(Scheduler)>>
			otherwise undef
		endswitch

	agent Scheduler: r_controlTask[]
