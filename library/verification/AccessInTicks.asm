/* One task's access to a swinging buffer, to the tick, whatever the other user of the buffer does: both kinds of task, both roles and both
   directions, with every patience from none to two ticks, and a deadline at the end of the period or a tick before it. The machine is
   entered by the phase before, or by its own arrow. */
asm AccessInTicks

import ../std/StandardLibrary
import ../std/CTLLibrary
import ../patterns/ControlTask
import BufferFaults
import Quotient
import AccessParties
import AccessTimeline
import AccessProperties

signature:

definitions:
	main rule r_Main =
		let ($written = sb_written(buffer),
			$delivered = sb_delivered(buffer),
			$wereUpdated = indexUpdated(buffer),
			$granted = sem_granted(lock, actor_task)) in
			seq
				r_note[]
				r_expectNothing[]
				r_expect[$granted]
				par
					r_faulty[actor]
					r_other[]
					r_sem_arbitrate[lock]
					clock := clock + 1
				endpar
				r_observe[$written, $delivered, $wereUpdated]
				r_forget[]
				r_passTime[]
			endseq
		endlet

default init s0:
	function clock = 0
	function task_kind($t in Task) = if $t = actor_task then kind else ASYNCHRONOUS endif
	function patience = if kind = SYNCHRONOUS then ticksToWait else 0 endif
	function awaitsData = if kind = ASYNCHRONOUS and isReader then willAwait else false endif
	function task_deadline($t in Task) =
		if $t = actor_task and kind = SYNCHRONOUS then
			if deadlineIsEarly then 5 + ticksToWait else undef endif
		else
			undef
		endif
	function task_period($t in Task) =
		if $t = actor_task and kind = SYNCHRONOUS then
			if deadlineIsEarly then 6 + ticksToWait else 5 + ticksToWait endif
		else
			undef
		endif
	function task_timeForElaboration($t in Task) = 5
	function task_periodStart($t in Task) =
		if $t = actor_task and kind = SYNCHRONOUS and not ownArrow then
			if deadlineIsEarly then -(6 + ticksToWait) else -(5 + ticksToWait) endif
		else
			0
		endif
	function task_timeInWait($t in Task) = 0
	function task_cycles($t in Task) = 0
	function task_deadlinesMet($t in Task) = 0
	function task_deadlinesMissed($t in Task) = 0
	function task_totalWait($t in Task) = 0
	function task_longestWait($t in Task) = 0
	function task_skipped($t in Task) = 0

	function sem_permits($s in Semaphore) = 1
	function sem_users($s in Semaphore) = [actor_task, other_task]
	function sem_state($s in Semaphore, $t in Task) = READY
	function sem_illegalPost($s in Semaphore) = false
	function semaq($s in Semaphore) = []

	function dimension($b in SwingingBuffer) = 2
	function sem($b in SwingingBuffer) = lock
	function sb_master($b in SwingingBuffer) = if isMaster then access else theirs endif
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
	function handedOver($b in SwingingBuffer) = 0

	function scheduler_mainThread($c in Scheduler) = actor_task
	function scheduler_currentPhase($c in Scheduler) = if ownArrow then access else rest endif
	function scheduler_actionStart($c in Scheduler) = -9
	function action($p in SchedulePhase) =
		switch $p
			case work: ELABORATING
			case access: if isReader then READING_FROM_SB else WRITING_ON_SB endif
			case theirs: if isReader then WRITING_ON_SB else READING_FROM_SB endif
			otherwise WAITING_TRIGGER
		endswitch
	function time($p in SchedulePhase) = if $p = access then 2 else 1 endif
	function nextPhase($p in SchedulePhase) =
		switch $p
			case work: access
			case access: rest
			otherwise work
		endswitch
	function sharedMemory($p in SchedulePhase) =
		switch $p
			case access: buffer
			case rest:
				if kind = ASYNCHRONOUS and isReader then (if willAwait then buffer else undef endif) else undef endif
			otherwise undef
		endswitch
	function elaborationRule($p in SchedulePhase) =
		if $p = work then <<r_elaborateOnce(Scheduler)>> else undef endif
	function fault = seeded

	function stage = if ownArrow then COMES else RESTS endif
	function left = 0
	function age =
		if kind = SYNCHRONOUS and not ownArrow then
			if deadlineIsEarly then 6 + ticksToWait else 5 + ticksToWait endif
		else
			0
		endif
	function waited = 0
	function begins = false
	function acts = false
	function swaps = false
	function waits = false
	function skips = false
	function ends = false
	function isLate = false
	function isPending = false
	function isUnread = false
	function mustBeFresh = false
	function isAccessRight = true
	function isCountRight = true
	function elaborated = 0
