/* Made from ValuePair.chart. The elements, the main rule and the initial state are written
   anew from there; all else is kept. */
asm ValuePair

import ../../std/StandardLibrary
import ../ControlTask

export *

signature:
	static sense: Scheduler
	static sense_task: Task
	static control: Scheduler
	static control_task: Task
	static watch: Scheduler
	static watch_task: Task
	static level: SharedValue
	static state: SharedValue
	static sense_acquire: SchedulePhase
	static sense_write_level: SchedulePhase
	static sense_wait: SchedulePhase
	static control_read_level: SchedulePhase
	static control_law: SchedulePhase
	static control_write_state: SchedulePhase
	static control_wait: SchedulePhase
	static watch_read_state: SchedulePhase
	static watch_wait: SchedulePhase

definitions:
	// The value is the tick of its acquisition.
	rule r_acquire($c in Scheduler) =
		sv_staged(level) := clock

	// What is known of the level goes on to the watcher.
	rule r_law($c in Scheduler) =
		sv_staged(state) := sv_received(level)

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
			case watch_task: ASYNCHRONOUS
			otherwise SYNCHRONOUS
		endswitch
	function task_period($t in Task) =
		switch $t
			case sense_task: 5
			case control_task: 10
			otherwise undef
		endswitch
	function task_deadline($t in Task) =
		switch $t
			case control_task: 6
			otherwise undef
		endswitch
	function task_timeForElaboration($t in Task) =
		switch $t
			case sense_task: 3
			case control_task: 5
			otherwise undef
		endswitch
	function task_periodStart($t in Task) =
		switch $t
			case sense_task: -5
			case control_task: -10
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
	function sem_users($s in Semaphore) = undef
	function sem_state($s in Semaphore, $t in Task) = READY
	function sem_illegalPost($s in Semaphore) = false
	function semaq($s in Semaphore) = []
	function dimension($b in SwingingBuffer) = undef
	function sem($b in SwingingBuffer) = undef
	function sb_master($b in SwingingBuffer) = undef
	function indexWrite($b in SwingingBuffer) = 0
	function indexRead($b in SwingingBuffer) = undef
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
	function sv_sequence($v in SharedValue) = 0
	function sv_overwritten($v in SharedValue) = 0
	function sv_receivedSequence($v in SharedValue) = 0
	function sv_fresh($v in SharedValue) = false
	function scheduler_mainThread($c in Scheduler) =
		switch $c
			case sense: sense_task
			case control: control_task
			otherwise watch_task
		endswitch
	function scheduler_currentPhase($c in Scheduler) =
		switch $c
			case sense: sense_wait
			case control: control_wait
			otherwise watch_wait
		endswitch
	function scheduler_actionStart($c in Scheduler) = 0
	function action($p in SchedulePhase) =
		switch $p
			case sense_acquire: ELABORATING
			case sense_write_level: STORING
			case control_read_level: LOADING
			case control_law: ELABORATING
			case control_write_state: STORING
			case watch_read_state: LOADING
			otherwise WAITING_TRIGGER
		endswitch
	function time($p in SchedulePhase) =
		switch $p
			case sense_acquire: 2
			case control_law: 3
			otherwise 1
		endswitch
	function nextPhase($p in SchedulePhase) =
		switch $p
			case sense_acquire: sense_write_level
			case sense_write_level: sense_wait
			case sense_wait: sense_acquire
			case control_read_level: control_law
			case control_law: control_write_state
			case control_write_state: control_wait
			case control_wait: control_read_level
			case watch_read_state: watch_wait
			otherwise watch_read_state
		endswitch
	function sharedMemory($p in SchedulePhase) = undef
	function sharedValue($p in SchedulePhase) =
		switch $p
			case sense_write_level: level
			case control_read_level: level
			case control_write_state: state
			case watch_read_state: state
			case watch_wait: state
			otherwise undef
		endswitch
	function elaborationRule($p in SchedulePhase) =
		switch $p
			case sense_acquire: <<r_acquire(Scheduler)>>
			case control_law: <<r_law(Scheduler)>>
			otherwise undef
		endswitch
	agent Scheduler: r_controlTask[]
