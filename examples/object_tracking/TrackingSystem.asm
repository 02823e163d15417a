/* Made from TrackingSystem.chart. The elements, the main rule, the initial state and what comes from its components' machines are written
   anew from there; all else is kept. */
asm TrackingSystem

import CTLLibrary
import LTLLibrary
import ../../library/std/StandardLibrary
import ../../library/patterns/ControlTask
import Tracking

signature:
	static camera: Scheduler
	static camera_task: Task
	static tracker: Scheduler
	static tracker_task: Task
	static head: Scheduler
	static head_task: Task
	static motor: Scheduler
	static motor_task: Task
	static encoder: Scheduler
	static encoder_task: Task
	static display: Scheduler
	static display_task: Task
	static image: SwingingBuffer
	static image_lock: Semaphore
	static head_angles: SwingingBuffer
	static head_angles_lock: Semaphore
	static track: SwingingBuffer
	static track_lock: Semaphore
	static sight: SharedValue
	static aim: SharedValue
	static sightings: MessageQueue
	static encoder_to_head: SwingingBuffer
	static encoder_to_head_lock: Semaphore
	static encoder_to_motor: SwingingBuffer
	static encoder_to_motor_lock: Semaphore
	static head_to_motor: SwingingBuffer
	static head_to_motor_lock: Semaphore
	static camera_grab: SchedulePhase
	static camera_write: SchedulePhase
	static camera_wait: SchedulePhase
	static tracker_read_image: SchedulePhase
	static tracker_read_angles: SchedulePhase
	static tracker_read_aim: SchedulePhase
	static tracker_elaborate: SchedulePhase
	static tracker_write: SchedulePhase
	static tracker_write_sight: SchedulePhase
	static tracker_tell: SchedulePhase
	static tracker_wait: SchedulePhase
	static head_read_sight: SchedulePhase
	static head_read_track: SchedulePhase
	static head_read_encoder: SchedulePhase
	static head_elaborate: SchedulePhase
	static head_write_motor: SchedulePhase
	static head_write_angles: SchedulePhase
	static head_write_aim: SchedulePhase
	static head_wait: SchedulePhase
	static motor_read_encoder: SchedulePhase
	static motor_read_head: SchedulePhase
	static motor_elaborate: SchedulePhase
	static motor_wait: SchedulePhase
	static encoder_acquire: SchedulePhase
	static encoder_write_head: SchedulePhase
	static encoder_write_motor: SchedulePhase
	static encoder_wait: SchedulePhase
	static display_receive: SchedulePhase
	static display_show: SchedulePhase
	static display_wait: SchedulePhase
	// what the data of sight say, by their numbers
	controlled sight_value: Integer -> Boolean
	// what the data of aim say, by their numbers
	controlled aim_value: Integer -> Pursuit
	// Detector: the object is in the image
	monitored found: Boolean
	enum domain TrackerMode = {TRACKER_SEARCHING | TRACKER_TRACKING | TRACKER_COVERED}
	derived tracker_aim: Pursuit
	controlled tracker_sight: Boolean
	controlled tracker_mode: TrackerMode
	derived tracker_isGivenUp: Boolean
	domain HeadCycles subsetof Integer
	derived head_sight: Boolean
	derived head_isNewSight: Boolean
	controlled head_aim: Pursuit
	controlled head_unseen: HeadCycles
	static head_patience: HeadCycles
	derived head_isSeen: Boolean

