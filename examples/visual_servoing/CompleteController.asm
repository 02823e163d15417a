/* The complete controller (paper, Figures 1 and 2 together): camera, visual servoing, robot, motor and
   encoder controllers, and an operator who sends targets to visual servoing. All four cells of the
   paper's Figure 3 occur:

     asynchronous to asynchronous   operator -> visual servoing          message queue
     asynchronous to synchronous    visual servoing -> robot             swinging buffer
     synchronous to asynchronous    camera, robot -> visual servoing     swinging buffers
     synchronous to synchronous     encoder -> robot, motor; robot -> motor   swinging buffers

   A tick is 0.1 ms. */
asm CompleteController

import ../../library/std/StandardLibrary
import ../../library/patterns/ControlTask
import VisionTasks
import MotionTasks

export *

signature:
	static operator: Scheduler
	static operator_task: Task
	static targets: MessageQueue
	static operator_plan: SchedulePhase
	static operator_send: SchedulePhase
	static operator_wait: SchedulePhase
	static vs_receive_target: SchedulePhase

	static robot_to_vs: SwingingBuffer
	static robot_to_vs_lock: Semaphore
	static vs_read_robot: SchedulePhase
	static robot_write_vs: SchedulePhase

	static visionPhase: SchedulePhase -> Boolean

	// The configuration, which the init section passes on
	static complete_period: Task -> Integer
	static complete_timeForElaboration: Task -> Integer
	static complete_periodStart: Task -> Integer
	static complete_users: Semaphore -> Seq(Task)
	static complete_lock: SwingingBuffer -> Semaphore
	static complete_master: SwingingBuffer -> SchedulePhase
	static complete_task: Scheduler -> Task
	static complete_waiting: Scheduler -> SchedulePhase
	static complete_action: SchedulePhase -> PhaseAction
	static complete_time: SchedulePhase -> Integer
	static complete_nextPhase: SchedulePhase -> SchedulePhase
	static complete_buffer: SchedulePhase -> SwingingBuffer
	static complete_queue: SchedulePhase -> MessageQueue
	static complete_elaboration: SchedulePhase -> Rule(Scheduler)

	// How old is the frame behind the set-point that the motors apply, in ticks
	derived ageAtMotor: Integer

