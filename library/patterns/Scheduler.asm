/* The periodic scheduler: takes one task through the cycle of its phases.

   A phase elaborates, writes to or reads from a swinging buffer, sends or receives a message, stores or
   loads a shared value, or waits for the trigger of the next cycle. Phases follow each other without a gap: the step that leaves a
   phase also takes the first action of the next one, so a phase of time T takes T ticks, not T + 1.
   A synchronous task whose work fills its whole period thus keeps the period.

   Buffer phases are pattern machines with a control state of their own, `sb_ctrlState`. It is undef
   exactly while the machine has not been entered; leaving it sets undef and moves on to the next
   phase in one step, so "not yet entered" and "just left" cannot be mistaken for each other. */
module Scheduler

import ../std/StandardLibrary
import Task
import Semaphore
import SwingingBuffer
import MessageQueue
import SharedValue

export *

signature:
	domain Scheduler subsetof Agent
	abstract domain SchedulePhase

	enum domain PhaseAction = {
		WAITING_TRIGGER | ELABORATING | WRITING_ON_SB | READING_FROM_SB | SENDING | RECEIVING | STORING | LOADING}
	enum domain PatternState = {WRITING | READING | MANAGING_SB}
	enum domain SyncPriority = {MASTER | SLAVE}

	// What a task is seen to do: an observation, not a control state
	enum domain Activity = {
		IDLE | ELABORATION | READ_ACCESS | WRITE_ACCESS | LOCK_WAIT | LOCK_HELD | ROOM_WAIT | MESSAGE_ACCESS}

	// Configuration of a scheduler and its phases
	controlled scheduler_mainThread: Scheduler -> Task
	controlled action: SchedulePhase -> PhaseAction
	// ticks the action takes, without the waiting for a lock
	controlled time: SchedulePhase -> Integer
	controlled nextPhase: SchedulePhase -> SchedulePhase
	// buffer, queue or value worked on; for a waiting phase of an asynchronous task: the one whose data it awaits, if it is one
	controlled sharedMemory: SchedulePhase -> SwingingBuffer
	controlled messageQueue: SchedulePhase -> MessageQueue
	controlled sharedValue: SchedulePhase -> SharedValue
	// of a waiting phase that awaits several channels: the phases that read them, and whether all of these need something new, or one
	controlled awaited: SchedulePhase -> Powerset(SchedulePhase)
	controlled awaitsAll: SchedulePhase -> Boolean
	// the dashed action block of the diagrams, refined by the application
	controlled elaborationRule: SchedulePhase -> Rule(Scheduler)
	// The phase that manages the indexes of a buffer. A function: no buffer can have two masters.
	controlled sb_master: SwingingBuffer -> SchedulePhase

	// Present state
	controlled scheduler_currentPhase: Scheduler -> SchedulePhase
	controlled scheduler_actionStart: Scheduler -> Integer
	controlled sb_ctrlState: SchedulePhase -> PatternState

	derived syncPriority: SchedulePhase -> SyncPriority
	derived scheduler_currentScheduleTime: Scheduler -> Integer
	derived channelHasNew: SchedulePhase -> Boolean
	derived dataAvailable: SchedulePhase -> Boolean
	derived trigger: Scheduler -> Boolean
	derived tElapsed: Scheduler -> Boolean
	derived outsidePatternMachine: Scheduler -> Boolean
	derived lockGranted: Scheduler -> Boolean
	derived swingingBufferManaged: Scheduler -> Boolean
	derived watchdog: Scheduler -> Boolean
	derived activity: Scheduler -> Activity

