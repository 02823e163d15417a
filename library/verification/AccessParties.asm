/* A task and the other user of its swinging buffer, for AccessInTicks: how the two are configured, and what the other user does.

   The other user is the environment's. It asks for the lock at any tick, waits for it however long, and keeps it for any number of
   ticks. Meanwhile it does what its role allows: as master it swaps, and works on its array outside the lock; as slave it works on its
   array inside. */
module AccessParties

import ../std/StandardLibrary
import ../patterns/ControlTask

export *

signature:
	domain Patience subsetof Integer

	static actor: Scheduler
	static actor_task: Task
	static other_task: Task
	static buffer: SwingingBuffer
	static lock: Semaphore

	static work: SchedulePhase
	static access: SchedulePhase
	static rest: SchedulePhase
	static theirs: SchedulePhase

	// asked for in the initial state
	monitored kind: TaskKind
	monitored isReader: Boolean
	monitored isMaster: Boolean
	monitored willAwait: Boolean
	monitored ownArrow: Boolean
	monitored ticksToWait: Patience
	monitored deadlineIsEarly: Boolean

	monitored otherActs: Boolean

	// the configuration, as it was asked for
	controlled patience: Patience
	controlled awaitsData: Boolean

	derived isSynchronous: Boolean
	derived reads: Boolean
	derived asMaster: Boolean
	derived otherReads: Boolean
	derived otherIsMaster: Boolean
	derived otherState: TaskCSState

definitions:
	domain Patience = {0 : 2}

	function isSynchronous =
		task_kind(actor_task) = SYNCHRONOUS

	function reads =
		action(access) = READING_FROM_SB

	function asMaster =
		sb_master(buffer) = access

	function otherReads =
		not reads

	function otherIsMaster =
		not asMaster

	function otherState =
		sem_state(lock, other_task)

	rule r_otherAsks =
		par
			r_sem_wait[lock, other_task]
			if otherIsMaster then
				if otherReads then
					r_SwingingBuffer_endRead[buffer]
				else
					r_SwingingBuffer_write[buffer]
				endif
			endif
		endpar

	rule r_otherEnters =
		if otherIsMaster then
			par
				r_SwingingBuffer_updateIndexes[buffer]
				r_SwingingBuffer_endWrite[buffer]
			endpar
		else
			if otherReads then
				r_SwingingBuffer_read[buffer]
			else
				r_SwingingBuffer_write[buffer]
			endif
		endif

	rule r_otherLeaves =
		par
			r_sem_post[lock, other_task]
			if otherIsMaster then
				par
					indexUpdated(buffer) := false
					if otherReads then
						r_SwingingBuffer_read[buffer]
					endif
				endpar
			else
				if otherReads then
					r_SwingingBuffer_endRead[buffer]
				else
					r_SwingingBuffer_endWrite[buffer]
				endif
			endif
		endpar

	rule r_other =
		switch otherState
			case READY:
				if otherActs then
					r_otherAsks[]
				endif
			case WAITING:
				par
					r_sem_wait[lock, other_task]
					if sem_granted(lock, other_task) then
						r_otherEnters[]
					endif
				endpar
			case EXECUTION:
				if otherActs then
					r_otherLeaves[]
				endif
		endswitch
