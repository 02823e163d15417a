/* Made from AssemblySystem.chart. The elements, the main rule and the initial state are written
   anew from there; all else is kept. */
asm AssemblySystem

import ../../library/std/StandardLibrary
import ../../library/patterns/ControlTask

signature:
	static microscope: Scheduler
	static microscope_task: Task
	static aligner: Scheduler
	static aligner_task: Task
	static force: Scheduler
	static force_task: Task
	static stage: Scheduler
	static stage_task: Task
	static piezo: Scheduler
	static piezo_task: Task
	static scales_reader: Scheduler
	static scales_reader_task: Task
	static supervisor: Scheduler
	static supervisor_task: Task
	static image: SwingingBuffer
	static image_lock: Semaphore
	static recipe: MessageQueue
	static correction: SwingingBuffer
	static correction_lock: Semaphore
	static contact: SwingingBuffer
	static contact_lock: Semaphore
	static scale: SwingingBuffer
	static scale_lock: Semaphore
	static axis_order: SwingingBuffer
	static axis_order_lock: Semaphore
	static state: SwingingBuffer
	static state_lock: Semaphore
	static microscope_grab: SchedulePhase
	static microscope_write: SchedulePhase
	static microscope_wait: SchedulePhase
	static aligner_receive: SchedulePhase
	static aligner_read_image: SchedulePhase
	static aligner_elaborate: SchedulePhase
	static aligner_write: SchedulePhase
	static aligner_wait: SchedulePhase
	static force_elaborate: SchedulePhase
	static force_write: SchedulePhase
	static force_wait: SchedulePhase
	static stage_read_correction: SchedulePhase
	static stage_read_contact: SchedulePhase
	static stage_read_scale: SchedulePhase
	static stage_elaborate: SchedulePhase
	static stage_write_axes: SchedulePhase
	static stage_write_state: SchedulePhase
	static stage_wait: SchedulePhase
	static piezo_read: SchedulePhase
	static piezo_elaborate: SchedulePhase
	static piezo_wait: SchedulePhase
	static scales_acquire: SchedulePhase
	static scales_write: SchedulePhase
	static scales_reader_wait: SchedulePhase
	static supervisor_read: SchedulePhase
	static supervisor_elaborate: SchedulePhase
	static supervisor_send: SchedulePhase
	static supervisor_wait: SchedulePhase

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
			case aligner_task: ASYNCHRONOUS
			case supervisor_task: ASYNCHRONOUS
			otherwise SYNCHRONOUS
		endswitch
	function task_period($t in Task) =
		switch $t
			case microscope_task: 200
			case force_task: 10
			case stage_task: 20
			case piezo_task: 5
			case scales_reader_task: 10
			otherwise undef
		endswitch
	function task_timeForElaboration($t in Task) =
		switch $t
			case microscope_task: 82
			case force_task: 4
			case stage_task: 16
			case piezo_task: 3
			case scales_reader_task: 3
			otherwise undef
		endswitch
	function task_periodStart($t in Task) =
		switch $t
			case microscope_task: -200
			case force_task: -10
			case stage_task: -20
			case piezo_task: -5
			case scales_reader_task: -10
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
			case image_lock: [microscope_task, aligner_task]
			case correction_lock: [stage_task, aligner_task]
			case contact_lock: [force_task, stage_task]
			case scale_lock: [scales_reader_task, stage_task]
			case axis_order_lock: [piezo_task, stage_task]
			otherwise [stage_task, supervisor_task]
		endswitch
	function sem_state($s in Semaphore, $t in Task) = READY
	function sem_illegalPost($s in Semaphore) = false
	function semaq($s in Semaphore) = []
	function dimension($b in SwingingBuffer) =
		switch $b
			case correction: 3
			otherwise 2
		endswitch
	function sem($b in SwingingBuffer) =
		switch $b
			case image: image_lock
			case correction: correction_lock
			case contact: contact_lock
			case scale: scale_lock
			case axis_order: axis_order_lock
			otherwise state_lock
		endswitch
	function sb_master($b in SwingingBuffer) =
		switch $b
			case image: aligner_read_image
			case correction: aligner_write
			case contact: stage_read_contact
			case scale: stage_read_scale
			case axis_order: stage_write_axes
			otherwise supervisor_read
		endswitch
	function indexWrite($b in SwingingBuffer) = 0
	function indexRead($b in SwingingBuffer) =
		switch $b
			case correction: 2
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
			case microscope: microscope_task
			case aligner: aligner_task
			case force: force_task
			case stage: stage_task
			case piezo: piezo_task
			case scales_reader: scales_reader_task
			otherwise supervisor_task
		endswitch
	function scheduler_currentPhase($c in Scheduler) =
		switch $c
			case microscope: microscope_wait
			case aligner: aligner_wait
			case force: force_wait
			case stage: stage_wait
			case piezo: piezo_wait
			case scales_reader: scales_reader_wait
			otherwise supervisor_wait
		endswitch
	function scheduler_actionStart($c in Scheduler) = 0
	function action($p in SchedulePhase) =
		switch $p
			case microscope_grab: ELABORATING
			case microscope_write: WRITING_ON_SB
			case aligner_receive: RECEIVING
			case aligner_read_image: READING_FROM_SB
			case aligner_elaborate: ELABORATING
			case aligner_write: WRITING_ON_SB
			case force_elaborate: ELABORATING
			case force_write: WRITING_ON_SB
			case stage_read_correction: READING_FROM_SB
			case stage_read_contact: READING_FROM_SB
			case stage_read_scale: READING_FROM_SB
			case stage_elaborate: ELABORATING
			case stage_write_axes: WRITING_ON_SB
			case stage_write_state: WRITING_ON_SB
			case piezo_read: READING_FROM_SB
			case piezo_elaborate: ELABORATING
			case scales_acquire: ELABORATING
			case scales_write: WRITING_ON_SB
			case supervisor_read: READING_FROM_SB
			case supervisor_elaborate: ELABORATING
			case supervisor_send: SENDING
			otherwise WAITING_TRIGGER
		endswitch
	function time($p in SchedulePhase) =
		switch $p
			case microscope_grab: 80
			case aligner_elaborate: 90
			case force_elaborate: 2
			case stage_elaborate: 3
			case supervisor_elaborate: 50
			otherwise 1
		endswitch
	function nextPhase($p in SchedulePhase) =
		switch $p
			case microscope_grab: microscope_write
			case microscope_write: microscope_wait
			case microscope_wait: microscope_grab
			case aligner_receive: aligner_read_image
			case aligner_read_image: aligner_elaborate
			case aligner_elaborate: aligner_write
			case aligner_write: aligner_wait
			case aligner_wait: aligner_receive
			case force_elaborate: force_write
			case force_write: force_wait
			case force_wait: force_elaborate
			case stage_read_correction: stage_read_contact
			case stage_read_contact: stage_read_scale
			case stage_read_scale: stage_elaborate
			case stage_elaborate: stage_write_axes
			case stage_write_axes: stage_write_state
			case stage_write_state: stage_wait
			case stage_wait: stage_read_correction
			case piezo_read: piezo_elaborate
			case piezo_elaborate: piezo_wait
			case piezo_wait: piezo_read
			case scales_acquire: scales_write
			case scales_write: scales_reader_wait
			case scales_reader_wait: scales_acquire
			case supervisor_read: supervisor_elaborate
			case supervisor_elaborate: supervisor_send
			case supervisor_send: supervisor_wait
			otherwise supervisor_read
		endswitch
	function sharedMemory($p in SchedulePhase) =
		switch $p
			case microscope_write: image
			case aligner_read_image: image
			case aligner_write: correction
			case aligner_wait: image
			case force_write: contact
			case stage_read_correction: correction
			case stage_read_contact: contact
			case stage_read_scale: scale
			case stage_write_axes: axis_order
			case stage_write_state: state
			case piezo_read: axis_order
			case scales_write: scale
			case supervisor_read: state
			case supervisor_wait: state
			otherwise undef
		endswitch
	function messageQueue($p in SchedulePhase) =
		switch $p
			case aligner_receive: recipe
			case supervisor_send: recipe
			otherwise undef
		endswitch
	function elaborationRule($p in SchedulePhase) = undef
	agent Scheduler: r_controlTask[]
