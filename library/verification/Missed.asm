/* Missed deadlines among the last cycles, as ../patterns/MissedDeadlines counts them, against the last cycles kept here. In each step a
   cycle ends in time, ends late, or does not end. The number of cycles, one to three, and how many of them may be late, are asked for in
   the initial state. Beside it is a task that may miss none, of which nothing is counted. */
asm Missed

import ../std/StandardLibrary
import ../std/CTLLibrary
import ../patterns/MissedDeadlines
import ../patterns/Task

signature:
	enum domain Doing = {WORKS | ENDS_IN_TIME | ENDS_LATE}
	domain Ago subsetof Integer
	domain Window subsetof Integer
	domain Allowed subsetof Integer

	static task: Task
	static strict: Task

	// asked for in the initial state
	monitored window: Window
	monitored mayMiss: Allowed

	monitored does: Doing

	// the configuration, as it was asked for
	controlled among: Window
	controlled most: Allowed

	// whether a cycle was late, so many cycles ago; what the last step was
	controlled wasLate: Ago -> Boolean
	controlled did: Doing

	derived isCounted: Ago -> Boolean
	derived missed: Integer

definitions:
	domain Ago = {0 : 2}
	domain Window = {1 : 3}
	domain Allowed = {0 : 1}

	function isCounted($n in Ago) =
		wasLate($n) and $n < among

	function missed =
		size({$n in Ago | isCounted($n) : $n})

	// The other task's cycles end late whenever one ends.
	rule r_do($does in Doing) =
		par
			did := $does
			if $does != WORKS then
				par
					forall $t in Task with true do task_cycles($t) := task_cycles($t) + 1
					task_deadlinesMissed(strict) := task_deadlinesMissed(strict) + 1
					if $does = ENDS_LATE then
						task_deadlinesMissed(task) := task_deadlinesMissed(task) + 1
					endif
					wasLate(0) := $does = ENDS_LATE
					wasLate(1) := wasLate(0)
					wasLate(2) := wasLate(1)
				endpar
			endif
		endpar

	// Each begins with another number, so that none is taken for another.
	rule r_beginStatistics =
		par
			forall $t in Task with true do
				par
					task_cycles($t) := 10
					task_deadlinesMissed($t) := 20
				endpar
			task_mostMissed(task) := 1
			task_tooManyMissed(task) := 30
		endpar

	invariant inv_late over task_lateCycles: task_lateCycles(task) = {$n in Ago | isCounted($n) : $n}
	invariant inv_most over task_mostMissed:
		task_mostMissed(task) = (if did = ENDS_LATE then max(missed, 1) else 1 endif)
	// a late cycle is counted with which there are more than may be
	invariant inv_tooMany over task_tooManyMissed:
		task_tooManyMissed(task) = (if did = ENDS_LATE and missed > most then 31 else 30 endif)
	invariant inv_strict over task_lateCycles:
		isUndef(task_lateCycles(strict)) and isUndef(task_mostMissed(strict)) and isUndef(task_tooManyMissed(strict))
	invariant inv_betweenSteps over task_cyclesBefore, task_missedBefore:
		(forall $t in Task with isUndef(task_cyclesBefore($t)) and isUndef(task_missedBefore($t)))

	CTLSPEC ctlSpec_all: ag(ef(missed = among))
	CTLSPEC ctlSpec_none: ag(ef(missed = 0))

	main rule r_Main =
		seq
			r_beginStatistics[]
			r_beforeCycles[]
			r_do[does]
			r_countMissed[]
		endseq

default init s0:
	function task_window($t in Task) = if $t = task then window else undef endif
	// a number without a window means nothing
	function task_mayMiss($t in Task) = if $t = task then mayMiss else 0 endif
	function task_lateCycles($t in Task) = if $t = task then {} else undef endif
	function task_cycles($t in Task) = 10
	function task_deadlinesMissed($t in Task) = 20
	function task_mostMissed($t in Task) = if $t = task then 1 else undef endif
	function task_tooManyMissed($t in Task) = if $t = task then 30 else undef endif
	function among = window
	function most = mayMiss
	function wasLate($n in Ago) = false
	function did = WORKS
