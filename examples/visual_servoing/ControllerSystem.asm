/* Made from ControllerSystem.chart. The elements, the main rule, the initial state and what comes from its components' machines
   are written anew from there; the rules of the elaborations are written by hand, and kept. */
asm ControllerSystem

import ../../library/std/StandardLibrary
import ../../library/patterns/ControlTask
import CTLLibrary
import LTLLibrary
import Guiding

signature:
	static operator: Scheduler
	static operator_task: Task
	static camera: Scheduler
	static camera_task: Task
	static visual_servoing: Scheduler
	static visual_servoing_task: Task
	static robot: Scheduler
	static robot_task: Task
	static motor: Scheduler
	static motor_task: Task
	static encoder: Scheduler
	static encoder_task: Task
	static targets: MessageQueue
	static camera_to_vs: SwingingBuffer
	static camera_to_vs_lock: Semaphore
	static robot_to_vs: SwingingBuffer
	static robot_to_vs_lock: Semaphore
	static vs_to_robot: SwingingBuffer
	static vs_to_robot_lock: Semaphore
	static encoder_to_robot: SwingingBuffer
	static encoder_to_robot_lock: Semaphore
	static encoder_to_motor: SwingingBuffer
	static encoder_to_motor_lock: Semaphore
	static robot_to_motor: SwingingBuffer
	static robot_to_motor_lock: Semaphore
	static operator_plan: SchedulePhase
	static operator_send: SchedulePhase
	static operator_wait: SchedulePhase
	static camera_grab: SchedulePhase
	static camera_write: SchedulePhase
	static camera_wait: SchedulePhase
	static vs_receive_target: SchedulePhase
	static vs_read_image: SchedulePhase
	static vs_read_robot: SchedulePhase
	static vs_elaborate: SchedulePhase
	static vs_write: SchedulePhase
	static visual_servoing_wait: SchedulePhase
	static robot_read_vs: SchedulePhase
	static robot_read_encoder: SchedulePhase
	static robot_elaborate: SchedulePhase
	static robot_write_motor: SchedulePhase
	static robot_write_vs: SchedulePhase
	static robot_wait: SchedulePhase
	static motor_read_encoder: SchedulePhase
	static motor_read_robot: SchedulePhase
	static motor_elaborate: SchedulePhase
	static motor_wait: SchedulePhase
	static encoder_acquire: SchedulePhase
	static encoder_write_robot: SchedulePhase
	static encoder_write_motor: SchedulePhase
	static encoder_wait: SchedulePhase

	// There is a target
	monitored hasTarget: Boolean

	// All discs are in the image
	monitored isSeen: Boolean

	// The law gives a set-point
	monitored hasLaw: Boolean

	// The features are at the target
	monitored isClose: Boolean

	// Panel: what visual servoing does
	out panel: ServoMode

	// Lamp: set-points are given
	out guiding: Boolean

	domain Visual_servoingImages subsetof Integer

	controlled visual_servoing_unseen: Visual_servoingImages

	static visual_servoing_patience: Visual_servoingImages

	derived visual_servoing_isFollowing: Boolean

	// The set-point is not too old
	monitored isGuided: Boolean

	// The camera is not moved
	monitored isStill: Boolean

	// Panel: what the arm does
	out arm: ArmMode

