/* Made from PlacingSystem.chart. The elements, the main rule and the initial state are written
   anew from there; all else is kept. */
asm PlacingSystem

import ../../library/std/StandardLibrary
import ../../library/patterns/ControlTask
import CTLLibrary
import LTLLibrary
import Placing

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

	static sight: SwingingBuffer

	static sight_lock: Semaphore

	static target: SwingingBuffer

	static target_lock: Semaphore

	static vision_write_sight: SchedulePhase

	static planner_read_sight: SchedulePhase

	static planner_write_target: SchedulePhase

	static robot_read_target: SchedulePhase

	// what the data of sight say, by their numbers
	controlled sight_value: Integer -> Boolean

	// what the data of progress say, by their numbers
	controlled progress_value: Integer -> Prod(Number, Boolean)

	// what the data of moves say, by their numbers
	controlled moves_value: Integer -> Prod(Number, Move)

	// what the data of jaw_order say, by their numbers
	controlled jaw_order_value: Integer -> Boolean

	// what the data of grip say, by their numbers
	controlled grip_value: Integer -> Jaw

	enum domain PlannerWork = {PLANNER_LOOKING | PLANNER_WAITING}

	domain PlannerImages subsetof Integer

	domain PlannerPlaces subsetof Integer

	derived planner_sight: Boolean

	derived planner_isNewSight: Boolean

	derived planner_progress: Prod(Number, Boolean)

	derived planner_isNewProgress: Boolean

	controlled planner_moves: Prod(Number, Move)

	controlled planner_work: PlannerWork

	controlled planner_number: Number

	controlled planner_move: Move

	controlled planner_images: PlannerImages

	controlled planner_placed: PlannerPlaces

	static planner_old: PlannerImages

	static planner_places: PlannerPlaces

	derived planner_isDone: Boolean

	// Arm: the tool is there
	monitored arrived: Boolean

	derived robot_moves: Prod(Number, Move)

	derived robot_isNewMoves: Boolean

	derived robot_grip: Jaw

	controlled robot_jaw_order: Boolean

	controlled robot_progress: Prod(Number, Boolean)

	controlled robot_number: Number

	controlled robot_move: Move

	derived robot_isAnother: Boolean

	derived robot_isDone: Boolean

	// how many messages of moves its elaborations have seen
	controlled robot_taken_moves: Integer

	// Jaw sensor
	monitored jaw: Feel

	// Gripper valve
	out valve: Boolean

	derived gripper_jaw_order: Boolean

	derived gripper_isNewJaw_order: Boolean

	controlled gripper_grip: Jaw

	// what vision computes for sight
	monitored vision_sight: Boolean

