/* The complete controller without time, by parts: in each run the two tasks of one channel go through their whole cycles, moving
   one at a time or both at once, and the others rest outside of all locks. All parts are in one model, which asks for one in
   its initial state.

   A step of a task looks at its own control state and at the buffers of the phases that it leaves and enters; and no task waits
   for a lock while it holds another (inv_oneLock), nor is a buffer used by a third (inv_twoUsers). So whatever a run of all
   tasks does to a buffer, it does in a run of the two alone, in which a task that waits for somebody else does not move. */
asm CompleteControllerInterleaved

import ../../../library/std/StandardLibrary
import ../../../library/std/CTLLibrary
import ../../../library/std/LTLLibrary
import ../../../library/patterns/ControlTask
import ../../../library/verification/BufferFaults
import ../../../library/verification/Quotient
import ../../../library/verification/SystemProperties
import ../../../library/verification/SystemInterleaved
import ../VisionTasks
import ../MotionTasks
import ../CompleteController

signature:
	enum domain Part = {
		CAMERA_SERVOING | SERVOING_ROBOT | ENCODER_ROBOT | ENCODER_MOTOR | ROBOT_MOTOR | OPERATOR_SERVOING}

	monitored chosen: Part
	controlled part: Part

	static isIn: Prod(Part, Task) -> Boolean

definitions:
	// the task's own rule, with the fault that is seeded, if any
	rule r_faultyTask = r_faulty[self]

	function isIn($part in Part, $t in Task) =
		switch $part
			case CAMERA_SERVOING: $t = camera_task or $t = visual_servoing_task
			case SERVOING_ROBOT: $t = visual_servoing_task or $t = robot_task
			case ENCODER_ROBOT: $t = encoder_task or $t = robot_task
			case ENCODER_MOTOR: $t = encoder_task or $t = motor_task
			case ROBOT_MOTOR: $t = robot_task or $t = motor_task
			case OPERATOR_SERVOING: $t = operator_task or $t = visual_servoing_task
		endswitch

	JUSTICE takesPart(camera_task) implies moved(camera_task)
	JUSTICE takesPart(visual_servoing_task) implies moved(visual_servoing_task)
	JUSTICE takesPart(robot_task) implies moved(robot_task)
	JUSTICE takesPart(motor_task) implies moved(motor_task)
	JUSTICE takesPart(encoder_task) implies moved(encoder_task)
	JUSTICE takesPart(operator_task) implies moved(operator_task)

	main rule r_Verified = r_move[]