definitions:
	// Targets are numbered.
	rule r_planTarget($c in Scheduler) =
		mq_staged(targets) := mq_sent(targets) + 1

	// The datum in a channel is the tick at which the frame behind it was captured.
	rule r_captureImage($c in Scheduler) =
		sb_staged(camera_to_vs) := clock

	// The set-point carries the frame's tick on.
	rule r_computeSetPoint($c in Scheduler) =
		sb_staged(vs_to_robot) := sb_received(camera_to_vs)

	// The frame behind the set-point goes on to the motors; the measurement goes to visual servoing.
	rule r_controlRobot($c in Scheduler) =
		par
			sb_staged(robot_to_motor) := sb_received(vs_to_robot)
			sb_staged(robot_to_vs) := sb_received(encoder_to_robot)
		endpar

	// The datum of both channels is the tick of the measurement.
	rule r_readEncoders($c in Scheduler) =
		par
			sb_staged(encoder_to_robot) := clock
			sb_staged(encoder_to_motor) := clock
		endpar

	// what each task does when it is its turn
	rule r_controlTask = r_scheduler_execute[self]

	invariant inv_patterns over sem_state, indexRead: patternsSound

	invariant inv_deadlines over task_deadlinesMissed: (forall $t in Task with task_deadlinesMissed($t) = 0)

	domain Visual_servoingImages = {0 : 10}

	function visual_servoing_patience = 10

	function visual_servoing_isFollowing = panel = TRACKING or panel = CONVERGED or panel = COVERED

	rule r_visual_servoing_is($mode in ServoMode, $guiding in Boolean, $unseen in Visual_servoingImages) =
		par
			panel := $mode
			guiding := $guiding
			visual_servoing_unseen := $unseen
		endpar

	// a step of Servoing, the machine of visual_servoing
	rule r_visual_servoing_Main =
		if not hasTarget then
			r_visual_servoing_is[WITHOUT_TARGET, false, 0]
		else
			if isSeen then
				r_visual_servoing_is[if isClose and hasLaw then CONVERGED else TRACKING endif, hasLaw, 0]
			else
				if visual_servoing_isFollowing and visual_servoing_unseen < visual_servoing_patience then
					r_visual_servoing_is[COVERED, hasLaw, visual_servoing_unseen + 1]
				else
					r_visual_servoing_is[
						if visual_servoing_isFollowing or panel = LOST then LOST else SEARCHING endif,
						false,
						0]
				endif
			endif
		endif

	// the end of vs_elaborate
	rule r_end_vs_elaborate =
		r_visual_servoing_Main[]

	// a step of Arm, the machine of robot
	rule r_robot_Main =
		if isGuided then
			arm := FOLLOWING
		else
			arm := if arm = FOLLOWING or arm = STOPPING and not isStill then STOPPING else STANDING endif
		endif

	// the end of robot_elaborate
	rule r_end_robot_elaborate =
		r_robot_Main[]

	// what is computed when an elaboration ends
	rule r_endOfElaboration($p in SchedulePhase) =
		switch $p
			case vs_elaborate: r_end_vs_elaborate[]
			case robot_elaborate: r_end_robot_elaborate[]
		endswitch

	// what each task does when it is its turn
	rule r_computingTask =
		par
			r_scheduler_execute[self]
			if action(scheduler_currentPhase(self)) = ELABORATING then
				if tElapsed(self) then r_endOfElaboration[scheduler_currentPhase(self)] endif
			endif
		endpar

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
			case operator_task: ASYNCHRONOUS
			case visual_servoing_task: ASYNCHRONOUS
			otherwise SYNCHRONOUS
		endswitch
	function task_period($t in Task) =
		switch $t
			case camera_task: 100
			case robot_task: 50
			case motor_task: 10
			case encoder_task: 5
			otherwise undef
		endswitch
	function task_timeForElaboration($t in Task) =
		switch $t
			case camera_task: 62
			case robot_task: 30
			case motor_task: 8
			case encoder_task: 5
			otherwise undef
		endswitch
	function task_periodStart($t in Task) =
		switch $t
			case camera_task: -100
			case robot_task: -50
			case motor_task: -10
			case encoder_task: -5
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
			case camera_to_vs_lock: [camera_task, visual_servoing_task]
			case encoder_to_robot_lock: [encoder_task, robot_task]
			case encoder_to_motor_lock: [encoder_task, motor_task]
			case robot_to_motor_lock: [motor_task, robot_task]
			otherwise [robot_task, visual_servoing_task]
		endswitch
	function sem_state($s in Semaphore, $t in Task) = READY
	function sem_illegalPost($s in Semaphore) = false
	function semaq($s in Semaphore) = []
	function dimension($b in SwingingBuffer) =
		switch $b
			case vs_to_robot: 3
			otherwise 2
		endswitch
	function sem($b in SwingingBuffer) =
		switch $b
			case camera_to_vs: camera_to_vs_lock
			case robot_to_vs: robot_to_vs_lock
			case vs_to_robot: vs_to_robot_lock
			case encoder_to_robot: encoder_to_robot_lock
			case encoder_to_motor: encoder_to_motor_lock
			otherwise robot_to_motor_lock
		endswitch
	function sb_master($b in SwingingBuffer) =
		switch $b
			case camera_to_vs: vs_read_image
			case robot_to_vs: vs_read_robot
			case vs_to_robot: vs_write
			case encoder_to_robot: robot_read_encoder
			case encoder_to_motor: motor_read_encoder
			otherwise robot_write_motor
		endswitch
	function indexWrite($b in SwingingBuffer) = 0
	function indexRead($b in SwingingBuffer) =
		switch $b
			case vs_to_robot: 2
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
	function mq_capacity($q in MessageQueue) = 4
	function mq_sent($q in MessageQueue) = 0
	function mq_refused($q in MessageQueue) = 0
	function mq_taken($q in MessageQueue) = 0
	function scheduler_mainThread($c in Scheduler) =
		switch $c
			case operator: operator_task
			case camera: camera_task
			case visual_servoing: visual_servoing_task
			case robot: robot_task
			case motor: motor_task
			otherwise encoder_task
		endswitch
	function scheduler_currentPhase($c in Scheduler) =
		switch $c
			case operator: operator_wait
			case camera: camera_wait
			case visual_servoing: visual_servoing_wait
			case robot: robot_wait
			case motor: motor_wait
			otherwise encoder_wait
		endswitch
	function scheduler_actionStart($c in Scheduler) = 0
	function action($p in SchedulePhase) =
		switch $p
			case operator_plan: ELABORATING
			case operator_send: SENDING
			case camera_grab: ELABORATING
			case camera_write: WRITING_ON_SB
			case vs_receive_target: RECEIVING
			case vs_read_image: READING_FROM_SB
			case vs_read_robot: READING_FROM_SB
			case vs_elaborate: ELABORATING
			case vs_write: WRITING_ON_SB
			case robot_read_vs: READING_FROM_SB
			case robot_read_encoder: READING_FROM_SB
			case robot_elaborate: ELABORATING
			case robot_write_motor: WRITING_ON_SB
			case robot_write_vs: WRITING_ON_SB
			case motor_read_encoder: READING_FROM_SB
			case motor_read_robot: READING_FROM_SB
			case motor_elaborate: ELABORATING
			case encoder_acquire: ELABORATING
			case encoder_write_robot: WRITING_ON_SB
			case encoder_write_motor: WRITING_ON_SB
			otherwise WAITING_TRIGGER
		endswitch
	function time($p in SchedulePhase) =
		switch $p
			case operator_plan: 300
			case camera_grab: 60
			case vs_elaborate: 120
			case robot_elaborate: 20
			case motor_elaborate: 3
			otherwise 1
		endswitch
	function nextPhase($p in SchedulePhase) =
		switch $p
			case operator_plan: operator_send
			case operator_send: operator_wait
			case operator_wait: operator_plan
			case camera_grab: camera_write
			case camera_write: camera_wait
			case camera_wait: camera_grab
			case vs_receive_target: vs_read_image
			case vs_read_image: vs_read_robot
			case vs_read_robot: vs_elaborate
			case vs_elaborate: vs_write
			case vs_write: visual_servoing_wait
			case visual_servoing_wait: vs_receive_target
			case robot_read_vs: robot_read_encoder
			case robot_read_encoder: robot_elaborate
			case robot_elaborate: robot_write_motor
			case robot_write_motor: robot_write_vs
			case robot_write_vs: robot_wait
			case robot_wait: robot_read_vs
			case motor_read_encoder: motor_read_robot
			case motor_read_robot: motor_elaborate
			case motor_elaborate: motor_wait
			case motor_wait: motor_read_encoder
			case encoder_acquire: encoder_write_robot
			case encoder_write_robot: encoder_write_motor
			case encoder_write_motor: encoder_wait
			otherwise encoder_acquire
		endswitch
	function sharedMemory($p in SchedulePhase) =
		switch $p
			case camera_write: camera_to_vs
			case vs_read_image: camera_to_vs
			case vs_read_robot: robot_to_vs
			case vs_write: vs_to_robot
			case visual_servoing_wait: camera_to_vs
			case robot_read_vs: vs_to_robot
			case robot_read_encoder: encoder_to_robot
			case robot_write_motor: robot_to_motor
			case robot_write_vs: robot_to_vs
			case motor_read_encoder: encoder_to_motor
			case motor_read_robot: robot_to_motor
			case encoder_write_robot: encoder_to_robot
			case encoder_write_motor: encoder_to_motor
			otherwise undef
		endswitch
	function messageQueue($p in SchedulePhase) =
		switch $p
			case operator_send: targets
			case vs_receive_target: targets
			otherwise undef
		endswitch
	function elaborationRule($p in SchedulePhase) =
		switch $p
			case operator_plan: <<r_planTarget(Scheduler)>>
			case camera_grab: <<r_captureImage(Scheduler)>>
			case vs_elaborate: <<r_computeSetPoint(Scheduler)>>
			case robot_elaborate: <<r_controlRobot(Scheduler)>>
			case encoder_acquire: <<r_readEncoders(Scheduler)>>
			otherwise undef
		endswitch
	function panel = WITHOUT_TARGET
	function guiding = false
	function visual_servoing_unseen = 0
	function arm = STANDING
	agent Scheduler: r_computingTask[]
