/* The visual servoing application to the tick, as ../verification/VisualServoingInTicks has it, without faults: visual servoing elaborates
   for as long as it likes, up to the 12 ms that it has in the paper; camera and robot controller take the times that they take.

   It refines ServoingUntimed, in which any task moves at any time. */
asm ServoingInTicks

import ../../../library/std/StandardLibrary
import ../../../library/std/CTLLibrary
import ../../../library/patterns/ControlTask
import ../../../library/verification/Quotient
import ../../../library/verification/SystemProperties
import ../../../library/verification/SystemInTicks
import ../VisionTasks
import ../VisualServoing

signature:

definitions:
	main rule r_Refined = r_tick[<<r_Main>>]

default init s0:
	function clock = 0

	function task_kind($t in Task) = if $t = visual_servoing_task then ASYNCHRONOUS else SYNCHRONOUS endif
	function task_period($t in Task) = vision_period($t)
	// camera: 60 + lock and write; robot: lock and read + 20
	function task_timeForElaboration($t in Task) =
		switch $t
			case camera_task: 62
			case robot_task: 22
			otherwise undef
		endswitch
	function task_periodStart($t in Task) = if isDef(vision_period($t)) then -vision_period($t) else 0 endif
	function task_timeInWait($t in Task) = 0
	function task_cycles($t in Task) = 0
	function task_deadlinesMet($t in Task) = 0
	function task_deadlinesMissed($t in Task) = 0
	function task_totalWait($t in Task) = 0
	function task_longestWait($t in Task) = 0
	function task_skipped($t in Task) = 0

	function sem_permits($s in Semaphore) = 1
	function sem_users($s in Semaphore) =
		if $s = camera_to_vs_lock then
			[camera_task, visual_servoing_task]
		else
			[robot_task, visual_servoing_task]
		endif
	function sem_state($s in Semaphore, $t in Task) = READY
	function sem_illegalPost($s in Semaphore) = false
	function semaq($s in Semaphore) = []

	function dimension($b in SwingingBuffer) = 2
	function sem($b in SwingingBuffer) = if $b = camera_to_vs then camera_to_vs_lock else vs_to_robot_lock endif
	// the asynchronous party is the master of both channels
	function sb_master($b in SwingingBuffer) = if $b = camera_to_vs then vs_read_image else vs_write endif
	function indexWrite($b in SwingingBuffer) = 0
	function indexRead($b in SwingingBuffer) = 1
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

	function scheduler_mainThread($c in Scheduler) =
		switch $c
			case camera: camera_task
			case visual_servoing: visual_servoing_task
			otherwise robot_task
		endswitch
	function scheduler_currentPhase($c in Scheduler) =
		switch $c
			case camera: camera_wait
			case visual_servoing: vs_wait
			otherwise robot_wait
		endswitch
	function scheduler_actionStart($c in Scheduler) = 0
	function action($p in SchedulePhase) = vision_action($p)
	function time($p in SchedulePhase) = vision_time($p)
	function nextPhase($p in SchedulePhase) = vision_nextPhase($p)
	function sharedMemory($p in SchedulePhase) = vision_buffer($p)
	function elaborationRule($p in SchedulePhase) =
		switch $p
			case camera_grab: <<r_captureImage(Scheduler)>>
			case vs_elaborate: <<r_computeSetPoint(Scheduler)>>
			otherwise undef
		endswitch

	// what varies, what is observed
	function timeAtLeast($p in SchedulePhase) =
		if $p = vs_elaborate then 0 else undef endif
	function handedOver($b in SwingingBuffer) = 0
	function unaccounted($b in SwingingBuffer) = 0
	function before_read($b in SwingingBuffer) = indexRead($b)
	function before_written($b in SwingingBuffer) = 0
	function before_phase($c in Scheduler) = scheduler_currentPhase($c)
	function lostSilently($v in SharedValue) = false

	agent Scheduler: r_controlTask[]