default init s0:
	function clock = 0

	function task_kind($t in Task) =
		if $t = visual_servoing_task or $t = operator_task then ASYNCHRONOUS else SYNCHRONOUS endif
	// The sum of the phases of a cycle: slave access 1 + time, master reading 2 + time, master writing
	// time + 2, the encoders so fill their period to the last tick.
	// All synchronous tasks begin with tick 0.
	function task_timeInWait($t in Task) = 0
	function task_cycles($t in Task) = 0
	function task_deadlinesMet($t in Task) = 0
	function task_deadlinesMissed($t in Task) = 0
	function task_totalWait($t in Task) = 0
	function task_longestWait($t in Task) = 0
	function task_skipped($t in Task) = 0

	function sem_permits($s in Semaphore) = 1
	// the shorter the period, the more urgent
	function sem_users($s in Semaphore) =
		switch $s
			case camera_to_vs_lock: [camera_task, visual_servoing_task]
			case encoder_to_robot_lock: [encoder_task, robot_task]
			case encoder_to_motor_lock: [encoder_task, motor_task]
			case robot_to_motor_lock: [motor_task, robot_task]
			otherwise [robot_task, visual_servoing_task]
		endswitch
	function sem_state($s in Semaphore, $t in Task) = READY
	function sem_illegalPost($s in Semaphore) = false
	function semaq($s in Semaphore) = []

	// three arrays where the writer is the slow, asynchronous master
	function dimension($b in SwingingBuffer) = if $b = vs_to_robot then 3 else 2 endif
	function sem($b in SwingingBuffer) =
		switch $b
			case camera_to_vs: camera_to_vs_lock
			case vs_to_robot: vs_to_robot_lock
			case robot_to_vs: robot_to_vs_lock
			case encoder_to_robot: encoder_to_robot_lock
			case encoder_to_motor: encoder_to_motor_lock
			otherwise robot_to_motor_lock
		endswitch
	// the asynchronous task, or the slower one
	function sb_master($b in SwingingBuffer) =
		switch $b
			case camera_to_vs: vs_read_image
			case vs_to_robot: vs_write
			case robot_to_vs: vs_read_robot
			case encoder_to_robot: robot_read_encoder
			case encoder_to_motor: motor_read_encoder
			otherwise robot_write_motor
		endswitch
	function indexWrite($b in SwingingBuffer) = 0
	function indexRead($b in SwingingBuffer) = if $b = vs_to_robot then 2 else 1 endif
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

	function mq_capacity($q in MessageQueue) = 4
	function mq_sent($q in MessageQueue) = 0
	function mq_refused($q in MessageQueue) = 0
	function mq_taken($q in MessageQueue) = 0

	function scheduler_mainThread($c in Scheduler) =
		switch $c
			case camera: camera_task
			case visual_servoing: visual_servoing_task
			case robot: robot_task
			case motor: motor_task
			case encoder: encoder_task
			otherwise operator_task
		endswitch
	function scheduler_currentPhase($c in Scheduler) =
		switch $c
			case camera: camera_wait
			case visual_servoing: vs_wait
			case robot: robot_wait
			case motor: motor_wait
			case encoder: encoder_wait
			otherwise operator_wait
		endswitch
	function scheduler_actionStart($c in Scheduler) = 0

	function action($p in SchedulePhase) =
		switch $p
			case vs_receive_target: RECEIVING
			case vs_read_robot: READING_FROM_SB
			case robot_write_vs: WRITING_ON_SB
			case operator_plan: ELABORATING
			case operator_send: SENDING
			otherwise if visionPhase($p) then vision_action($p) else motion_action($p) endif
		endswitch
	// the operator plans for 30 ms
	function nextPhase($p in SchedulePhase) =
		switch $p
			case operator_wait: operator_plan
			case operator_plan: operator_send
			case operator_send: operator_wait
			case vs_wait: vs_receive_target
			case vs_receive_target: vs_read_image
			case vs_read_image: vs_read_robot
			case vs_read_robot: vs_elaborate
			case robot_wait: robot_read_vs
			case robot_read_vs: robot_read_encoder
			case robot_read_encoder: robot_elaborate
			case robot_elaborate: robot_write_motor
			case robot_write_motor: robot_write_vs
			case robot_write_vs: robot_wait
			otherwise if visionPhase($p) then vision_nextPhase($p) else motion_nextPhase($p) endif
		endswitch
	function sharedMemory($p in SchedulePhase) =
		switch $p
			// without a camera it begins whenever it moves
			case vs_wait: if isIn(part, camera_task) then camera_to_vs else undef endif
			case vs_read_robot: robot_to_vs
			case robot_write_vs: robot_to_vs
			otherwise if visionPhase($p) then vision_buffer($p) else motion_buffer($p) endif
		endswitch
	function messageQueue($p in SchedulePhase) =
		if $p = operator_send or $p = vs_receive_target then targets else undef endif
	function elaborationRule($p in SchedulePhase) =
		switch $p
			case camera_grab: <<r_captureImage(Scheduler)>>
			case vs_elaborate: <<r_computeSetPoint(Scheduler)>>
			case robot_elaborate: <<r_controlRobot(Scheduler)>>
			case encoder_acquire: <<r_readEncoders(Scheduler)>>
			case operator_plan: <<r_planTarget(Scheduler)>>
			otherwise undef
		endswitch

	// no time
	function task_period($t in Task) = 1
	function task_deadline($t in Task) = 1
	function task_timeForElaboration($t in Task) = 0
	function task_periodStart($t in Task) = 0
	function time($p in SchedulePhase) = 0
	// who moves, what is observed, what is seeded
	function takesPart($t in Task) = isIn(part, $t)
	function part = chosen
	function moved($t in Task) = false
	function handedOver($b in SwingingBuffer) = 0
	function unaccounted($b in SwingingBuffer) = 0
	function before_read($b in SwingingBuffer) = indexRead($b)
	function before_written($b in SwingingBuffer) = 0
	function before_phase($c in Scheduler) = scheduler_currentPhase($c)
	function lostSilently($v in SharedValue) = false
	function fault = seeded

	agent Scheduler: r_faultyTask[]
