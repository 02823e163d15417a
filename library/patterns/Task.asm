/* Control tasks: their kind, their time budget and the statistics of their cycles.

   Time is a global tick count, `clock`; the main rule of the application advances it by one in every
   step, so a step is a tick. The start of a period is kept on the nominal grid (it moves by exactly
   one period, whenever the task really starts), hence periods neither drift nor lose ticks. */
module Task

import ../std/StandardLibrary

export *

signature:
	abstract domain Task

	enum domain TaskKind = {SYNCHRONOUS | ASYNCHRONOUS}

	controlled clock: Integer

	// Configuration: given once, by the initial state of the application.
	controlled task_kind: Task -> TaskKind
	// ticks; undef for an asynchronous task
	controlled task_period: Task -> Integer
	// ticks a whole cycle takes when no lock is ever busy, the lock handshakes included, with the jitter of its release
	controlled task_timeForElaboration: Task -> Integer
	// ticks from the start of a period to the time at which its cycle must be done; undef: the whole period
	controlled task_deadline: Task -> Integer
	// it may miss deadlines, so its cycles may begin late; undef: no
	controlled mayBeLate: Task -> Boolean
	// ticks by which a cycle may be released after the start of its period; undef: none
	controlled task_jitter: Task -> Integer

	// The present cycle
	controlled task_periodStart: Task -> Integer
	controlled task_timeInWait: Task -> Integer
	// its period has begun, and its cycle is not released yet; undef between two steps, and where releases have no jitter
	controlled task_isHeld: Task -> Boolean

	// Statistics since the start; nothing in the library depends on them
	controlled task_cycles: Task -> Integer
	controlled task_deadlinesMet: Task -> Integer
	controlled task_deadlinesMissed: Task -> Integer
	controlled task_totalWait: Task -> Integer
	controlled task_longestWait: Task -> Integer
	controlled task_skipped: Task -> Integer

	derived task_elapsedTimeOfPeriod: Task -> Integer
	derived task_timeAllowed: Task -> Integer
	derived thereIsTime: Task -> Boolean

definitions:
	function task_elapsedTimeOfPeriod($t in Task) =
		clock - task_periodStart($t)

	function task_timeAllowed($t in Task) =
		if isDef(task_deadline($t)) then task_deadline($t) else task_period($t) endif

	// One more tick of waiting still lets the task finish by its deadline.
	function thereIsTime($t in Task) =
		if task_kind($t) = SYNCHRONOUS then
			task_timeInWait($t) < task_timeAllowed($t) - task_timeForElaboration($t)
		else
			true
		endif

	// A tick spent waiting: for a lock, or for room in a queue.
	rule r_task_wait($t in Task) =
		let ($waited = task_timeInWait($t) + 1) in
			par
				task_timeInWait($t) := $waited
				task_totalWait($t) := task_totalWait($t) + 1
				task_longestWait($t) := max(task_longestWait($t), $waited)
			endpar
		endlet

	// An action was given up because waiting longer would cost the deadline.
	rule r_task_skip($t in Task) =
		task_skipped($t) := task_skipped($t) + 1

	// The work of a cycle is done. Only synchronous tasks have a deadline: the end of their period, unless an
	// earlier one is given.
	rule r_task_complete($t in Task) =
		par
			task_cycles($t) := task_cycles($t) + 1
			task_timeInWait($t) := 0
			if task_kind($t) = SYNCHRONOUS then
				if task_elapsedTimeOfPeriod($t) <= task_timeAllowed($t) then
					task_deadlinesMet($t) := task_deadlinesMet($t) + 1
				else
					task_deadlinesMissed($t) := task_deadlinesMissed($t) + 1
				endif
			endif
		endpar

	// Advance by one period, not to `clock`: a late cycle does not move the grid.
	rule r_task_nextPeriod($t in Task) =
		if task_kind($t) = SYNCHRONOUS then
			task_periodStart($t) := task_periodStart($t) + task_period($t)
		endif
