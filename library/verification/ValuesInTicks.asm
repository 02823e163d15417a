/* Three tasks on two shared values, to the tick: the elaborations of both writers end at any tick up to their longest. */
asm ValuesInTicks

import ../std/StandardLibrary
import ../std/CTLLibrary
import ../patterns/ControlTask
import ValueFaults
import Quotient
import SystemProperties
import SystemInTicks
import Progress
import ../patterns/tests/ValuePair

signature:

definitions:
	// the task's own rule, with the fault that is seeded, if any
	rule r_faultyTask = r_faulty[self]

	main rule r_Verified = r_tick[<<r_Main>>]

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
	// what varies, what is observed, what is seeded
	function timeAtLeast($p in SchedulePhase) = if action($p) = ELABORATING then 0 else undef endif
	function handedOver($b in SwingingBuffer) = 0
	function unaccounted($b in SwingingBuffer) = 0
	function before_read($b in SwingingBuffer) = indexRead($b)
	function before_written($b in SwingingBuffer) = 0
	function before_phase($c in Scheduler) = scheduler_currentPhase($c)
	function lostSilently($v in SharedValue) = false
	function fault = seeded

	agent Scheduler: r_faultyTask[]
