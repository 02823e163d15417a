/* A system of tasks, to the tick: all of them step at once and the clock goes on, as the system's own main rule says.

   An action whose length varies may end at any tick between the least and the most that it takes, or never, where it is
   endless. All else, and so every bound, is as the system has it. */
module SystemInTicks

import ../std/StandardLibrary
import ../std/CTLLibrary
import ../patterns/ControlTask
import ../patterns/VaryingTimes
import Quotient
import SystemProperties

export *

signature:
	// The action may last for ever; it varies from no ticks on.
	controlled endless: SchedulePhase -> Boolean
	// the time of a phase that ends in this tick; undef between two ticks
	controlled fullTime: SchedulePhase -> Integer

	// the datum that the consumer works with is at most so many ticks old
	derived isWithin: Prod(SwingingBuffer, Integer) -> Boolean
	derived isEndless: Scheduler -> Boolean
	// in the first phase of its cycle
	derived isBeginning: Task -> Boolean
	// at an elaboration that may last for ever
	derived isFree: Task -> Boolean

definitions:
	function isWithin($b in SwingingBuffer, $ticks in Integer) =
		if isDef(sb_received($b)) then clock - sb_received($b) <= $ticks else true endif

	function isEndless($c in Scheduler) =
		endless(scheduler_currentPhase($c)) = true

	function isBeginning($t in Task) =
		(exists $c in Scheduler, $p in SchedulePhase with
			scheduler_mainThread($c) = $t
			and action($p) = WAITING_TRIGGER
			and nextPhase($p) = scheduler_currentPhase($c))

	function isFree($t in Task) =
		(exists $c in Scheduler with scheduler_mainThread($c) = $t and isEndless($c))

	// Whatever rules a system has, an action whose time is over ends.
	rule r_setTimes =
		forall $c in Scheduler with mayEnd($c) do
			if endsNow($c) then
				par
					fullTime(scheduler_currentPhase($c)) := time(scheduler_currentPhase($c))
					time(scheduler_currentPhase($c)) := 0
				endpar
			endif

	rule r_resetTimes =
		forall $c in Scheduler with isDef(fullTime(before_phase($c))) do
			par
				time(before_phase($c)) := fullTime(before_phase($c))
				fullTime(before_phase($c)) := undef
			endpar

	// How long it has lasted does not matter.
	rule r_stopEndless =
		forall $c in Scheduler with isEndless($c) do
			scheduler_actionStart($c) := 0

	// A tick of the system; its main rule is the parameter.
	rule r_tick($main in Rule) =
		seq
			r_setTimes[]
			$main[]
			r_observe[]
			r_resetTimes[]
			r_forget[]
			r_stopEndless[]
			r_remember[]
		endseq

	// a synchronous task never waits past its watchdog
	invariant inv_watchdog over task_timeInWait:
		(forall $t in Task with
			task_kind($t) = SYNCHRONOUS
			implies task_timeInWait($t) <= max(task_timeAllowed($t) - task_timeForElaboration($t), 0))
	// it begins each cycle at the tick at which the period before ends, or within its jitter, unless it may be late
	invariant inv_periods over task_periodStart:
		(forall $t in Task with
			task_kind($t) = SYNCHRONOUS and isUndef(mayBeLate($t))
			implies (
				task_elapsedTimeOfPeriod($t) >= 0
				and task_elapsedTimeOfPeriod($t) - task_period($t)
					<= (if isDef(task_jitter($t)) then task_jitter($t) else 0 endif)))

	// with no assumption of fairness: whoever asks for a lock gets it or gives up
	CTLSPEC ctlSpec_served: (forall $t in Task with ag(af(not isAsking($t))))