definitions:
	// what each task does when it is its turn
	rule r_controlTask = r_scheduler_execute[self]

	invariant inv_patterns over sem_state, indexRead: patternsSound

	invariant inv_deadlines over task_deadlinesMissed: (forall $t in Task with task_deadlinesMissed($t) = 0)

	domain PlannerImages = {0 : 2}

	domain PlannerPlaces = {0 : 3}

	function planner_old = 2

	function planner_places = 3

	function planner_isDone =
		planner_work = PLANNER_WAITING and planner_isNewProgress and first(planner_progress) = planner_number

	rule r_planner_send($move in Move) =
		let ($number = (planner_number + 1) mod 4) in
			par
				planner_work := PLANNER_WAITING
				planner_number := $number
				planner_move := $move
				planner_moves := ($number, $move)
			endpar
		endlet

	rule r_planner_rest =
		par
			planner_work := PLANNER_LOOKING
			planner_images := 0
		endpar

	rule r_planner_look =
		if planner_isNewSight then
			if planner_images < planner_old then
				planner_images := planner_images + 1
			else
				if planner_sight and planner_placed < planner_places then r_planner_send[OVER] endif
			endif
		endif

	rule r_planner_goOn =
		switch planner_move
			case OVER: r_planner_send[DOWN]
			case DOWN: r_planner_send[CLOSE]
			case CLOSE: r_planner_send[UP]
			case UP:
				if second(planner_progress) then r_planner_send[CARRY] else r_planner_send[REOPEN] endif
			case CARRY: r_planner_send[LOWER]
			case LOWER: r_planner_send[OPEN]
			case OPEN: r_planner_send[RISE]
			case RISE:
				par
					planner_placed := planner_placed + 1
					r_planner_rest[]
				endpar
			case REOPEN: r_planner_rest[]
		endswitch

	// a step of Planner, the machine of planner
	rule r_planner_Main =
		if planner_work = PLANNER_LOOKING then
			r_planner_look[]
		else
			if planner_isDone then r_planner_goOn[] endif
		endif

	// what was read from sight
	function planner_sight = sight_value(sb_receivedSequence(sight))

	// it was not there in the elaboration before: sight
	function planner_isNewSight = sb_fresh(sight)

	// what was read from progress
	function planner_progress = progress_value(sb_receivedSequence(progress))

	// it was not there in the elaboration before: progress
	function planner_isNewProgress = sb_fresh(progress)

	// the end of planner_elaborate
	rule r_end_planner_elaborate =
		seq
			r_planner_Main[]
			moves_value(mq_sent(moves) + 1) := planner_moves
		endseq

	function robot_isAnother = robot_isNewMoves and first(robot_moves) != robot_number

	function robot_isDone =
		switch robot_move
			case CLOSE: robot_grip = EMPTY or robot_grip = HOLDING
			case OPEN: robot_grip = OPENED
			case REOPEN: robot_grip = OPENED
			otherwise arrived
		endswitch

	rule r_robot_begin =
		par
			robot_number := first(robot_moves)
			robot_move := second(robot_moves)
			if second(robot_moves) = CLOSE then robot_jaw_order := true endif
			if second(robot_moves) = OPEN or second(robot_moves) = REOPEN then robot_jaw_order := false endif
		endpar

	// a step of Robot, the machine of robot
	rule r_robot_Main =
		if robot_isAnother then
			r_robot_begin[]
		else
			if robot_isDone then robot_progress := (robot_number, robot_grip = HOLDING) endif
		endif

	// what was read from moves
	function robot_moves = moves_value(mq_taken(moves))

	// it was not there in the elaboration before: moves
	function robot_isNewMoves = mq_taken(moves) != robot_taken_moves

	// what was read from grip
	function robot_grip = grip_value(sb_receivedSequence(grip))

	// the end of robot_elaborate
	rule r_end_robot_elaborate =
		seq
			r_robot_Main[]
			par
				jaw_order_value(sb_written(jaw_order) + 1) := robot_jaw_order
				progress_value(sb_written(progress) + 1) := robot_progress
				robot_taken_moves := mq_taken(moves)
			endpar
		endseq

	rule r_gripper_feel =
		if valve then
			switch jaw
				case AROUND: gripper_grip := HOLDING
				case SHUT: gripper_grip := EMPTY
				otherwise gripper_grip := BUSY
			endswitch
		else
			gripper_grip := if jaw = WIDE then OPENED else BUSY endif
		endif

	// a step of Gripper, the machine of gripper
	rule r_gripper_Main =
		if gripper_isNewJaw_order and gripper_jaw_order != valve then
			par
				valve := gripper_jaw_order
				gripper_grip := BUSY
			endpar
		else
			r_gripper_feel[]
		endif

	// what was read from jaw_order
	function gripper_jaw_order = jaw_order_value(sb_receivedSequence(jaw_order))

	// it was not there in the elaboration before: jaw_order
	function gripper_isNewJaw_order = sb_fresh(jaw_order)

	// the end of gripper_elaborate
	rule r_end_gripper_elaborate =
		seq
			r_gripper_Main[]
			grip_value(sb_written(grip) + 1) := gripper_grip
		endseq

	// the end of vision_elaborate
	rule r_end_vision_elaborate =
		sight_value(sb_written(sight) + 1) := vision_sight

	// what is computed when an elaboration ends
	rule r_endOfElaboration($p in SchedulePhase) =
		switch $p
			case planner_elaborate: r_end_planner_elaborate[]
			case robot_elaborate: r_end_robot_elaborate[]
			case gripper_elaborate: r_end_gripper_elaborate[]
			case vision_elaborate: r_end_vision_elaborate[]
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
			case robot_task: 25
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
			case sight_lock: [vision_task, planner_task]
			case progress_lock: [robot_task, planner_task]
			case target_lock: [robot_task, planner_task]
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
			case sight: 3
			otherwise 2
		endswitch
	function sem($b in SwingingBuffer) =
		switch $b
			case image: image_lock
			case parts: parts_lock
			case sight: sight_lock
			case progress: progress_lock
			case target: target_lock
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
			case sight: vision_write_sight
			case progress: planner_read_progress
			case target: planner_write_target
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
			case sight: 2
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
			case planner_read_progress: READING_FROM_SB
			case planner_read_sight: READING_FROM_SB
			case planner_read_parts: READING_FROM_SB
			case planner_elaborate: ELABORATING
			case planner_send: SENDING
			case planner_wait: WAITING_TRIGGER
			case robot_receive: RECEIVING
			case robot_read_target: READING_FROM_SB
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
			case vision_write: vision_write_sight
			case vision_write_sight: vision_wait
			case vision_wait: vision_read
			case planner_read_progress: planner_read_sight
			case planner_read_sight: planner_read_parts
			case planner_read_parts: planner_elaborate
			case planner_elaborate: planner_write_target
			case planner_write_target: planner_send
			case planner_send: planner_wait
			case planner_wait: planner_read_progress
			case robot_receive: robot_read_target
			case robot_read_target: robot_read_encoder
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
			case vision_write_sight: sight
			case vision_wait: image
			case planner_read_progress: progress
			case planner_read_sight: sight
			case planner_read_parts: parts
			case planner_write_target: target
			case planner_wait: progress
			case robot_read_target: target
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
	function planner_work = PLANNER_LOOKING
	function planner_number = 0
	function planner_move = REOPEN
	function planner_moves = (0, REOPEN)
	function planner_images = 0
	function planner_placed = 0
	function robot_number = 0
	function robot_move = REOPEN
	function robot_jaw_order = false
	function robot_progress = (0, false)
	function robot_taken_moves = 0
	function valve = false
	function gripper_grip = BUSY
	agent Scheduler: r_computingTask[]
