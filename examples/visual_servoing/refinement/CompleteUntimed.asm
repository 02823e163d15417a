/* The complete controller without time, of which the camera, visual servoing and the robot controller move, one or several at once. The
   encoders, the motors and the operator rest outside of all locks. To the three they show in nothing but in when these move: an access that is
   left out shows as one that is made, and a target that is not there as one that is (library/verification/README.md has the argument).

   It refines FeedbackUntimed, the application with feedback. */
asm CompleteUntimed

import ../../../library/std/StandardLibrary
import ../../../library/std/CTLLibrary
import ../../../library/std/LTLLibrary
import ../../../library/patterns/ControlTask
import ../../../library/verification/Quotient
import ../../../library/verification/SystemProperties
import ../../../library/verification/SystemInterleaved
import ../VisionTasks
import ../MotionTasks
import ../CompleteController

signature:

definitions:
	// Who moved last is nobody's concern: no fairness is assumed.
	main rule r_Refined =
		seq
			r_move[]
			forall $t in Task with true do moved($t) := false
		endseq

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
	function sharedMemory($p in SchedulePhase) = complete_buffer($p)
	function messageQueue($p in SchedulePhase) = complete_queue($p)
	function elaborationRule($p in SchedulePhase) = complete_elaboration($p)

	// no time
	function task_period($t in Task) = 1
	function task_deadline($t in Task) = 1
	function task_timeForElaboration($t in Task) = 0
	function task_periodStart($t in Task) = 0
	function time($p in SchedulePhase) = 0
	// who moves, what is observed
	function takesPart($t in Task) = $t = camera_task or $t = visual_servoing_task or $t = robot_task
	function moved($t in Task) = false
	function handedOver($b in SwingingBuffer) = 0
	function unaccounted($b in SwingingBuffer) = 0
	function before_read($b in SwingingBuffer) = indexRead($b)
	function before_written($b in SwingingBuffer) = 0
	function before_phase($c in Scheduler) = scheduler_currentPhase($c)
	function lostSilently($v in SharedValue) = false

	agent Scheduler: r_controlTask[]
