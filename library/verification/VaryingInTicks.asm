/* Elaborations whose length varies, to the tick: one task elaborates for one to three ticks, loads for two, and rests. The environment says
   when the elaboration ends, and is asked for that only. Beside it is counted how long each phase has lasted. */
asm VaryingInTicks

import ../std/StandardLibrary
import ../std/CTLLibrary
import ../patterns/ControlTask
import ../patterns/VaryingTimes
import Quotient

signature:
	static actor: Scheduler
	static task: Task
	static cell: SharedValue
	static work: SchedulePhase
	static load: SchedulePhase
	static rest: SchedulePhase

	// asked for in the initial state: whether anything varies
	monitored doesVary: Boolean

	controlled present: SchedulePhase
	controlled lasted: Integer
	controlled wasShort: Boolean

	derived isOver: Boolean

definitions:
	// The phase ends in this tick: the elaboration where it says so, though not before its least time nor after its most.
	function isOver =
		switch present
			case rest: true
			case load: lasted >= 2
			otherwise
				if lasted >= 3 then
					true
				else
					if isUndef(timeAtLeast(work)) or lasted < 1 then false else endsNow(actor) endif
				endif
		endswitch

	rule r_expect =
		if isOver then
			par
				wasShort := present = work and lasted < 3
				present := nextPhase(present)
				lasted := 1
			endpar
		else
			par
				wasShort := false
				lasted := lasted + 1
			endpar
		endif

	invariant inv_phase over scheduler_currentPhase: scheduler_currentPhase(actor) = present
	invariant inv_fixed over wasShort: isUndef(timeAtLeast(work)) implies not wasShort

	// elaborations of every length come
	CTLSPEC ctlSpec_short: isDef(timeAtLeast(work)) implies ag(ef(wasShort))
	CTLSPEC ctlSpec_long: ag(ef(present = work and lasted = 3))

	main rule r_Main =
		seq
			r_expect[]
			par
				r_scheduler_executeVarying[actor]
				clock := clock + 1
			endpar
			r_forget[]
		endseq

default init s0:
	function clock = 0
	function task_kind($t in Task) = ASYNCHRONOUS
	function task_timeInWait($t in Task) = 0
	function task_cycles($t in Task) = 0
	function task_deadlinesMet($t in Task) = 0
	function task_deadlinesMissed($t in Task) = 0
	function task_totalWait($t in Task) = 0
	function task_longestWait($t in Task) = 0
	function task_skipped($t in Task) = 0
	function sv_sequence($v in SharedValue) = 0
	function sv_overwritten($v in SharedValue) = 0
	function sv_receivedSequence($v in SharedValue) = 0
	function sv_fresh($v in SharedValue) = false
	function scheduler_mainThread($c in Scheduler) = task
	function scheduler_currentPhase($c in Scheduler) = rest
	function scheduler_actionStart($c in Scheduler) = 0
	function action($p in SchedulePhase) =
		switch $p
			case work: ELABORATING
			case load: LOADING
			otherwise WAITING_TRIGGER
		endswitch
	function time($p in SchedulePhase) = if $p = work then 3 else 2 endif
	// a time is given of the loading, too, which does not vary
	function timeAtLeast($p in SchedulePhase) = if doesVary then 1 else undef endif
	function nextPhase($p in SchedulePhase) =
		switch $p
			case work: load
			case load: rest
			otherwise work
		endswitch
	function sharedMemory($p in SchedulePhase) = undef
	function messageQueue($p in SchedulePhase) = undef
	function sharedValue($p in SchedulePhase) = if $p = load then cell else undef endif
	function elaborationRule($p in SchedulePhase) = undef
	function present = rest
	function lasted = 1
	function wasShort = false
