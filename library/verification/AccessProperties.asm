/* What is held to AccessTimeline after each tick: phase, machine, lock, array and indexes of the task, what it did to its buffer, and what
   was counted. An elaboration's rule, too, is held to what it has to find: nothing of the step is done yet. */
module AccessProperties

import ../std/StandardLibrary
import ../std/CTLLibrary
import ../patterns/ControlTask
import AccessParties
import AccessTimeline

export *

signature:
	// what came of the tick is what had to come
	controlled isAccessRight: Boolean
	controlled isCountRight: Boolean

	// how often the elaboration's rule was run in this tick, and has found what was there before it
	controlled elaborated: Integer
	controlled wasAt: SchedulePhase
	controlled wasIn: PatternState
	controlled wasStarted: Integer
	controlled wasBegun: Integer
	controlled wasInside: TaskCSState
	controlled wasReading: ArrayIndex
	controlled wasWriting: ArrayIndex
	controlled wasUpdated: Boolean

	derived isAsBefore: Boolean

definitions:
	// Nothing of the step is done yet for an elaboration that begins in it.
	function isAsBefore =
		scheduler_currentPhase(actor) = wasAt
		and sb_ctrlState(access) = wasIn
		and scheduler_actionStart(actor) = wasStarted
		and task_periodStart(actor_task) = wasBegun
		and task_cycles(actor_task) + task_skipped(actor_task) = 0
		and sem_state(lock, actor_task) = wasInside
		and sb_readingArray(buffer) = wasReading
		and sb_writingArray(buffer) = wasWriting
		and indexUpdated(buffer) = wasUpdated

	rule r_elaborateOnce($c in Scheduler) =
		elaborated := elaborated + (if isAsBefore then 1 else 10 endif)

	rule r_note =
		par
			wasAt := scheduler_currentPhase(actor)
			wasIn := sb_ctrlState(access)
			wasStarted := scheduler_actionStart(actor)
			wasBegun := task_periodStart(actor_task)
			wasInside := sem_state(lock, actor_task)
			wasReading := sb_readingArray(buffer)
			wasWriting := sb_writingArray(buffer)
			wasUpdated := indexUpdated(buffer)
		endpar

	rule r_unnote =
		par
			wasAt := undef
			wasIn := undef
			wasStarted := undef
			wasBegun := undef
			wasInside := undef
			wasReading := undef
			wasWriting := undef
			wasUpdated := undef
		endpar

	// What came of the tick, told by what was written before it and by whether the indexes were updated.
	rule r_observe($written in Integer, $delivered in Integer, $wereUpdated in Boolean) =
		let ($wrote = if reads then sb_written(buffer) != $written else acts endif,
			$swapped = if asMaster then swaps else indexUpdated(buffer) and not $wereUpdated endif) in
			par
				isPending := if $wrote then true else if $swapped then false else isPending endif endif
				isUnread :=
					if $swapped and isPending then
						true
					else
						if (if reads then acts else sb_delivered(buffer) != $delivered endif) then
							false
						else
							isUnread
						endif
					endif
				mustBeFresh :=
					if acts then isUnread else if skips and not asMaster then false else mustBeFresh endif endif
				isAccessRight :=
					if reads then
						sb_delivered(buffer) - $delivered = (if acts and isUnread then 1 else 0 endif)
					else
						sb_written(buffer) - $written = (if acts then 1 else 0 endif)
					endif
				isCountRight :=
					task_totalWait(actor_task) = (if waits then 1 else 0 endif)
					and task_skipped(actor_task) = (if skips then 1 else 0 endif)
					and sb_dropped(buffer) = (if skips and not asMaster and not reads then 1 else 0 endif)
					and task_cycles(actor_task) = (if ends then 1 else 0 endif)
					and task_deadlinesMissed(actor_task) = (if isLate then 1 else 0 endif)
					and task_deadlinesMet(actor_task) = (if ends and isSynchronous and not isLate then 1 else 0 endif)
					and elaborated = (if begins then 1 else 0 endif)
			endpar
		endlet

	// Where no timer is looked at, it shows a time long ago, as one does that nobody has started.
	rule r_passTime =
		par
			r_unnote[]
			elaborated := 0
			if isSynchronous then
				age := age + 1
			endif
			task_deadlinesMissed(actor_task) := 0
			if not contains({WORKS, ACTS}, stage) then
				par
					left := 0
					scheduler_actionStart(actor) := -9
				endpar
			endif
		endpar

	invariant inv_phase over scheduler_currentPhase:
		scheduler_currentPhase(actor)
		= (
			switch stage
				case RESTS: rest
				case WORKS: work
				otherwise access
			endswitch)
	invariant inv_machine over sb_ctrlState:
		sb_ctrlState(access)
		= (
			switch stage
				case ACTS: if reads then READING else WRITING endif
				case ASKS: MANAGING_SB
				case HAS: MANAGING_SB
				otherwise undef
			endswitch)
	invariant inv_lock over sem_state:
		sem_state(lock, actor_task)
		= (
			switch stage
				case ASKS: WAITING
				case HAS: EXECUTION
				case ACTS: if asMaster then READY else EXECUTION endif
				otherwise READY
			endswitch)
	invariant inv_array over sb_writingArray, sb_readingArray:
		isDef(if reads then sb_readingArray(buffer) else sb_writingArray(buffer) endif) = (stage = ACTS)
	invariant inv_indexes over indexUpdated: asMaster implies indexUpdated(buffer) = (stage = HAS)
	// a datum is written, or a new one delivered, when the action begins, and only then
	invariant inv_access over sb_written, sb_delivered: isAccessRight
	invariant inv_pending over sb_pending: sb_pending(buffer) = isPending
	invariant inv_fresh over sb_fresh: reads implies sb_fresh(buffer) = mustBeFresh
	invariant inv_counted over task_totalWait, task_skipped, task_cycles, task_deadlinesMissed: isCountRight
	invariant inv_waited over task_timeInWait: task_timeInWait(actor_task) = waited
	invariant inv_period over task_periodStart: task_elapsedTimeOfPeriod(actor_task) = age
	invariant inv_sound over sem_state, indexRead: patternsSound

	// what is to be noticed comes: a skip, whatever the patience; a wait to the last tick, and then the lock; a late cycle
	CTLSPEC ctlSpec_skips: isSynchronous implies ef(skips)
	CTLSPEC ctlSpec_lastTick: ef(waited = patience and (if asMaster then stage = HAS else stage = ACTS endif))
	CTLSPEC ctlSpec_late: isSynchronous implies ef(isLate)
	// a synchronous task goes on even if the other one ends inside the lock, an asynchronous one while it gets lock and data at last
	CTLSPEC ctlSpec_alone:
		ag(
			af(
				scheduler_currentPhase(actor) = work
				or (
					not isSynchronous
					and (
						sem_state(lock, actor_task) = WAITING
						or (awaitsData and scheduler_currentPhase(actor) = rest)))))
	CTLSPEC ctlSpec_goesOn: ag(ef(scheduler_currentPhase(actor) = work))
	CTLSPEC ctlSpec_news: reads implies ag(ef(sb_fresh(buffer)))