definitions:
	function syncPriority($p in SchedulePhase) =
		if sb_master(sharedMemory($p)) = $p then MASTER else SLAVE endif

	function scheduler_currentScheduleTime($c in Scheduler) =
		clock - scheduler_actionStart($c)

	// An asynchronous task that awaits nothing is always ready to start. A datum not handed over yet
	// counts for a reader that is the master, as it can swap.
	function channelHasNew($p in SchedulePhase) =
		if isDef(sharedMemory($p)) then
			sb_newestSequence(sharedMemory($p)) != sb_receivedSequence(sharedMemory($p))
			or (sb_pending(sharedMemory($p)) and action(sb_master(sharedMemory($p))) = READING_FROM_SB)
		else
			if isDef(messageQueue($p)) then
				not mq_isEmpty(messageQueue($p))
			else
				if isDef(sharedValue($p)) then sv_isNew(sharedValue($p)) else true endif
			endif
		endif

	// What a waiting phase awaits is there; of another phase: its channel has something new.
	function dataAvailable($p in SchedulePhase) =
		if isUndef(awaited($p)) then
			channelHasNew($p)
		else
			if awaitsAll($p) then
				(forall $q in awaited($p) with channelHasNew($q))
			else
				(exist $q in awaited($p) with channelHasNew($q))
			endif
		endif

	function trigger($c in Scheduler) =
		if task_kind(scheduler_mainThread($c)) = SYNCHRONOUS then
			task_elapsedTimeOfPeriod(scheduler_mainThread($c)) >= task_period(scheduler_mainThread($c))
			and task_isHeld(scheduler_mainThread($c)) != true
		else
			dataAvailable(scheduler_currentPhase($c))
		endif

	function tElapsed($c in Scheduler) =
		scheduler_currentScheduleTime($c) >= time(scheduler_currentPhase($c))

	function outsidePatternMachine($c in Scheduler) =
		isUndef(sb_ctrlState(scheduler_currentPhase($c)))

	function lockGranted($c in Scheduler) =
		sem_granted(sem(sharedMemory(scheduler_currentPhase($c))), scheduler_mainThread($c))

	// Master: the index section is done. Slave: it may take the lock in this very step.
	function swingingBufferManaged($c in Scheduler) =
		if syncPriority(scheduler_currentPhase($c)) = MASTER then
			indexUpdated(sharedMemory(scheduler_currentPhase($c)))
		else
			lockGranted($c)
		endif

	// Waiting for the lock any longer would cost the deadline.
	function watchdog($c in Scheduler) =
		if thereIsTime(scheduler_mainThread($c)) then false else not lockGranted($c) endif

	function activity($c in Scheduler) =
		switch action(scheduler_currentPhase($c))
			case WAITING_TRIGGER: IDLE
			case ELABORATING: ELABORATION
			// As long as the queue is full it waits, if there is time.
			case SENDING:
				if mq_isFull(messageQueue(scheduler_currentPhase($c))) and thereIsTime(scheduler_mainThread($c)) then
					ROOM_WAIT
				else
					MESSAGE_ACCESS
				endif
			case RECEIVING: MESSAGE_ACCESS
			case STORING: WRITE_ACCESS
			case LOADING: READ_ACCESS
			otherwise
				switch sb_ctrlState(scheduler_currentPhase($c))
					case WRITING: WRITE_ACCESS
					case READING: READ_ACCESS
					case MANAGING_SB:
						if swingingBufferManaged($c) or lockGranted($c) then LOCK_HELD else LOCK_WAIT endif
					otherwise IDLE
				endswitch
		endswitch

	rule r_startTimer($c in Scheduler) =
		scheduler_actionStart($c) := clock

	rule r_elaborate($c in Scheduler, $phase in SchedulePhase) =
		par
			r_startTimer[$c]
			if isDef(elaborationRule($phase)) then
				elaborationRule($phase)[$c]
			endif
		endpar

	rule r_write($c in Scheduler, $phase in SchedulePhase) =
		par
			r_startTimer[$c]
			let ($b = sharedMemory($phase)) in
				r_SwingingBuffer_write[$b]
			endlet
		endpar

	rule r_read($c in Scheduler, $phase in SchedulePhase) =
		par
			r_startTimer[$c]
			let ($b = sharedMemory($phase)) in
				r_SwingingBuffer_read[$b]
			endlet
		endpar

	// Ask for the lock, or take it when granted; a master that gets it updates the indexes at once.
	rule r_manageSb($c in Scheduler, $phase in SchedulePhase) =
		let ($b = sharedMemory($phase), $t = scheduler_mainThread($c)) in
			par
				r_SwingingBuffer_getLock[$b, $t]
				if syncPriority($phase) = MASTER then
					if sem_granted(sem($b), $t) then
						r_SwingingBuffer_updateIndexes[$b]
					endif
				endif
			endpar
		endlet

	rule r_releaseSb($c in Scheduler) =
		let ($phase = scheduler_currentPhase($c), $b = sharedMemory($phase), $t = scheduler_mainThread($c)) in
			par
				if syncPriority($phase) = MASTER then
					indexUpdated($b) := false
				endif
				r_SwingingBuffer_releaseLock[$b, $t]
			endpar
		endlet

	rule r_giveUpSb($c in Scheduler) =
		par
			r_task_skip[scheduler_mainThread($c)]
			r_SwingingBuffer_giveUp[sharedMemory(scheduler_currentPhase($c)), scheduler_mainThread($c)]
		endpar

	rule r_startWriting($c in Scheduler, $phase in SchedulePhase) =
		par
			r_write[$c, $phase]
			sb_ctrlState($phase) := WRITING
		endpar

	rule r_startReading($c in Scheduler, $phase in SchedulePhase) =
		par
			r_read[$c, $phase]
			sb_ctrlState($phase) := READING
		endpar

	rule r_startManaging($c in Scheduler, $phase in SchedulePhase) =
		par
			r_manageSb[$c, $phase]
			sb_ctrlState($phase) := MANAGING_SB
		endpar

	// The entering arrow of a pattern machine: a master writes first and needs no lock for it;
	// everybody else begins with the lock.
	rule r_enterPattern($c in Scheduler, $phase in SchedulePhase) =
		if action($phase) = WRITING_ON_SB and syncPriority($phase) = MASTER then
			r_startWriting[$c, $phase]
		else
			r_startManaging[$c, $phase]
		endif

	rule r_enterPhase($c in Scheduler, $phase in SchedulePhase) =
		par
			scheduler_currentPhase($c) := $phase
			switch action($phase)
				case ELABORATING:
					r_elaborate[$c, $phase]
				case WRITING_ON_SB:
					r_enterPattern[$c, $phase]
				case READING_FROM_SB:
					r_enterPattern[$c, $phase]
				case RECEIVING:
					par
						r_startTimer[$c]
						r_mq_receive[messageQueue($phase)]
					endpar
				case STORING:
					r_startTimer[$c]
				case LOADING:
					par
						r_startTimer[$c]
						r_sv_read[sharedValue($phase)]
					endpar
			endswitch
		endpar

	// A new cycle, from the phase after the waiting one.
	rule r_startCycle($c in Scheduler, $waiting in SchedulePhase) =
		let ($t = scheduler_mainThread($c), $first = nextPhase($waiting)) in
			par
				r_task_nextPeriod[$t]
				r_enterPhase[$c, $first]
			endpar
		endlet

	// A synchronous task that is done just when its period ends starts the next cycle at once. An
	// asynchronous task rests for a tick, and so does a task with a single phase besides the waiting,
	// which cannot leave and enter the same pattern machine in one step.
	rule r_leavePhase($c in Scheduler) =
		let ($t = scheduler_mainThread($c), $current = scheduler_currentPhase($c), $next = nextPhase($current)) in
			if action($next) = WAITING_TRIGGER then
				par
					r_task_complete[$t]
					if task_kind($t) = SYNCHRONOUS and trigger($c) and nextPhase($next) != $current then
						r_startCycle[$c, $next]
					else
						scheduler_currentPhase($c) := $next
					endif
				endpar
			else
				r_enterPhase[$c, $next]
			endif
		endlet

	rule r_waitTrigger($c in Scheduler) =
		if trigger($c) then
			r_startCycle[$c, scheduler_currentPhase($c)]
		endif
