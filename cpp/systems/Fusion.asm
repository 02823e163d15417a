/* Made from Fusion.chart. The elements, the main rule and the initial state are written
   anew from there; all else is kept. */
asm Fusion

import ../../library/std/StandardLibrary
import ../../library/patterns/ControlTask
import ../../library/patterns/VaryingTimes
import ../../library/patterns/DataAges

signature:
	static camera: Scheduler
	static camera_task: Task
	static encoder: Scheduler
	static encoder_task: Task
	static fuse: Scheduler
	static fuse_task: Task
	static operator: Scheduler
	static operator_task: Task
	static guide: Scheduler
	static guide_task: Task
	static motor: Scheduler
	static motor_task: Task
	static frames: SwingingBuffer
	static frames_lock: Semaphore
	static poses: SharedValue
	static fixes: MessageQueue
	static commands: MessageQueue
	static set: SwingingBuffer
	static set_lock: Semaphore
	static camera_look: SchedulePhase
	static camera_write_frames: SchedulePhase
	static camera_wait: SchedulePhase
	static encoder_sample: SchedulePhase
	static encoder_write_poses: SchedulePhase
	static encoder_wait: SchedulePhase
	static fuse_read_frames: SchedulePhase
	static fuse_read_poses: SchedulePhase
	static fuse_match: SchedulePhase
	static fuse_write_fixes: SchedulePhase
	static fuse_wait: SchedulePhase
	static operator_ask: SchedulePhase
	static operator_write_commands: SchedulePhase
	static operator_wait: SchedulePhase
	static guide_read_fixes: SchedulePhase
	static guide_read_commands: SchedulePhase
	static guide_plan: SchedulePhase
	static guide_write_set: SchedulePhase
	static guide_wait: SchedulePhase
	static motor_read_set: SchedulePhase
	static motor_turn: SchedulePhase
	static motor_wait: SchedulePhase
	static bound1_hop1: AgeHop
	static bound1_hop2: AgeHop
	static bound1_hop3: AgeHop
	static bound1_way1: AgeWay

definitions:
	// what each task does when it is its turn
	rule r_controlTask = r_scheduler_execute[self]

	// the same where times vary
	rule r_varyingTask = r_scheduler_executeVarying[self]

	invariant inv_patterns over sem_state, indexRead: patternsSound

	invariant inv_deadlines over task_deadlinesMissed: (forall $t in Task with task_deadlinesMissed($t) = 0)

	invariant inv_age1_camera_to_motor over way_tooOld: way_tooOld(bound1_way1) = 0

	main rule r_Main =
		seq
			par
				forall $c in Scheduler with true do program($c)
				forall $s in Semaphore with true do r_sem_arbitrate[$s]
				clock := clock + 1
			endpar
			r_ages[]
		endseq

