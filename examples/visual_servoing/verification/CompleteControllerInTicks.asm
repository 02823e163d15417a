/* The complete controller, to the tick: in every state, however long visual servoing elaborates, up to the 12 ms that it has in
   the paper, and however long the operator plans. */
asm CompleteControllerInTicks

import ../../../library/std/StandardLibrary
import ../../../library/std/CTLLibrary
import ../../../library/patterns/ControlTask
import ../../../library/verification/BufferFaults
import ../../../library/verification/Quotient
import ../../../library/verification/SystemProperties
import ../../../library/verification/SystemInTicks
import ../../../library/verification/Progress
import ../VisionTasks
import ../MotionTasks
import ../CompleteController

signature:
	// ticks
	static ageBound: SwingingBuffer -> Integer

definitions:
	// the task's own rule, with the fault that is seeded, if any
	rule r_faultyTask = r_faulty[self]

	// From the capture of the image behind a datum, or from its measurement, for as long as its reader works with it. The
	// report draws the bound of 500 ticks for `ageAtMotor`, which is that of `robot_to_motor`.
	function ageBound($b in SwingingBuffer) =
		switch $b
			case camera_to_vs: 292
			case vs_to_robot: 452
			case robot_to_motor: 484
			case robot_to_vs: 211
			case encoder_to_robot: 55
			case encoder_to_motor: 17
		endswitch

	invariant inv_ages over sb_received: (forall $b in SwingingBuffer with isWithin($b, ageBound($b)))

	main rule r_Verified = r_tick[<<r_Main>>]

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

	// what varies, what is observed, what is seeded
	function timeAtLeast($p in SchedulePhase) = if $p = vs_elaborate or $p = operator_plan then 0 else undef endif
	function endless($p in SchedulePhase) = $p = operator_plan
	function handedOver($b in SwingingBuffer) = 0
	function unaccounted($b in SwingingBuffer) = 0
	function before_read($b in SwingingBuffer) = indexRead($b)
	function before_written($b in SwingingBuffer) = 0
	function before_phase($c in Scheduler) = scheduler_currentPhase($c)
	function lostSilently($v in SharedValue) = false
	function fault = seeded

	agent Scheduler: r_faultyTask[]
