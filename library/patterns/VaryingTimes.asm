/* Elaborations whose length varies: each may end at any tick between the least and the most that it takes.

   `time` is the most. In each tick from the least on, an input says whether the elaboration ends, so a system in which nothing
   varies has no input. An application steps each task by `r_scheduler_executeVarying`, and all else as ControlTask says. */
module VaryingTimes

import ../std/StandardLibrary
import Task
import Scheduler
import ControlTask

export *

signature:
	// the least ticks of a phase whose length varies; undef: it takes just `time`
	controlled timeAtLeast: SchedulePhase -> Integer

	// what the scheduler does ends now; asked only while it may
	monitored endsNow: Scheduler -> Boolean

	derived mayEnd: Scheduler -> Boolean

definitions:
	function mayEnd($c in Scheduler) =
		if isUndef(timeAtLeast(scheduler_currentPhase($c))) then
			false
		else
			scheduler_currentScheduleTime($c) >= timeAtLeast(scheduler_currentPhase($c))
		endif

	rule r_scheduler_executeVarying($c in Scheduler) =
		if action(scheduler_currentPhase($c)) = ELABORATING and not tElapsed($c) and mayEnd($c) then
			if endsNow($c) then
				r_leavePhase[$c]
			endif
		else
			r_scheduler_execute[$c]
		endif
