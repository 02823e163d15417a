/* How many deadlines a task misses among its last cycles. It stands beside the machines of ControlTask and changes nothing of
   theirs: an application runs `r_beforeCycles` before each step and `r_countMissed` after it, in sequence.

   A task is weakly hard if it may miss at most m deadlines of any k successive cycles: G. Bernat, A. Burns, A. Llamosi, *Weakly
   Hard Real-Time Systems* (2001). The cycles before the first one count as done in time. */
module MissedDeadlines

import ../std/StandardLibrary
import Task

export *

signature:
	// Configuration: of so many successive cycles; undef: no deadline may be missed, and nothing is counted here
	controlled task_window: Task -> Integer
	// so many may miss their deadlines
	controlled task_mayMiss: Task -> Integer

	// Which of the last `task_window` cycles missed theirs: how many cycles ago, from 0 on
	controlled task_lateCycles: Task -> Powerset(Integer)

	// As it was before the step; undef between two steps
	controlled task_cyclesBefore: Task -> Integer
	controlled task_missedBefore: Task -> Integer

	// What came of it: the most in a window, and how many cycles ended with more than may be
	controlled task_mostMissed: Task -> Integer
	controlled task_tooManyMissed: Task -> Integer

	derived isWeaklyHard: Task -> Boolean
	derived olderLate: Task -> Powerset(Integer)

definitions:
	function isWeaklyHard($t in Task) = isDef(task_window($t))

	// a cycle later
	function olderLate($t in Task) =
		{$n in task_lateCycles($t) | $n + 1 < task_window($t) : $n + 1}

	rule r_beforeCycles =
		forall $t in Task with isWeaklyHard($t) do
			par
				task_cyclesBefore($t) := task_cycles($t)
				task_missedBefore($t) := task_deadlinesMissed($t)
			endpar

	rule r_endLate($t in Task) =
		let ($late = including(olderLate($t), 0)) in
			par
				task_lateCycles($t) := $late
				task_mostMissed($t) := max(task_mostMissed($t), size($late))
				if size($late) > task_mayMiss($t) then
					task_tooManyMissed($t) := task_tooManyMissed($t) + 1
				endif
			endpar
		endlet

	// What a step of the tasks adds.
	rule r_countMissed =
		forall $t in Task with isWeaklyHard($t) do
			par
				if task_cycles($t) != task_cyclesBefore($t) then
					if task_deadlinesMissed($t) != task_missedBefore($t) then
						r_endLate[$t]
					else
						task_lateCycles($t) := olderLate($t)
					endif
				endif
				task_cyclesBefore($t) := undef
				task_missedBefore($t) := undef
			endpar