definitions:
	// the phases that Figure 2 has already
	function visionPhase($p in SchedulePhase) =
		isDef(vision_nextPhase($p))

	function complete_period($t in Task) =
		if isDef(vision_period($t)) then vision_period($t) else motion_period($t) endif

	// The sum of the phases of a cycle: slave access 1 + time, master reading 2 + time, master writing
	// time + 2, the encoders so fill their period to the last tick.
	function complete_timeForElaboration($t in Task) =
		switch $t
			case camera_task: 62
			case robot_task: 30
			case motor_task: 8
			case encoder_task: 5
			otherwise undef
		endswitch

	// All synchronous tasks begin with tick 0.
	function complete_periodStart($t in Task) =
		if isDef(vision_period($t)) then
			-vision_period($t)
		else
			if isDef(motion_period($t)) then -motion_period($t) else 0 endif
		endif

	// the shorter the period, the more urgent
	function complete_users($s in Semaphore) =
		switch $s
			case camera_to_vs_lock: [camera_task, visual_servoing_task]
			case encoder_to_robot_lock: [encoder_task, robot_task]
			case encoder_to_motor_lock: [encoder_task, motor_task]
			case robot_to_motor_lock: [motor_task, robot_task]
			otherwise [robot_task, visual_servoing_task]
		endswitch

	function complete_lock($b in SwingingBuffer) =
		switch $b
			case camera_to_vs: camera_to_vs_lock
			case vs_to_robot: vs_to_robot_lock
			case robot_to_vs: robot_to_vs_lock
			case encoder_to_robot: encoder_to_robot_lock
			case encoder_to_motor: encoder_to_motor_lock
			otherwise robot_to_motor_lock
		endswitch

	// the asynchronous task, or the slower one
	function complete_master($b in SwingingBuffer) =
		switch $b
			case camera_to_vs: vs_read_image
			case vs_to_robot: vs_write
			case robot_to_vs: vs_read_robot
			case encoder_to_robot: robot_read_encoder
			case encoder_to_motor: motor_read_encoder
			otherwise robot_write_motor
		endswitch

	function complete_task($c in Scheduler) =
		switch $c
			case camera: camera_task
			case visual_servoing: visual_servoing_task
			case robot: robot_task
			case motor: motor_task
			case encoder: encoder_task
			otherwise operator_task
		endswitch

	function complete_waiting($c in Scheduler) =
		switch $c
			case camera: camera_wait
			case visual_servoing: vs_wait
			case robot: robot_wait
			case motor: motor_wait
			case encoder: encoder_wait
			otherwise operator_wait
		endswitch

	function complete_action($p in SchedulePhase) =
		switch $p
			case vs_receive_target: RECEIVING
			case vs_read_robot: READING_FROM_SB
			case robot_write_vs: WRITING_ON_SB
			case operator_plan: ELABORATING
			case operator_send: SENDING
			otherwise if visionPhase($p) then vision_action($p) else motion_action($p) endif
		endswitch

	// the operator plans for 30 ms
	function complete_time($p in SchedulePhase) =
		if $p = operator_plan then
			300
		else
			if visionPhase($p) then vision_time($p) else motion_time($p) endif
		endif

	function complete_nextPhase($p in SchedulePhase) =
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

	function complete_buffer($p in SchedulePhase) =
		switch $p
			case vs_read_robot: robot_to_vs
			case robot_write_vs: robot_to_vs
			otherwise if visionPhase($p) then vision_buffer($p) else motion_buffer($p) endif
		endswitch

	function complete_queue($p in SchedulePhase) =
		if $p = operator_send or $p = vs_receive_target then targets else undef endif

	function complete_elaboration($p in SchedulePhase) =
		switch $p
			case camera_grab: <<r_captureImage(Scheduler)>>
			case vs_elaborate: <<r_computeSetPoint(Scheduler)>>
			case robot_elaborate: <<r_controlRobot(Scheduler)>>
			case encoder_acquire: <<r_readEncoders(Scheduler)>>
			case operator_plan: <<r_planTarget(Scheduler)>>
			otherwise undef
		endswitch

	function ageAtMotor = age(robot_to_motor)

	// The frame behind the set-point goes on to the motors; the measurement goes to visual servoing.
	rule r_controlRobot($c in Scheduler) =
		par
			sb_staged(robot_to_motor) := sb_received(vs_to_robot)
			sb_staged(robot_to_vs) := sb_received(encoder_to_robot)
		endpar

	// Targets are numbered.
	rule r_planTarget($c in Scheduler) =
		mq_staged(targets) := mq_sent(targets) + 1

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
		if $t = visual_servoing_task or $t = operator_task then ASYNCHRONOUS else SYNCHRONOUS endif
	function task_period($t in Task) = complete_period($t)
	function task_timeForElaboration($t in Task) = complete_timeForElaboration($t)
	function task_periodStart($t in Task) = complete_periodStart($t)
	function task_timeInWait($t in Task) = 0
	function task_cycles($t in Task) = 0
	function task_deadlinesMet($t in Task) = 0
	function task_deadlinesMissed($t in Task) = 0
	function task_totalWait($t in Task) = 0
	function task_longestWait($t in Task) = 0
	function task_skipped($t in Task) = 0

	function sem_permits($s in Semaphore) = 1
	function sem_users($s in Semaphore) = complete_users($s)
	function sem_state($s in Semaphore, $t in Task) = READY
	function sem_illegalPost($s in Semaphore) = false
	function semaq($s in Semaphore) = []

	// three arrays where the writer is the slow, asynchronous master
	function dimension($b in SwingingBuffer) = if $b = vs_to_robot then 3 else 2 endif
	function sem($b in SwingingBuffer) = complete_lock($b)
	function sb_master($b in SwingingBuffer) = complete_master($b)
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

	function scheduler_mainThread($c in Scheduler) = complete_task($c)
	function scheduler_currentPhase($c in Scheduler) = complete_waiting($c)
	function scheduler_actionStart($c in Scheduler) = 0

	function action($p in SchedulePhase) = complete_action($p)
	function time($p in SchedulePhase) = complete_time($p)
	function nextPhase($p in SchedulePhase) = complete_nextPhase($p)
	function sharedMemory($p in SchedulePhase) = complete_buffer($p)
	function messageQueue($p in SchedulePhase) = complete_queue($p)
	function elaborationRule($p in SchedulePhase) = complete_elaboration($p)

	agent Scheduler: r_controlTask[]
