/* Releases with jitter, to the tick: one task elaborates twice in each period of four ticks, for one tick each or for two. How much later
   than its period a cycle may be released is asked for in the initial state: not at all, a tick, or two. Beside the machines is told when
   each cycle begins: the environment is asked for that only.

   Elaborations of two ticks fill the period. A cycle that was released late then ends after the next period has started, and the one
   after it begins at once, or later within the jitter. */
asm JitterInTicks

import ../std/StandardLibrary
import ../std/CTLLibrary
import ../patterns/ControlTask
import ../patterns/ReleaseJitter
import Quotient

signature:
	domain Late subsetof Integer
	domain Length subsetof Integer

	static actor: Scheduler
	static task: Task
	static one: SchedulePhase
	static two: SchedulePhase
	static rest: SchedulePhase

	// asked for in the initial state
	monitored jitter: Late
	monitored length: Length

	// the configuration, as it was asked for
	controlled most: Late
	controlled lasts: Length

	// the phase that the task has to be in; ticks until it ends, and since its period has started
	controlled present: SchedulePhase
	controlled left: Integer
	controlled age: Integer
	// how late the cycle was that began in the last tick; undef: none did
	controlled beganLate: Integer

	derived isOut: Boolean

definitions:
	domain Late = {0 : 2}
	domain Length = {1 : 2}

	function isOut =
		if age < 4 then
			false
		else
			if age >= 4 + most then true else isReleased(actor) endif
		endif

	rule r_begin =
		par
			present := one
			left := lasts
			age := age - 3
			beganLate := age - 4
		endpar

	rule r_rest =
		par
			present := rest
			age := age + 1
			beganLate := undef
		endpar

	rule r_work =
		par
			if left > 1 then
				left := left - 1
			else
				par
					present := two
					left := lasts
				endpar
			endif
			age := age + 1
			beganLate := undef
		endpar

	// A cycle that ends is followed by the next one at once, if that is released by then.
	rule r_expect =
		if present = rest or present = two and left = 1 then
			if isOut then r_begin[] else r_rest[] endif
		else
			r_work[]
		endif

	invariant inv_phase over scheduler_currentPhase: scheduler_currentPhase(actor) = present
	invariant inv_grid over task_periodStart: task_elapsedTimeOfPeriod(task) = age
	invariant inv_late over beganLate: isDef(beganLate) implies (beganLate >= 0 and beganLate <= most)
	invariant inv_betweenSteps over task_isHeld: isUndef(task_isHeld(task))

	// every release comes
	CTLSPEC ctlSpec_begins: ag(af(isDef(beganLate)))
	CTLSPEC ctlSpec_inTime: if lasts = 1 then ag(ef(beganLate = 0)) else ef(beganLate = 0) endif
	CTLSPEC ctlSpec_late:
		(forall $late in Late with
			$late <= most implies (if lasts = 1 then ag(ef(beganLate = $late)) else ef(beganLate = $late) endif))

	main rule r_Main =
		seq
			r_expect[]
			r_release[]
			par
				r_scheduler_execute[actor]
				clock := clock + 1
			endpar
			r_forgetReleases[]
			r_forget[]
		endseq

default init s0:
	function clock = 0
	function task_kind($t in Task) = SYNCHRONOUS
	function task_period($t in Task) = 4
	function task_jitter($t in Task) = if jitter > 0 then jitter else undef endif
	function task_timeForElaboration($t in Task) = 4
	function task_periodStart($t in Task) = -4
	function task_timeInWait($t in Task) = 0
	function task_cycles($t in Task) = 0
	function task_deadlinesMet($t in Task) = 0
	function task_deadlinesMissed($t in Task) = 0
	function task_totalWait($t in Task) = 0
	function task_longestWait($t in Task) = 0
	function task_skipped($t in Task) = 0
	function scheduler_mainThread($c in Scheduler) = task
	function scheduler_currentPhase($c in Scheduler) = rest
	function scheduler_actionStart($c in Scheduler) = 0
	function action($p in SchedulePhase) = if $p = rest then WAITING_TRIGGER else ELABORATING endif
	function time($p in SchedulePhase) = if $p = rest then 1 else length endif
	function nextPhase($p in SchedulePhase) =
		switch $p
			case one: two
			case two: rest
			otherwise one
		endswitch
	function sharedMemory($p in SchedulePhase) = undef
	function messageQueue($p in SchedulePhase) = undef
	function sharedValue($p in SchedulePhase) = undef
	function elaborationRule($p in SchedulePhase) = undef
	function most = jitter
	function lasts = length
	function present = rest
	function left = 1
	function age = 4
