/* What is held to PhaseTimeline after each tick: the phase of the task, what it did to its channels, and what was counted. An
   elaboration's rule, too, is held to what it has to find: nothing of the step is done yet. */
module PhaseProperties

import ../std/StandardLibrary
import ../std/CTLLibrary
import ../patterns/ControlTask
import PhaseTimeline

export *

signature:
	// what came of the tick is what had to come
	controlled isRight: Boolean
	// how often the elaboration's rule was run in this tick, and has found what was there before it
	controlled elaborated: Integer
	controlled wasAt: SchedulePhase
	controlled wasStarted: Integer
	controlled wasBegun: Integer
	controlled wasSent: Integer
	controlled wasStored: Integer

	derived isAsBefore: Boolean
	static increment: Boolean -> Integer

definitions:
	function increment($is in Boolean) =
		if $is then 1 else 0 endif

	// Nothing of the step is done yet for an elaboration that begins in it.
	function isAsBefore =
		scheduler_currentPhase(actor) = wasAt
		and scheduler_actionStart(actor) = wasStarted
		and task_periodStart(task) = wasBegun
		and task_cycles(task) = 0
		and mq_sent(outbox) = wasSent
		and sv_sequence(state) = wasStored

	rule r_elaborateOnce($c in Scheduler) =
		elaborated := elaborated + (if isAsBefore then 1 else 10 endif)

	rule r_note =
		par
			wasAt := scheduler_currentPhase(actor)
			wasStarted := scheduler_actionStart(actor)
			wasBegun := task_periodStart(task)
			wasSent := mq_sent(outbox)
			wasStored := sv_sequence(state)
		endpar

	rule r_observe($sent in Integer, $taken in Integer, $stored in Integer) =
		par
			isRight :=
				mq_sent(outbox) - $sent = increment(sends)
				and mq_refused(outbox) = increment(refuses)
				and mq_taken(inbox) - $taken = increment(takes)
				and sv_sequence(state) - $stored = increment(stores)
				and elaborated = increment(elaborates)
				and task_totalWait(task) = increment(waits)
				and task_cycles(task) = increment(ends)
				and task_deadlinesMet(task) = increment(ends and isSynchronous)
			// a value that comes in the tick in which the one before is loaded, is new
			if action(one) = LOADING or awaitsLevel then
				if levelComes then
					levelIsNew := true
				endif
			endif
		endpar

	// Where no timer is looked at, it shows a time long ago, as one does that nobody has started.
	rule r_passTime =
		par
			elaborated := 0
			wasAt := undef
			wasStarted := undef
			wasBegun := undef
			wasSent := undef
			wasStored := undef
			if isSynchronous then
				age := age + 1
			endif
			if present != one then
				time(one) := 2
			endif
			if present = rest or action(present) = SENDING then
				par
					left := 0
					scheduler_actionStart(actor) := -9
				endpar
			endif
		endpar

	invariant inv_phase over scheduler_currentPhase: scheduler_currentPhase(actor) = present
	// each channel is used in the right tick, and only then; the elaboration is run once; all is counted
	invariant inv_effects over mq_sent, mq_taken, sv_sequence, task_cycles: isRight
	invariant inv_fresh over sv_fresh: sv_fresh(level) = mustBeFresh
	invariant inv_waited over task_timeInWait: task_timeInWait(task) = waited
	invariant inv_period over task_periodStart: task_elapsedTimeOfPeriod(task) = age
	invariant inv_deadlines over task_deadlinesMissed: task_deadlinesMissed(task) = 0
	invariant inv_sound over mq_sent: patternsSound

	// what is to be noticed comes: a sender loses a message, and waits; a task with a single phase
	// rests for a tick although its period is over; a task goes on; something new is loaded
	CTLSPEC ctlSpec_loses: action(one) = SENDING and isSynchronous implies ef(refuses)
	CTLSPEC ctlSpec_waits: action(one) = SENDING and (not isSynchronous or mayWait > 0) implies ef(waits)
	CTLSPEC ctlSpec_rests:
		isSynchronous and nextPhase(one) = rest and action(one) != SENDING implies ef(present = rest and isOverdue)
	CTLSPEC ctlSpec_goesOn: ag(ef(present = one))
	CTLSPEC ctlSpec_news: action(one) = LOADING implies ef(mustBeFresh)
