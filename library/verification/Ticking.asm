/* Time for PairInTicks and its seeded faults: how long actions last, the shift of all times back to clock 0, and what is
   promised to the tick. */
module Ticking

import ../std/StandardLibrary
import ../std/CTLLibrary
import ../patterns/ControlTask
import BufferPair

export *

signature:
	monitored endsEarly: Scheduler -> Boolean
	// asked for in the initial state: a synchronous slave has no time to wait at all, and so leaves out what it cannot do at once
	monitored isHasty: Boolean

	// within a step: whose action may not end yet, and where he was
	controlled stays: Scheduler -> Boolean
	controlled phaseBefore: Scheduler -> SchedulePhase
	controlled stateBefore: Scheduler -> PatternState
	controlled isCutShort: Boolean
	// ticks that an action has lasted, two at most
	controlled lasted: Scheduler -> Integer

	static longest: SchedulePhase -> Integer
	derived isElaborating: Scheduler -> Boolean
	derived isManagingNow: Scheduler -> Boolean
	// at an action that takes time
	derived isTimed: Scheduler -> Boolean
	derived hasMoved: Scheduler -> Boolean
	// a slave has no time to wait, and may so leave out every access
	derived leavesOut: Boolean

definitions:
	function isElaborating($c in Scheduler) =
		action(scheduler_currentPhase($c)) = ELABORATING

	function isManagingNow($c in Scheduler) =
		sb_ctrlState(scheduler_currentPhase($c)) = MANAGING_SB

	function longest($p in SchedulePhase) =
		if phaseAction($p) = WAITING_TRIGGER then 0 else 2 endif

	function isTimed($c in Scheduler) =
		isElaborating($c) or contains({WRITING, READING}, sb_ctrlState(scheduler_currentPhase($c)))

	function hasMoved($c in Scheduler) =
		scheduler_currentPhase($c) != phaseBefore($c) or sb_ctrlState(scheduler_currentPhase($c)) != stateBefore($c)

	function leavesOut =
		(exists $t in Task with
			$t != owner(master) and task_kind($t) = SYNCHRONOUS and task_timeForElaboration($t) = task_period($t))

	// As long as it lasts, each action may end after its first tick, or after its second.
	rule r_setTimes =
		forall $c in Scheduler with longest(scheduler_currentPhase($c)) > 0 and not isManagingNow($c) do
			time(scheduler_currentPhase($c)) := if endsEarly($c) then 1 else 2 endif

	rule r_noteTimes =
		forall $c in Scheduler with true do
			par
				stays($c) := isTimed($c) and lasted($c) < time(scheduler_currentPhase($c))
				phaseBefore($c) := scheduler_currentPhase($c)
				stateBefore($c) := sb_ctrlState(scheduler_currentPhase($c))
			endpar

	// An action whose time is not over goes on.
	rule r_observeTimes =
		par
			isCutShort := (exists $c in Scheduler with stays($c) and hasMoved($c))
			forall $d in Scheduler with true do
				par
					lasted($d) :=
						if not isTimed($d) then 0 else if hasMoved($d) then 1 else min(lasted($d) + 1, 2) endif endif
					stays($d) := false
					phaseBefore($d) := undef
					stateBefore($d) := undef
				endpar
		endpar

	rule r_shiftTimes =
		par
			r_renumber[]
			r_beginStatistics[]
			clock := 0
			forall $p in SchedulePhase with true do time($p) := 1
			forall $t in Task with true do
				if task_kind($t) = SYNCHRONOUS then
					task_periodStart($t) := task_periodStart($t) - clock
				else
					task_timeInWait($t) := 0
				endif
			// no action lasts longer than two ticks
			forall $c in Scheduler with true do
				scheduler_actionStart($c) := max(scheduler_actionStart($c) - clock, -2)
		endpar

	// no action is shorter than its time
	invariant inv_times over scheduler_currentPhase: not isCutShort
	// a synchronous task never waits past its watchdog
	invariant inv_watchdog over task_timeInWait:
		(forall $t in Task with
			task_kind($t) = SYNCHRONOUS implies task_timeInWait($t) <= task_period($t) - task_timeForElaboration($t))
	invariant inv_deadlines over task_deadlinesMissed: (forall $t in Task with task_deadlinesMissed($t) = 0)
	// it begins each cycle at the tick at which the period before ends
	invariant inv_periods over task_periodStart:
		(forall $t in Task with
			task_kind($t) = SYNCHRONOUS
			implies (task_elapsedTimeOfPeriod($t) >= 0 and task_elapsedTimeOfPeriod($t) <= task_period($t)))

	// without fairness: nobody waits for ever
	CTLSPEC ctlSpec_producerServed: ag(af(not isWaiting(producer)))
	CTLSPEC ctlSpec_consumerServed: ag(af(not isWaiting(consumer)))
	CTLSPEC ctlSpec_producerWorks: ag(af(isElaborating(producer)))
	CTLSPEC ctlSpec_consumerWorks: ag(af(isElaborating(consumer)))
	CTLSPEC ctlSpec_newDataComes: leavesOut or ag(af(sb_fresh(buffer)))
