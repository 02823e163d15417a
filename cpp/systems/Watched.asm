/* Made from Watched.chart. The elements, the main rule and the initial state are written
   anew from there; all else is kept. */
asm Watched

import ../../library/std/StandardLibrary
import ../../library/patterns/ControlTask
import ../../library/patterns/VaryingTimes
import ../../library/patterns/DataAges
import ../../library/patterns/MissedDeadlines
import ../../library/patterns/FreshReadings
import ../../library/patterns/ReleaseJitter

signature:
	static camera: Scheduler
	static camera_task: Task
	static vision: Scheduler
	static vision_task: Task
	static control: Scheduler
	static control_task: Task
	static motor: Scheduler
	static motor_task: Task
	static frames: SwingingBuffer
	static frames_lock: Semaphore
	static marks: MessageQueue
	static set: SharedValue
	static camera_look: SchedulePhase
	static camera_write_frames: SchedulePhase
	static camera_wait: SchedulePhase
	static vision_read_frames: SchedulePhase
	static vision_find: SchedulePhase
	static vision_write_marks: SchedulePhase
	static vision_wait: SchedulePhase
	static control_read_marks: SchedulePhase
	static control_law: SchedulePhase
	static control_write_set: SchedulePhase
	static control_wait: SchedulePhase
	static motor_read_set: SchedulePhase
	static motor_turn: SchedulePhase
	static motor_wait: SchedulePhase
	static bound1_hop1: AgeHop
	static bound1_hop2: AgeHop
	static bound1_hop3: AgeHop
	static bound2_hop1: AgeHop
	static bound1_way1: AgeWay
	static bound2_way1: AgeWay
	static control_read_marks_fresh: FreshReading
	static motor_read_set_fresh: FreshReading

definitions:
	// what each task does when it is its turn
	rule r_controlTask = r_scheduler_execute[self]

	// the same where times vary
	rule r_varyingTask = r_scheduler_executeVarying[self]

	invariant inv_patterns over sem_state, indexRead: patternsSound

	invariant inv_deadlines over task_deadlinesMissed:
		(forall $t in Task with isWeaklyHard($t) or task_deadlinesMissed($t) = 0)

	invariant inv_age1_camera_to_arm over way_tooOld: way_tooOld(bound1_way1) = 0

	invariant inv_age2_control_to_motor over way_tooOld: way_tooOld(bound2_way1) = 0

	invariant inv_misses_control over task_tooManyMissed: task_tooManyMissed(control_task) = 0

	invariant inv_fresh_control_read_marks over reading_starved: reading_starved(control_read_marks_fresh) = 0

	invariant inv_fresh_motor_read_set over reading_starved: reading_starved(motor_read_set_fresh) = 0

	main rule r_Main =
		seq
			r_beforeCycles[]
			r_beforeReadings[]
			r_release[]
			par
				forall $c in Scheduler with true do program($c)
				forall $s in Semaphore with true do r_sem_arbitrate[$s]
				clock := clock + 1
			endpar
			r_ages[]
			r_countMissed[]
			r_countReadings[]
			r_forgetReleases[]
		endseq

