/* The times of one task, to the tick: its waiting, its deadlines and its periods, as ../patterns/Task counts them, against what
   is counted here beside it. In each tick the environment says what the task does, and chooses its kind and its deadline in the
   initial state: none, one tick before the end of the period, or two. A cycle may take longer than it should. */
asm TaskTimes

import ../std/StandardLibrary
import ../std/CTLLibrary
import ../patterns/Task

signature:
	enum domain Doing = {WAITS | WORKS | SKIPS | FINISHES}
	enum domain Deadline = {OF_PERIOD | ONE_EARLIER | TWO_EARLIER}

	static task: Task

	// asked for in the initial state
	monitored kind: TaskKind
	monitored deadline: Deadline
	monitored does: Doing

	controlled works: Boolean
	// the ticks since the present period began by right, and those of them that were spent waiting
	controlled age: Integer
	controlled waited: Integer
	// what the last tick was
	controlled did: Doing
	controlled wasLate: Boolean
	controlled began: Boolean

	derived isSynchronous: Boolean
	derived allowed: Integer
	derived patience: Integer

definitions:
	function isSynchronous =
		task_kind(task) = SYNCHRONOUS

	function allowed =
		if isDef(task_deadline(task)) then task_deadline(task) else 4 endif

	function patience =
		allowed - 1

	// A cycle goes on for two ticks past its period at most, and waits for five.
	rule r_do($does in Doing) =
		par
			switch $does
				case WAITS: r_task_wait[task]
				case SKIPS: r_task_skip[task]
				case FINISHES:
					par
						r_task_complete[task]
						works := false
					endpar
				otherwise skip
			endswitch
			did := $does
			wasLate := isSynchronous and $does = FINISHES and age > allowed
			waited :=
				switch $does
					case WAITS: waited + 1
					case FINISHES: 0
					otherwise waited
				endswitch
		endpar

	rule r_begin =
		par
			r_task_nextPeriod[task]
			works := true
			began := true
			did := WORKS
			wasLate := false
			age := if isSynchronous then age - 4 else 0 endif
		endpar

	// Each begins with another number, so that none is taken for another.
	rule r_beginStatistics =
		par
			task_cycles(task) := 10
			task_deadlinesMet(task) := 20
			task_deadlinesMissed(task) := 30
			task_totalWait(task) := 40
			task_longestWait(task) := 0
			task_skipped(task) := 50
			began := false
		endpar

	// the period begins on its grid, however late the cycle
	invariant inv_grid over task_periodStart:
		if isSynchronous then task_elapsedTimeOfPeriod(task) = age else task_periodStart(task) = 0 endif
	invariant inv_waiting over task_timeInWait: task_timeInWait(task) = waited
	invariant inv_patience over task_timeInWait: thereIsTime(task) = (not isSynchronous or waited < patience)
	invariant inv_cycles over task_cycles: task_cycles(task) = (if did = FINISHES then 11 else 10 endif)
	invariant inv_missed over task_deadlinesMissed: task_deadlinesMissed(task) = (if wasLate then 31 else 30 endif)
	invariant inv_met over task_deadlinesMet:
		task_deadlinesMet(task) = (if isSynchronous and did = FINISHES and not wasLate then 21 else 20 endif)
	invariant inv_waits over task_totalWait, task_longestWait:
		task_totalWait(task) = (if did = WAITS then 41 else 40 endif)
		and task_longestWait(task) = (if did = WAITS then waited else 0 endif)
	invariant inv_skips over task_skipped: task_skipped(task) = (if did = SKIPS then 51 else 50 endif)
	// what is to be noticed comes
	CTLSPEC ctlSpec_late: isSynchronous implies ef(wasLate)
	CTLSPEC ctlSpec_begins: ag(ef(began))

	main rule r_Main =
		seq
			r_beginStatistics[]
			if works then
				r_do[if age >= 6 or waited >= 5 then FINISHES else does endif]
			else
				if not isSynchronous or age >= 4 then
					r_begin[]
				else
					did := WORKS
				endif
			endif
			par
				age := age + 1
				clock := clock + 1
			endpar
			// times matter by their difference to the clock only
			par
				clock := 0
				if isSynchronous then task_periodStart(task) := task_periodStart(task) - clock endif
				if not isSynchronous then age := 0 endif
			endpar
		endseq

default init s0:
	function clock = 0
	function task_kind($t in Task) = kind
	function task_period($t in Task) = 4
	function task_timeForElaboration($t in Task) = 1
	function task_deadline($t in Task) =
		switch deadline
			case OF_PERIOD: undef
			case ONE_EARLIER: 3
			otherwise 2
		endswitch
	function task_periodStart($t in Task) = 0
	function task_timeInWait($t in Task) = 0
	function task_cycles($t in Task) = 10
	function task_deadlinesMet($t in Task) = 20
	function task_deadlinesMissed($t in Task) = 30
	function task_totalWait($t in Task) = 40
	function task_longestWait($t in Task) = 0
	function task_skipped($t in Task) = 50
	function works = true
	function age = 0
	function waited = 0
	function did = WORKS
	function wasLate = false
	function began = true
