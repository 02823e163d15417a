/* What one task has to do at each tick in its phases, told beside the machines and without their rules; and what is at the other ends of
   its channels, for PhasesInTicks.

   A phase lasts as long as its time says. A sender sends in its first tick, unless the queue is full and it has time to wait. What is
   received or loaded is taken when the phase begins, what is stored is there when it ends. A cycle that ends with its period, or after it,
   is followed by the next one at once, unless the task has a single phase. */
module PhaseTimeline

import ../std/StandardLibrary
import ../std/CTLLibrary
import ../patterns/ControlTask

export *

signature:
	domain Sort subsetof PhaseAction
	domain Few subsetof Integer
	enum domain Awaited = {NOTHING | MAIL | LEVEL | BOTH | EITHER}

	static actor: Scheduler
	static task: Task
	static inbox: MessageQueue
	static outbox: MessageQueue
	static level: SharedValue
	static state: SharedValue
	static one: SchedulePhase
	static two: SchedulePhase
	static rest: SchedulePhase
	// what `rest` awaits of two channels: phases that read them, beside the cycle
	static byMail: SchedulePhase
	static byLevel: SchedulePhase

	// asked for in the initial state
	monitored kind: TaskKind
	monitored sort: Sort
	monitored hasSecond: Boolean
	monitored waitsFor: Awaited
	monitored patience: Few
	monitored hasSlack: Boolean

	monitored takesLong: Boolean
	monitored mailComes: Boolean
	monitored mailIsTaken: Boolean
	monitored levelComes: Boolean

	// the configuration, as it was asked for
	controlled awaits: Awaited
	controlled mayWait: Few

	// the phase that the task has to be in; ticks until it ends, since the period began by right, and waited in this cycle
	controlled present: SchedulePhase
	controlled left: Integer
	controlled age: Integer
	controlled waited: Integer
	// the level was not loaded since it came; it was new when it was loaded last
	controlled levelIsNew: Boolean
	controlled mustBeFresh: Boolean

	// what has to come of this tick
	controlled elaborates: Boolean
	controlled takes: Boolean
	controlled stores: Boolean
	controlled sends: Boolean
	controlled refuses: Boolean
	controlled waits: Boolean
	controlled ends: Boolean

	derived isSynchronous: Boolean
	derived awaitsMail: Boolean
	derived awaitsLevel: Boolean
	derived hasTime: Boolean
	derived isOverdue: Boolean
	static lengthOf: PhaseAction -> Integer
	derived lengthOfSecond: Integer
	derived slack: Integer

definitions:
	domain Sort = {ELABORATING, SENDING, RECEIVING, STORING, LOADING}
	domain Few = {0 : 1}

	function isSynchronous =
		task_kind(task) = SYNCHRONOUS

	function awaitsMail =
		awaits = MAIL or awaits = BOTH or awaits = EITHER

	function awaitsLevel =
		awaits = LEVEL or awaits = BOTH or awaits = EITHER

	function hasTime =
		not isSynchronous or waited < mayWait

	function isOverdue =
		if isSynchronous then age > task_period(task) else false endif

	function lengthOf($a in PhaseAction) =
		if $a = SENDING then 1 else 2 endif

	function lengthOfSecond =
		if hasSecond then 1 else 0 endif

	// A task with a single phase rests for a tick between two cycles.
	function slack =
		patience + (if not hasSecond then 1 else if hasSlack then 1 else 0 endif endif)

	// Of the other ends only those move that the task looks at.
	rule r_others =
		par
			if action(one) = RECEIVING or awaitsMail then
				if mailComes then
					r_mq_send[inbox]
				endif
			endif
			if action(one) = SENDING then
				if mailIsTaken then
					r_mq_receive[outbox]
				endif
			endif
			if action(one) = LOADING or awaitsLevel then
				if levelComes then
					r_sv_write[level]
				endif
			endif
		endpar

	rule r_enter($p in SchedulePhase, $hasMail in Boolean) =
		par
			present := $p
			left := time($p)
			elaborates := action($p) = ELABORATING and isDef(elaborationRule($p))
			if action($p) = RECEIVING then
				takes := $hasMail
			endif
			if action($p) = LOADING then
				par
					mustBeFresh := levelIsNew
					levelIsNew := false
				endpar
			endif
		endpar

	// Only a single phase that begins on time may last as long as the period.
	rule r_begin($hasMail in Boolean) =
		seq
			time(one) :=
				if isSynchronous and nextPhase(one) = rest and action(one) != SENDING and age = task_period(task) then
					if takesLong then task_period(task) else 2 endif
				else
					2
				endif
			par
				r_enter[one, $hasMail]
				if isSynchronous then
					age := age - task_period(task)
				endif
			endpar
		endseq

	rule r_end($hasMail in Boolean) =
		par
			ends := true
			waited := 0
			if isSynchronous and nextPhase(one) = two and age >= task_period(task) then
				r_begin[$hasMail]
			else
				present := rest
			endif
		endpar

	rule r_leave($hasMail in Boolean) =
		if present = one and nextPhase(one) = two then
			r_enter[two, $hasMail]
		else
			r_end[$hasMail]
		endif

	rule r_send($hasMail in Boolean, $hasRoom in Boolean) =
		if hasTime and not $hasRoom then
			par
				waits := true
				if isSynchronous then
					waited := waited + 1
				endif
			endpar
		else
			par
				sends := $hasRoom
				refuses := not $hasRoom
				r_leave[$hasMail]
			endpar
		endif

	rule r_expect($hasMail in Boolean, $hasRoom in Boolean) =
		if present = rest then
			if isSynchronous and age >= task_period(task)
				or not isSynchronous
					and (
						switch awaits
							case MAIL: $hasMail
							case LEVEL: levelIsNew
							case BOTH: $hasMail and levelIsNew
							case EITHER: $hasMail or levelIsNew
							otherwise true
						endswitch) then
				r_begin[$hasMail]
			endif
		else
			if action(present) = SENDING then
				r_send[$hasMail, $hasRoom]
			else
				if left > 1 then
					left := left - 1
				else
					par
						stores := action(present) = STORING
						r_leave[$hasMail]
					endpar
				endif
			endif
		endif

	rule r_expectNothing =
		par
			elaborates := false
			takes := false
			stores := false
			sends := false
			refuses := false
			waits := false
			ends := false
		endpar