default init s0:
	function clock = 0
	function task_kind($t in Task) =
		switch $t
			case vision_task: ASYNCHRONOUS
			otherwise SYNCHRONOUS
		endswitch
	function task_period($t in Task) =
		switch $t
			case camera_task: 20
			case control_task: 8
			case motor_task: 4
			otherwise undef
		endswitch
	function task_deadline($t in Task) =
		switch $t
			case control_task: 7
			otherwise undef
		endswitch
	function task_timeForElaboration($t in Task) =
		switch $t
			case camera_task: 14
			case control_task: 5
			case motor_task: 3
			otherwise undef
		endswitch
	function task_jitter($t in Task) =
		switch $t
			case camera_task: 2
			case motor_task: 1
			otherwise undef
		endswitch
	function task_periodStart($t in Task) =
		switch $t
			case camera_task: -20
			case vision_task: 0
			case control_task: -5
			otherwise -4
		endswitch
	function task_timeInWait($t in Task) = 0
	function task_cycles($t in Task) = 0
	function task_deadlinesMet($t in Task) = 0
	function task_deadlinesMissed($t in Task) = 0
	function task_totalWait($t in Task) = 0
	function task_longestWait($t in Task) = 0
	function task_skipped($t in Task) = 0
	function sem_permits($s in Semaphore) = 1
	function sem_users($s in Semaphore) = [camera_task, vision_task]
	function sem_state($s in Semaphore, $t in Task) = READY
	function sem_illegalPost($s in Semaphore) = false
	function semaq($s in Semaphore) = []
	function dimension($b in SwingingBuffer) = 2
	function sem($b in SwingingBuffer) = frames_lock
	function sb_master($b in SwingingBuffer) = vision_read_frames
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
	function mq_capacity($q in MessageQueue) = 4
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
			case vision: vision_task
			case control: control_task
			otherwise motor_task
		endswitch
	function scheduler_currentPhase($c in Scheduler) =
		switch $c
			case camera: camera_wait
			case vision: vision_wait
			case control: control_wait
			otherwise motor_wait
		endswitch
	function scheduler_actionStart($c in Scheduler) = 0
	function action($p in SchedulePhase) =
		switch $p
			case camera_look: ELABORATING
			case camera_write_frames: WRITING_ON_SB
			case vision_read_frames: READING_FROM_SB
			case vision_find: ELABORATING
			case vision_write_marks: SENDING
			case control_read_marks: RECEIVING
			case control_law: ELABORATING
			case control_write_set: STORING
			case motor_read_set: LOADING
			case motor_turn: ELABORATING
			otherwise WAITING_TRIGGER
		endswitch
	function time($p in SchedulePhase) =
		switch $p
			case camera_look: 10
			case vision_find: 24
			case control_law: 3
			otherwise 1
		endswitch
	function timeAtLeast($p in SchedulePhase) =
		switch $p
			case camera_look: 6
			case vision_find: 8
			otherwise undef
		endswitch
	function nextPhase($p in SchedulePhase) =
		switch $p
			case camera_look: camera_write_frames
			case camera_write_frames: camera_wait
			case camera_wait: camera_look
			case vision_read_frames: vision_find
			case vision_find: vision_write_marks
			case vision_write_marks: vision_wait
			case vision_wait: vision_read_frames
			case control_read_marks: control_law
			case control_law: control_write_set
			case control_write_set: control_wait
			case control_wait: control_read_marks
			case motor_read_set: motor_turn
			case motor_turn: motor_wait
			otherwise motor_read_set
		endswitch
	function sharedMemory($p in SchedulePhase) =
		switch $p
			case camera_write_frames: frames
			case vision_read_frames: frames
			case vision_wait: frames
			otherwise undef
		endswitch
	function messageQueue($p in SchedulePhase) =
		switch $p
			case vision_write_marks: marks
			case control_read_marks: marks
			otherwise undef
		endswitch
	function sharedValue($p in SchedulePhase) =
		switch $p
			case control_write_set: set
			case motor_read_set: set
			otherwise undef
		endswitch
	function elaborationRule($p in SchedulePhase) = undef
	function hop_before($h in AgeHop) =
		switch $h
			case bound1_hop2: bound1_hop1
			case bound1_hop3: bound1_hop2
			otherwise undef
		endswitch
	function hop_writer($h in AgeHop) =
		switch $h
			case bound1_hop1: camera
			case bound1_hop2: vision
			otherwise control
		endswitch
	function hop_decided($h in AgeHop) =
		switch $h
			case bound1_hop1: camera_look
			case bound1_hop2: vision_find
			otherwise control_law
		endswitch
	function hop_buffer($h in AgeHop) =
		switch $h
			case bound1_hop1: frames
			otherwise undef
		endswitch
	function hop_queue($h in AgeHop) =
		switch $h
			case bound1_hop2: marks
			otherwise undef
		endswitch
	function hop_value($h in AgeHop) =
		switch $h
			case bound1_hop3: set
			case bound2_hop1: set
			otherwise undef
		endswitch
	function way_hop($w in AgeWay) =
		switch $w
			case bound1_way1: bound1_hop3
			otherwise bound2_hop1
		endswitch
	function way_end($w in AgeWay) = motor
	function way_decided($w in AgeWay) = motor_turn
	function way_limit($w in AgeWay) =
		switch $w
			case bound1_way1: 120
			otherwise 16
		endswitch
	function phaseBefore($c in Scheduler) =
		switch $c
			case camera: camera_wait
			case vision: vision_wait
			case control: control_wait
			otherwise motor_wait
		endswitch
	function hop_written($h in AgeHop) = 0
	function hop_read($h in AgeHop) = 0
	function way_oldest($w in AgeWay) = 0
	function way_tooOld($w in AgeWay) = 0
	function mayBeLate($t in Task) =
		switch $t
			case control_task: true
			otherwise undef
		endswitch
	function task_window($t in Task) =
		switch $t
			case control_task: 5
			otherwise undef
		endswitch
	function task_mayMiss($t in Task) =
		switch $t
			case control_task: 1
			otherwise undef
		endswitch
	function task_lateCycles($t in Task) = {}
	function task_mostMissed($t in Task) = 0
	function task_tooManyMissed($t in Task) = 0
	function reading_buffer($r in FreshReading) = undef
	function reading_queue($r in FreshReading) =
		switch $r
			case control_read_marks_fresh: marks
			otherwise undef
		endswitch
	function reading_value($r in FreshReading) =
		switch $r
			case motor_read_set_fresh: set
			otherwise undef
		endswitch
	function reading_limit($r in FreshReading) =
		switch $r
			case control_read_marks_fresh: 56
			otherwise 16
		endswitch
	function reading_longest($r in FreshReading) = 0
	function reading_starved($r in FreshReading) = 0
	agent Scheduler: r_varyingTask[]