default init s0:
	function clock = 0
	function task_kind($t in Task) =
		switch $t
			case fuse_task: ASYNCHRONOUS
			case guide_task: ASYNCHRONOUS
			otherwise SYNCHRONOUS
		endswitch
	function task_period($t in Task) =
		switch $t
			case camera_task: 20
			case encoder_task: 8
			case operator_task: 14
			case motor_task: 4
			otherwise undef
		endswitch
	function task_timeForElaboration($t in Task) =
		switch $t
			case camera_task: 12
			case encoder_task: 2
			case operator_task: 2
			case motor_task: 3
			otherwise undef
		endswitch
	function task_periodStart($t in Task) =
		switch $t
			case camera_task: -20
			case encoder_task: -6
			case operator_task: -10
			case motor_task: -4
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
			case frames_lock: [camera_task, fuse_task]
			otherwise [motor_task, guide_task]
		endswitch
	function sem_state($s in Semaphore, $t in Task) = READY
	function sem_illegalPost($s in Semaphore) = false
	function semaq($s in Semaphore) = []
	function dimension($b in SwingingBuffer) = 2
	function sem($b in SwingingBuffer) =
		switch $b
			case frames: frames_lock
			otherwise set_lock
		endswitch
	function sb_master($b in SwingingBuffer) =
		switch $b
			case frames: fuse_read_frames
			otherwise guide_write_set
		endswitch
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
			case encoder: encoder_task
			case fuse: fuse_task
			case operator: operator_task
			case guide: guide_task
			otherwise motor_task
		endswitch
	function scheduler_currentPhase($c in Scheduler) =
		switch $c
			case camera: camera_wait
			case encoder: encoder_wait
			case fuse: fuse_wait
			case operator: operator_wait
			case guide: guide_wait
			otherwise motor_wait
		endswitch
	function scheduler_actionStart($c in Scheduler) = 0
	function action($p in SchedulePhase) =
		switch $p
			case camera_look: ELABORATING
			case camera_write_frames: WRITING_ON_SB
			case encoder_sample: ELABORATING
			case encoder_write_poses: STORING
			case fuse_read_frames: READING_FROM_SB
			case fuse_read_poses: LOADING
			case fuse_match: ELABORATING
			case fuse_write_fixes: SENDING
			case operator_ask: ELABORATING
			case operator_write_commands: SENDING
			case guide_read_fixes: RECEIVING
			case guide_read_commands: RECEIVING
			case guide_plan: ELABORATING
			case guide_write_set: WRITING_ON_SB
			case motor_read_set: READING_FROM_SB
			case motor_turn: ELABORATING
			otherwise WAITING_TRIGGER
		endswitch
	function time($p in SchedulePhase) =
		switch $p
			case camera_look: 10
			case fuse_match: 6
			case guide_plan: 2
			otherwise 1
		endswitch
	function timeAtLeast($p in SchedulePhase) =
		switch $p
			case camera_look: 6
			case fuse_match: 2
			otherwise undef
		endswitch
	function nextPhase($p in SchedulePhase) =
		switch $p
			case camera_look: camera_write_frames
			case camera_write_frames: camera_wait
			case camera_wait: camera_look
			case encoder_sample: encoder_write_poses
			case encoder_write_poses: encoder_wait
			case encoder_wait: encoder_sample
			case fuse_read_frames: fuse_read_poses
			case fuse_read_poses: fuse_match
			case fuse_match: fuse_write_fixes
			case fuse_write_fixes: fuse_wait
			case fuse_wait: fuse_read_frames
			case operator_ask: operator_write_commands
			case operator_write_commands: operator_wait
			case operator_wait: operator_ask
			case guide_read_fixes: guide_read_commands
			case guide_read_commands: guide_plan
			case guide_plan: guide_write_set
			case guide_write_set: guide_wait
			case guide_wait: guide_read_fixes
			case motor_read_set: motor_turn
			case motor_turn: motor_wait
			otherwise motor_read_set
		endswitch
	function sharedMemory($p in SchedulePhase) =
		switch $p
			case camera_write_frames: frames
			case fuse_read_frames: frames
			case guide_write_set: set
			case motor_read_set: set
			otherwise undef
		endswitch
	function messageQueue($p in SchedulePhase) =
		switch $p
			case fuse_write_fixes: fixes
			case operator_write_commands: commands
			case guide_read_fixes: fixes
			case guide_read_commands: commands
			otherwise undef
		endswitch
	function sharedValue($p in SchedulePhase) =
		switch $p
			case encoder_write_poses: poses
			case fuse_read_poses: poses
			otherwise undef
		endswitch
	function awaited($p in SchedulePhase) =
		switch $p
			case fuse_wait: {fuse_read_frames, fuse_read_poses}
			case guide_wait: {guide_read_fixes, guide_read_commands}
			otherwise undef
		endswitch
	function awaitsAll($p in SchedulePhase) =
		switch $p
			case fuse_wait: true
			case guide_wait: false
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
			case bound1_hop2: fuse
			otherwise guide
		endswitch
	function hop_decided($h in AgeHop) =
		switch $h
			case bound1_hop1: camera_look
			case bound1_hop2: fuse_match
			otherwise guide_plan
		endswitch
	function hop_buffer($h in AgeHop) =
		switch $h
			case bound1_hop1: frames
			case bound1_hop3: set
			otherwise undef
		endswitch
	function hop_queue($h in AgeHop) =
		switch $h
			case bound1_hop2: fixes
			otherwise undef
		endswitch
	function hop_value($h in AgeHop) = undef
	function way_hop($w in AgeWay) = bound1_hop3
	function way_end($w in AgeWay) = motor
	function way_decided($w in AgeWay) = motor_turn
	function way_limit($w in AgeWay) = 120
	function phaseBefore($c in Scheduler) =
		switch $c
			case camera: camera_wait
			case encoder: encoder_wait
			case fuse: fuse_wait
			case operator: operator_wait
			case guide: guide_wait
			otherwise motor_wait
		endswitch
	function hop_written($h in AgeHop) = 0
	function hop_read($h in AgeHop) = 0
	function way_oldest($w in AgeWay) = 0
	function way_tooOld($w in AgeWay) = 0
	agent Scheduler: r_varyingTask[]