definitions:
	// what each task does when it is its turn
	rule r_controlTask = r_scheduler_execute[self]

	invariant inv_patterns over sem_state, indexRead: patternsSound

	invariant inv_deadlines over task_deadlinesMissed: (forall $t in Task with task_deadlinesMissed($t) = 0)

	function tracker_isGivenUp = not found and tracker_aim != FOLLOWING

	// a step of Tracker, the machine of tracker
	rule r_tracker_Main =
		par
			tracker_sight := found
			if found then
				tracker_mode := TRACKER_TRACKING
			else
				tracker_mode :=
					if tracker_mode = TRACKER_SEARCHING or tracker_isGivenUp then
						TRACKER_SEARCHING
					else
						TRACKER_COVERED
					endif
			endif
		endpar

	// what was read from aim
	function tracker_aim = aim_value(sv_receivedSequence(aim))

	// the end of tracker_elaborate
	rule r_end_tracker_elaborate =
		seq
			r_tracker_Main[]
			sight_value(sv_sequence(sight) + 1) := tracker_sight
		endseq

	domain HeadCycles = {0 : 60}

	function head_patience = 60

	function head_isSeen = head_isNewSight and head_sight

	// a step of Head, the machine of head
	rule r_head_Main =
		if head_isSeen then
			par
				head_unseen := 0
				head_aim := FOLLOWING
			endpar
		else
			if head_unseen < head_patience then
				par
					head_unseen := head_unseen + 1
					if head_unseen + 1 = head_patience then head_aim := HOLDING endif
				endpar
			endif
		endif

	// what was read from sight
	function head_sight = sight_value(sv_receivedSequence(sight))

	// it was not there in the elaboration before: sight
	function head_isNewSight = sv_fresh(sight)

	// the end of head_elaborate
	rule r_end_head_elaborate =
		seq
			r_head_Main[]
			aim_value(sv_sequence(aim) + 1) := head_aim
		endseq

	// what is computed when an elaboration ends
	rule r_endOfElaboration($p in SchedulePhase) =
		switch $p
			case tracker_elaborate: r_end_tracker_elaborate[]
			case head_elaborate: r_end_head_elaborate[]
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
			case tracker_task: ASYNCHRONOUS
			case display_task: ASYNCHRONOUS
			otherwise SYNCHRONOUS
		endswitch
	function task_period($t in Task) =
		switch $t
			case camera_task: 100
			case head_task: 50
			case motor_task: 10
			case encoder_task: 5
			otherwise undef
		endswitch
	function task_timeForElaboration($t in Task) =
		switch $t
			case camera_task: 42
			case head_task: 17
			case motor_task: 8
			case encoder_task: 5
			otherwise undef
		endswitch
	function task_periodStart($t in Task) =
		switch $t
			case camera_task: -100
			case head_task: -50
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
			case image_lock: [camera_task, tracker_task]
			case encoder_to_head_lock: [encoder_task, head_task]
			case encoder_to_motor_lock: [encoder_task, motor_task]
			case head_to_motor_lock: [motor_task, head_task]
			otherwise [head_task, tracker_task]
		endswitch
	function sem_state($s in Semaphore, $t in Task) = READY
	function sem_illegalPost($s in Semaphore) = false
	function semaq($s in Semaphore) = []
	function dimension($b in SwingingBuffer) =
		switch $b
			case track: 3
			otherwise 2
		endswitch
	function sem($b in SwingingBuffer) =
		switch $b
			case image: image_lock
			case head_angles: head_angles_lock
			case track: track_lock
			case encoder_to_head: encoder_to_head_lock
			case encoder_to_motor: encoder_to_motor_lock
			otherwise head_to_motor_lock
		endswitch
	function sb_master($b in SwingingBuffer) =
		switch $b
			case image: tracker_read_image
			case head_angles: tracker_read_angles
			case track: tracker_write
			case encoder_to_head: head_read_encoder
			case encoder_to_motor: motor_read_encoder
			otherwise head_write_motor
		endswitch
	function indexWrite($b in SwingingBuffer) = 0
	function indexRead($b in SwingingBuffer) =
		switch $b
			case track: 2
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
	function mq_capacity($q in MessageQueue) = 8
	function mq_sent($q in MessageQueue) = 0
	function mq_refused($q in MessageQueue) = 0
	function mq_taken($q in MessageQueue) = 0
	function sv_sequence($v in SharedValue) = 0
	function sv_overwritten($v in SharedValue) = 0
	function sv_receivedSequence($v in SharedValue) = 0
	function sv_fresh($v in SharedValue) = false
	function scheduler_mainThread($c in Scheduler) =
		switch $c
			case camera: camera_task
			case tracker: tracker_task
			case head: head_task
			case motor: motor_task
			case encoder: encoder_task
			otherwise display_task
		endswitch
	function scheduler_currentPhase($c in Scheduler) =
		switch $c
			case camera: camera_wait
			case tracker: tracker_wait
			case head: head_wait
			case motor: motor_wait
			case encoder: encoder_wait
			otherwise display_wait
		endswitch
	function scheduler_actionStart($c in Scheduler) = 0
	function action($p in SchedulePhase) =
		switch $p
			case camera_grab: ELABORATING
			case camera_write: WRITING_ON_SB
			case tracker_read_image: READING_FROM_SB
			case tracker_read_angles: READING_FROM_SB
			case tracker_read_aim: LOADING
			case tracker_elaborate: ELABORATING
			case tracker_write: WRITING_ON_SB
			case tracker_write_sight: STORING
			case tracker_tell: SENDING
			case head_read_sight: LOADING
			case head_read_track: READING_FROM_SB
			case head_read_encoder: READING_FROM_SB
			case head_elaborate: ELABORATING
			case head_write_motor: WRITING_ON_SB
			case head_write_angles: WRITING_ON_SB
			case head_write_aim: STORING
			case motor_read_encoder: READING_FROM_SB
			case motor_read_head: READING_FROM_SB
			case motor_elaborate: ELABORATING
			case encoder_acquire: ELABORATING
			case encoder_write_head: WRITING_ON_SB
			case encoder_write_motor: WRITING_ON_SB
			case display_receive: RECEIVING
			case display_show: ELABORATING
			otherwise WAITING_TRIGGER
		endswitch
	function time($p in SchedulePhase) =
		switch $p
			case camera_grab: 40
			case tracker_elaborate: 50
			case head_elaborate: 5
			case motor_elaborate: 3
			case display_show: 50
			otherwise 1
		endswitch
	function nextPhase($p in SchedulePhase) =
		switch $p
			case camera_grab: camera_write
			case camera_write: camera_wait
			case camera_wait: camera_grab
			case tracker_read_image: tracker_read_angles
			case tracker_read_angles: tracker_read_aim
			case tracker_read_aim: tracker_elaborate
			case tracker_elaborate: tracker_write
			case tracker_write: tracker_write_sight
			case tracker_write_sight: tracker_tell
			case tracker_tell: tracker_wait
			case tracker_wait: tracker_read_image
			case head_read_sight: head_read_track
			case head_read_track: head_read_encoder
			case head_read_encoder: head_elaborate
			case head_elaborate: head_write_motor
			case head_write_motor: head_write_angles
			case head_write_angles: head_write_aim
			case head_write_aim: head_wait
			case head_wait: head_read_sight
			case motor_read_encoder: motor_read_head
			case motor_read_head: motor_elaborate
			case motor_elaborate: motor_wait
			case motor_wait: motor_read_encoder
			case encoder_acquire: encoder_write_head
			case encoder_write_head: encoder_write_motor
			case encoder_write_motor: encoder_wait
			case encoder_wait: encoder_acquire
			case display_receive: display_show
			case display_show: display_wait
			otherwise display_receive
		endswitch
	function sharedMemory($p in SchedulePhase) =
		switch $p
			case camera_write: image
			case tracker_read_image: image
			case tracker_read_angles: head_angles
			case tracker_write: track
			case tracker_wait: image
			case head_read_track: track
			case head_read_encoder: encoder_to_head
			case head_write_motor: head_to_motor
			case head_write_angles: head_angles
			case motor_read_encoder: encoder_to_motor
			case motor_read_head: head_to_motor
			case encoder_write_head: encoder_to_head
			case encoder_write_motor: encoder_to_motor
			otherwise undef
		endswitch
	function messageQueue($p in SchedulePhase) =
		switch $p
			case tracker_tell: sightings
			case display_receive: sightings
			case display_wait: sightings
			otherwise undef
		endswitch
	function sharedValue($p in SchedulePhase) =
		switch $p
			case tracker_read_aim: aim
			case tracker_write_sight: sight
			case head_read_sight: sight
			case head_write_aim: aim
			otherwise undef
		endswitch
	function elaborationRule($p in SchedulePhase) = undef
	function tracker_sight = false
	function tracker_mode = TRACKER_SEARCHING
	function head_unseen = head_patience
	function head_aim = HOLDING
	agent Scheduler: r_computingTask[]
