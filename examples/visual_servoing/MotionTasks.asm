/* The tasks that a robot controller drives (paper, Figure 1): motor controller and encoder controller,
   with the channels of both and of the robot controller. The encoders have one buffer for each of
   their two readers: a buffer shared by both would be swapped by the slower one only, and the motors
   would read each value five times.

   Every channel here joins two synchronous tasks, and the slower one is the master. */
module MotionTasks

import ../../library/std/StandardLibrary
import ../../library/patterns/ControlTask

export *

signature:
	static motor: Scheduler
	static encoder: Scheduler
	static motor_task: Task
	static encoder_task: Task

	static encoder_to_robot: SwingingBuffer
	static encoder_to_motor: SwingingBuffer
	static robot_to_motor: SwingingBuffer
	static encoder_to_robot_lock: Semaphore
	static encoder_to_motor_lock: Semaphore
	static robot_to_motor_lock: Semaphore

	static robot_read_encoder: SchedulePhase
	static robot_write_motor: SchedulePhase
	static motor_read_encoder: SchedulePhase
	static motor_read_robot: SchedulePhase
	static motor_elaborate: SchedulePhase
	static motor_wait: SchedulePhase
	static encoder_acquire: SchedulePhase
	static encoder_write_robot: SchedulePhase
	static encoder_write_motor: SchedulePhase
	static encoder_wait: SchedulePhase

	static motion_period: Task -> Integer
	static motion_action: SchedulePhase -> PhaseAction
	static motion_time: SchedulePhase -> Integer
	static motion_buffer: SchedulePhase -> SwingingBuffer
	static motion_nextPhase: SchedulePhase -> SchedulePhase

definitions:
	// 1 ms and 0.5 ms
	function motion_period($t in Task) =
		switch $t
			case motor_task: 10
			case encoder_task: 5
			otherwise undef
		endswitch

	function motion_action($p in SchedulePhase) =
		switch $p
			case robot_read_encoder: READING_FROM_SB
			case robot_write_motor: WRITING_ON_SB
			case motor_read_encoder: READING_FROM_SB
			case motor_read_robot: READING_FROM_SB
			case motor_elaborate: ELABORATING
			case encoder_acquire: ELABORATING
			case encoder_write_robot: WRITING_ON_SB
			case encoder_write_motor: WRITING_ON_SB
			otherwise WAITING_TRIGGER
		endswitch

	function motion_time($p in SchedulePhase) =
		if $p = motor_elaborate then 3 else 1 endif

	function motion_buffer($p in SchedulePhase) =
		switch $p
			case robot_read_encoder: encoder_to_robot
			case encoder_write_robot: encoder_to_robot
			case motor_read_encoder: encoder_to_motor
			case encoder_write_motor: encoder_to_motor
			case robot_write_motor: robot_to_motor
			case motor_read_robot: robot_to_motor
			otherwise undef
		endswitch

	// The encoders serve the robot controller first: when both tasks begin a period at once, the
	// motors hold the lock of their channel just then, and the encoders have no tick to spare.
	function motion_nextPhase($p in SchedulePhase) =
		switch $p
			case motor_read_encoder: motor_read_robot
			case motor_read_robot: motor_elaborate
			case motor_elaborate: motor_wait
			case motor_wait: motor_read_encoder
			case encoder_acquire: encoder_write_robot
			case encoder_write_robot: encoder_write_motor
			case encoder_write_motor: encoder_wait
			case encoder_wait: encoder_acquire
			otherwise undef
		endswitch

	// The datum of both channels is the tick of the measurement.
	rule r_readEncoders($c in Scheduler) =
		par
			sb_staged(encoder_to_robot) := clock
			sb_staged(encoder_to_motor) := clock
		endpar
