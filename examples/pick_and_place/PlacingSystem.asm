/* Made from PlacingSystem.chart. The elements, the main rule and the initial state are written
   anew from there; all else is kept. */
asm PlacingSystem

import ../../library/std/StandardLibrary
import ../../library/patterns/ControlTask

signature:
	static camera: Scheduler
	static camera_task: Task
	static vision: Scheduler
	static vision_task: Task
	static planner: Scheduler
	static planner_task: Task
	static robot: Scheduler
	static robot_task: Task
	static gripper: Scheduler
	static gripper_task: Task
	static motor: Scheduler
	static motor_task: Task
	static encoder: Scheduler
	static encoder_task: Task
	static image: SwingingBuffer
	static image_lock: Semaphore
	static parts: SwingingBuffer
	static parts_lock: Semaphore
	static progress: SwingingBuffer
	static progress_lock: Semaphore
	static moves: MessageQueue
	static encoder_to_robot: SwingingBuffer
	static encoder_to_robot_lock: Semaphore
	static encoder_to_motor: SwingingBuffer
	static encoder_to_motor_lock: Semaphore
	static robot_to_motor: SwingingBuffer
	static robot_to_motor_lock: Semaphore
	static jaw_order: SwingingBuffer
	static jaw_order_lock: Semaphore
	static grip: SwingingBuffer
	static grip_lock: Semaphore
	static camera_grab: SchedulePhase
	static camera_write: SchedulePhase
	static camera_wait: SchedulePhase
	static vision_read: SchedulePhase
	static vision_elaborate: SchedulePhase
	static vision_write: SchedulePhase
	static vision_wait: SchedulePhase
	static planner_read_parts: SchedulePhase
	static planner_read_progress: SchedulePhase
	static planner_elaborate: SchedulePhase
	static planner_send: SchedulePhase
	static planner_wait: SchedulePhase
	static robot_receive: SchedulePhase
	static robot_read_encoder: SchedulePhase
	static robot_read_grip: SchedulePhase
	static robot_elaborate: SchedulePhase
	static robot_write_motor: SchedulePhase
	static robot_write_jaw: SchedulePhase
	static robot_write_progress: SchedulePhase
	static robot_wait: SchedulePhase
	static gripper_read: SchedulePhase
	static gripper_elaborate: SchedulePhase
	static gripper_write: SchedulePhase
	static gripper_wait: SchedulePhase
	static motor_read_encoder: SchedulePhase
	static motor_read_robot: SchedulePhase
	static motor_elaborate: SchedulePhase
	static motor_wait: SchedulePhase
	static encoder_acquire: SchedulePhase
	static encoder_write_robot: SchedulePhase
	static encoder_write_motor: SchedulePhase
	static encoder_wait: SchedulePhase

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
			case vision_task: ASYNCHRONOUS
			case planner_task: ASYNCHRONOUS
			otherwise SYNCHRONOUS
		endswitch
	function task_period($t in Task) =
		switch $t
			case camera_task: 400
			case robot_task: 50
			case gripper_task: 100
			case motor_task: 10
			case encoder_task: 5
			otherwise undef
		endswitch
	function task_timeForElaboration($t in Task) =
		switch $t
			case camera_task: 62
			case robot_task: 23
			case gripper_task: 11
			case motor_task: 8
			case encoder_task: 5
			otherwise undef
		endswitch
	function task_periodStart($t in Task) =
		switch $t
			case camera_task: -400
			case robot_task: -50
			case gripper_task: -100
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
			case image_lock: [camera_task, vision_task]
			case parts_lock: [vision_task, planner_task]
			case progress_lock: [robot_task, planner_task]
			case encoder_to_robot_lock: [encoder_task, robot_task]
			case encoder_to_motor_lock: [encoder_task, motor_task]
			case robot_to_motor_lock: [motor_task, robot_task]
			otherwise [robot_task, gripper_task]
		endswitch
	function sem_state($s in Semaphore, $t in Task) = READY
	function sem_illegalPost($s in Semaphore) = false
	function semaq($s in Semaphore) = []
	function dimension($b in SwingingBuffer) =
		switch $b
			case parts: 3
			otherwise 2
		endswitch
	function sem($b in SwingingBuffer) =
		switch $b
			case image: image_lock
			case parts: parts_lock
			case progress: progress_lock
			case encoder_to_robot: encoder_to_robot_lock
			case encoder_to_motor: encoder_to_motor_lock
			case robot_to_motor: robot_to_motor_lock
			case jaw_order: jaw_order_lock
			otherwise grip_lock
		endswitch
	function sb_master($b in SwingingBuffer) =
		switch $b
			case image: vision_read
			case parts: vision_write
			case progress: planner_read_progress
			case encoder_to_robot: robot_read_encoder
			case encoder_to_motor: motor_read_encoder
			case robot_to_motor: robot_write_motor
			case jaw_order: gripper_read
			otherwise gripper_write
		endswitch
	function indexWrite($b in SwingingBuffer) = 0
	function indexRead($b in SwingingBuffer) =
		switch $b
			case parts: 2
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
			case camera: camera_task
			case vision: vision_task
			case planner: planner_task
			case robot: robot_task
			case gripper: gripper_task
			case motor: motor_task
			otherwise encoder_task
		endswitch
	function scheduler_currentPhase($c in Scheduler) =
		switch $c
			case camera: camera_wait
			case vision: vision_wait
			case planner: planner_wait
			case robot: robot_wait
			case gripper: gripper_wait
			case motor: motor_wait
			otherwise encoder_wait
		endswitch
	function scheduler_actionStart($c in Scheduler) = 0
	function action($p in SchedulePhase) =
		switch $p
			case camera_grab: ELABORATING
			case camera_wait: WAITING_TRIGGER
			case vision_read: READING_FROM_SB
			case vision_elaborate: ELABORATING
			case vision_wait: WAITING_TRIGGER
			case planner_read_parts: READING_FROM_SB
			case planner_read_progress: READING_FROM_SB
			case planner_elaborate: ELABORATING
			case planner_send: SENDING
			case planner_wait: WAITING_TRIGGER
			case robot_receive: RECEIVING
			case robot_read_encoder: READING_FROM_SB
			case robot_read_grip: READING_FROM_SB
			case robot_elaborate: ELABORATING
			case robot_wait: WAITING_TRIGGER
			case gripper_read: READING_FROM_SB
			case gripper_elaborate: ELABORATING
			case gripper_wait: WAITING_TRIGGER
			case motor_read_encoder: READING_FROM_SB
			case motor_read_robot: READING_FROM_SB
			case motor_elaborate: ELABORATING
			case motor_wait: WAITING_TRIGGER
			case encoder_acquire: ELABORATING
			case encoder_wait: WAITING_TRIGGER
			otherwise WRITING_ON_SB
		endswitch
	function time($p in SchedulePhase) =
		switch $p
			case camera_grab: 60
			case vision_elaborate: 150
			case planner_elaborate: 100
			case robot_elaborate: 10
			case gripper_elaborate: 5
			case motor_elaborate: 3
			otherwise 1
		endswitch
	function nextPhase($p in SchedulePhase) =
		switch $p
			case camera_grab: camera_write
			case camera_write: camera_wait
			case camera_wait: camera_grab
			case vision_read: vision_elaborate
			case vision_elaborate: vision_write
			case vision_write: vision_wait
			case vision_wait: vision_read
			case planner_read_parts: planner_read_progress
			case planner_read_progress: planner_elaborate
			case planner_elaborate: planner_send
			case planner_send: planner_wait
			case planner_wait: planner_read_parts
			case robot_receive: robot_read_encoder
			case robot_read_encoder: robot_read_grip
			case robot_read_grip: robot_elaborate
			case robot_elaborate: robot_write_motor
			case robot_write_motor: robot_write_jaw
			case robot_write_jaw: robot_write_progress
			case robot_write_progress: robot_wait
			case robot_wait: robot_receive
			case gripper_read: gripper_elaborate
			case gripper_elaborate: gripper_write
			case gripper_write: gripper_wait
			case gripper_wait: gripper_read
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
			case camera_write: image
			case vision_read: image
			case vision_write: parts
			case vision_wait: image
			case planner_read_parts: parts
			case planner_read_progress: progress
			case planner_wait: progress
			case robot_read_encoder: encoder_to_robot
			case robot_read_grip: grip
			case robot_write_motor: robot_to_motor
			case robot_write_jaw: jaw_order
			case robot_write_progress: progress
			case gripper_read: jaw_order
			case gripper_write: grip
			case motor_read_encoder: encoder_to_motor
			case motor_read_robot: robot_to_motor
			case encoder_write_robot: encoder_to_robot
			case encoder_write_motor: encoder_to_motor
			otherwise undef
		endswitch
	function messageQueue($p in SchedulePhase) =
		switch $p
			case planner_send: moves
			case robot_receive: moves
			otherwise undef
		endswitch
	function elaborationRule($p in SchedulePhase) = undef
	agent Scheduler: r_controlTask[]
