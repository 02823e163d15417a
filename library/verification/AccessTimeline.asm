/* What a task has to do at each tick of its cycle: elaborate, access its buffer, and rest. It is told as a timeline of stages, beside the
   machines and without their rules, from the figures 8 to 10 of the paper and from what ../patterns/README promises. Each tick the
   machines are held to it.

   A master that writes acts, asks, and has the lock for a tick. A master that reads asks, has the lock for a tick, and acts. A slave asks,
   and acts inside. Who has no time to wait any longer goes on without the lock. */
module AccessTimeline

import ../std/StandardLibrary
import ../std/CTLLibrary
import ../patterns/ControlTask
import AccessParties

export *

signature:
	// COMES: in the phase of its access, and not yet in the machine of it
	enum domain Stage = {RESTS | WORKS | COMES | ACTS | ASKS | HAS}

	monitored overruns: Boolean

	controlled stage: Stage
	// ticks until the action ends; ticks since the period began by right, and waited in this cycle
	controlled left: Integer
	controlled age: Integer
	controlled waited: Integer

	// what has to come of this tick
	controlled begins: Boolean
	controlled acts: Boolean
	controlled swaps: Boolean
	controlled waits: Boolean
	controlled skips: Boolean
	controlled ends: Boolean
	controlled isLate: Boolean

	// the datum written last was not handed over yet; the one handed over was not read yet; the last reading was of a new one
	controlled isPending: Boolean
	controlled isUnread: Boolean
	controlled mustBeFresh: Boolean

	derived isDue: Boolean
	derived hasTime: Boolean

definitions:
	function isDue =
		if isSynchronous then
			age >= task_period(actor_task)
		else
			if awaitsData then isUnread or (isPending and asMaster) else true endif
		endif

	function hasTime =
		not isSynchronous or waited < patience

	// A cycle that begins on time may work for three ticks longer than it should, and so be late.
	rule r_beginCycle =
		let ($ticks = if isSynchronous and age = task_period(actor_task) and overruns then 4 else 1 endif) in
			par
				stage := WORKS
				begins := true
				left := $ticks
				time(work) := $ticks
				if isSynchronous then
					age := age - task_period(actor_task)
				endif
			endpar
		endlet

	rule r_act =
		par
			stage := ACTS
			acts := true
			left := 2
		endpar

	rule r_come =
		if asMaster and not reads then
			r_act[]
		else
			stage := ASKS
		endif

	rule r_leave =
		par
			ends := true
			waited := 0
			isLate := isSynchronous and age > task_timeAllowed(actor_task)
			if isSynchronous and isDue then
				r_beginCycle[]
			else
				stage := RESTS
			endif
		endpar

	rule r_ask($granted in Boolean) =
		if $granted then
			if asMaster then
				par
					stage := HAS
					swaps := true
				endpar
			else
				r_act[]
			endif
		else
			if hasTime then
				par
					waits := true
					if isSynchronous then
						waited := waited + 1
					endif
				endpar
			else
				par
					skips := true
					if asMaster and reads then
						r_act[]
					else
						r_leave[]
					endif
				endpar
			endif
		endif

	rule r_expect($granted in Boolean) =
		switch stage
			case RESTS:
				if isDue then
					r_beginCycle[]
				endif
			case COMES: r_come[]
			case ASKS: r_ask[$granted]
			case HAS:
				if reads then
					r_act[]
				else
					r_leave[]
				endif
			otherwise
				if left > 1 then
					left := left - 1
				else
					if stage = WORKS then
						par
							time(work) := 1
							r_come[]
						endpar
					else
						if asMaster and not reads then
							stage := ASKS
						else
							r_leave[]
						endif
					endif
				endif
		endswitch

	rule r_expectNothing =
		par
			begins := false
			acts := false
			swaps := false
			waits := false
			skips := false
			ends := false
			isLate := false
		endpar
