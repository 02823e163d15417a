/* The tasks of a visual servoing robot (paper, Figure 2): camera, visual servoing, robot controller,
   and the two channels between them. Configuration that does not depend on the rest of the application
   is given here as functions `vision_…`; the init section of an application passes it on.

   A tick is 0.1 ms. The datum in a channel is the tick at which the camera frame behind it was
   captured; it travels from the frame to the set-points, so age is a difference of ticks. */
module VisionTasks

import ../../library/std/StandardLibrary
import ../../library/patterns/ControlTask

export *

signature:
	static camera: Scheduler
	static visual_servoing: Scheduler
	static robot: Scheduler
	static camera_task: Task
	static visual_servoing_task: Task
	static robot_task: Task

	static camera_to_vs: SwingingBuffer
	static vs_to_robot: SwingingBuffer
	static camera_to_vs_lock: Semaphore
	static vs_to_robot_lock: Semaphore

	static camera_grab: SchedulePhase
	static camera_write: SchedulePhase
	static camera_wait: SchedulePhase
	static vs_read_image: SchedulePhase
	static vs_elaborate: SchedulePhase
	static vs_write: SchedulePhase
	static vs_wait: SchedulePhase
	static robot_read_vs: SchedulePhase
	static robot_elaborate: SchedulePhase
	static robot_wait: SchedulePhase

	static vision_period: Task -> Integer
	static vision_action: SchedulePhase -> PhaseAction
	static vision_time: SchedulePhase -> Integer
	static vision_buffer: SchedulePhase -> SwingingBuffer
	static vision_nextPhase: SchedulePhase -> SchedulePhase

	// age of the data behind the last set-point of a channel's consumer, in ticks
	derived age: SwingingBuffer -> Integer

definitions:
	// 10 ms and 5 ms; visual servoing is asynchronous
	function vision_period($t in Task) =
		switch $t
			case camera_task: 100
			case robot_task: 50
			otherwise undef
		endswitch

	function vision_action($p in SchedulePhase) =
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

	function vision_time($p in SchedulePhase) =
		switch $p
			case camera_grab: 60
			case vs_elaborate: 120
			case robot_elaborate: 20
			otherwise 1
		endswitch

	// Visual servoing waits for an image; the other two wait for their period.
	function vision_buffer($p in SchedulePhase) =
		switch $p
			case camera_write: camera_to_vs
			case vs_wait: camera_to_vs
			case vs_read_image: camera_to_vs
			case vs_write: vs_to_robot
			case robot_read_vs: vs_to_robot
			otherwise undef
		endswitch

	function vision_nextPhase($p in SchedulePhase) =
		switch $p
			case camera_grab: camera_write
			case camera_write: camera_wait
			case camera_wait: camera_grab
			case vs_read_image: vs_elaborate
			case vs_elaborate: vs_write
			case vs_write: vs_wait
			case vs_wait: vs_read_image
			case robot_read_vs: robot_elaborate
			case robot_elaborate: robot_wait
			case robot_wait: robot_read_vs
			otherwise undef
		endswitch

	function age($b in SwingingBuffer) =
		if isDef(sb_received($b)) then clock - sb_received($b) else undef endif

	rule r_captureImage($c in Scheduler) =
		sb_staged(camera_to_vs) := clock

	rule r_computeSetPoint($c in Scheduler) =
		sb_staged(vs_to_robot) := sb_received(camera_to_vs)

	// What each task does when it is its turn
	rule r_controlTask = r_scheduler_execute[self]
