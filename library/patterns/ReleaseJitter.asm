/* Releases with jitter: a cycle may be released at any tick from the start of its period on, until the jitter of its task is over. It
   stands beside the machines of ControlTask: an application runs `r_release` before each step and `r_forgetReleases` after it, in
   sequence.

   Release jitter is that of N. Audsley, A. Burns, M. Richardson, K. Tindell, A. Wellings, *Applying New Scheduling Theory to Static
   Priority Pre-emptive Scheduling* (1993): the cycle of the period that starts at k * T is released in [k * T, k * T + J]. The grid of
   the periods does not move, and deadlines count from there. In each tick in which a release may still come, an input says whether
   it has, so a system without jitter has no input. A cycle whose task is still busy begins as soon as that is over. */
module ReleaseJitter

import ../std/StandardLibrary
import Task
import Scheduler

export *

signature:
	// its cycle is released by now; asked only while it may come later
	monitored isReleased: Scheduler -> Boolean

	derived isBetweenCycles: Scheduler -> Boolean
	derived mayBeHeld: Scheduler -> Boolean

definitions:
	// It waits for its next cycle, or may come to do so in this step.
	function isBetweenCycles($c in Scheduler) =
		action(scheduler_currentPhase($c)) = WAITING_TRIGGER
		or action(nextPhase(scheduler_currentPhase($c))) = WAITING_TRIGGER

	function mayBeHeld($c in Scheduler) =
		if isUndef(task_jitter(scheduler_mainThread($c))) then
			false
		else
			let ($late = task_elapsedTimeOfPeriod(scheduler_mainThread($c)) - task_period(scheduler_mainThread($c))) in
				$late >= 0 and $late < task_jitter(scheduler_mainThread($c)) and isBetweenCycles($c)
			endlet
		endif

	rule r_release =
		forall $c in Scheduler with mayBeHeld($c) do
			if not isReleased($c) then
				task_isHeld(scheduler_mainThread($c)) := true
			endif

	rule r_forgetReleases =
		forall $t in Task with true do task_isHeld($t) := undef
