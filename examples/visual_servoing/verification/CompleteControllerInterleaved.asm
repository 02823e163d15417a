/* The complete controller without time, by parts: in each run the two tasks of one channel go through their whole cycles, moving
   one at a time or both at once, and the others rest outside of all locks. All parts are in one model, which asks for one in
   its initial state.

   A step of a task looks at its own control state and at the buffers of the phases that it leaves and enters; and no task waits
   for a lock while it holds another (inv_oneLock), nor is a buffer used by a third (inv_twoUsers). So whatever a run of all
   tasks does to a buffer, it does in a run of the two alone, in which a task that waits for somebody else does not move. */
asm CompleteControllerInterleaved

import ../../../library/std/StandardLibrary
import ../../../library/std/CTLLibrary
import ../../../library/std/LTLLibrary
import ../../../library/patterns/ControlTask
import ../../../library/verification/BufferFaults
import ../../../library/verification/Quotient
import ../../../library/verification/SystemProperties
import ../../../library/verification/SystemInterleaved
import ../VisionTasks
import ../MotionTasks
import ../CompleteController

signature:
	enum domain Part = {
		CAMERA_SERVOING | SERVOING_ROBOT | ENCODER_ROBOT | ENCODER_MOTOR | ROBOT_MOTOR | OPERATOR_SERVOING}

	monitored chosen: Part
	controlled part: Part

	static isIn: Prod(Part, Task) -> Boolean

definitions:
	// the task's own rule, with the fault that is seeded, if any
	rule r_faultyTask = r_faulty[self]

	function isIn($part in Part, $t in Task) =
		switch $part
			case CAMERA_SERVOING: $t = camera_task or $t = visual_servoing_task
			case SERVOING_ROBOT: $t = visual_servoing_task or $t = robot_task
			case ENCODER_ROBOT: $t = encoder_task or $t = robot_task
			case ENCODER_MOTOR: $t = encoder_task or $t = motor_task
			case ROBOT_MOTOR: $t = robot_task or $t = motor_task
			case OPERATOR_SERVOING: $t = operator_task or $t = visual_servoing_task
		endswitch

	JUSTICE takesPart(camera_task) implies moved(camera_task)
	JUSTICE takesPart(visual_servoing_task) implies moved(visual_servoing_task)
	JUSTICE takesPart(robot_task) implies moved(robot_task)
	JUSTICE takesPart(motor_task) implies moved(motor_task)
	JUSTICE takesPart(encoder_task) implies moved(encoder_task)
	JUSTICE takesPart(operator_task) implies moved(operator_task)

	main rule r_Verified = r_move[]

default init s0:
	function clock = 0

	function task_kind($t in Task) =
		if $t = visual_servoing_task or $t = operator_task then ASYNCHRONOUS else SYNCHRONOUS endif
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
	function nextPhase($p in SchedulePhase) = complete_nextPhase($p)
	// without a camera visual servoing begins whenever it moves
	function sharedMemory($p in SchedulePhase) =
		if $p = vs_wait and not isIn(part, camera_task) then undef else complete_buffer($p) endif
	function messageQueue($p in SchedulePhase) = complete_queue($p)
	function elaborationRule($p in SchedulePhase) = complete_elaboration($p)

	// no time
	function task_period($t in Task) = 1
	function task_deadline($t in Task) = 1
	function task_timeForElaboration($t in Task) = 0
	function task_periodStart($t in Task) = 0
	function time($p in SchedulePhase) = 0
	// who moves, what is observed, what is seeded
	function takesPart($t in Task) = isIn(part, $t)
	function part = chosen
	function moved($t in Task) = false
	function handedOver($b in SwingingBuffer) = 0
	function unaccounted($b in SwingingBuffer) = 0
	function before_read($b in SwingingBuffer) = indexRead($b)
	function before_written($b in SwingingBuffer) = 0
	function before_phase($c in Scheduler) = scheduler_currentPhase($c)
	function lostSilently($v in SharedValue) = false
	function fault = seeded

	agent Scheduler: r_faultyTask[]
