/* Faults seeded into the machines of tasks on shared values, as BufferFaults are into those on swinging buffers. */
module ValueFaults

import ../std/StandardLibrary
import ../patterns/ControlTask

export *

signature:
	enum domain Fault = {NONE | LOSS_NOT_COUNTED | ACKNOWLEDGED_LATE}

	monitored seeded: Fault
	controlled fault: Fault

	derived isAt: Prod(Scheduler, PhaseAction) -> Boolean

definitions:
	function isAt($c in Scheduler, $a in PhaseAction) =
		action(scheduler_currentPhase($c)) = $a

	rule r_lossNotCounted($c in Scheduler) =
		if isAt($c, STORING) and tElapsed($c) then
			let ($v = sharedValue(scheduler_currentPhase($c))) in
				par
					sv_value($v) := sv_staged($v)
					sv_sequence($v) := sv_sequence($v) + 1
					r_leavePhase[$c]
				endpar
			endlet
		else
			r_scheduler_execute[$c]
		endif

	// The reader marks the value as read when it is done, and so one that came meanwhile.
	rule r_acknowledgedLate($c in Scheduler) =
		par
			if isAt($c, LOADING) and tElapsed($c) then
				sv_receivedSequence(sharedValue(scheduler_currentPhase($c))) :=
					sv_sequence(sharedValue(scheduler_currentPhase($c)))
			endif
			r_scheduler_execute[$c]
		endpar

	rule r_faulty($c in Scheduler) =
		switch fault
			case NONE: r_scheduler_execute[$c]
			case LOSS_NOT_COUNTED: r_lossNotCounted[$c]
			case ACKNOWLEDGED_LATE: r_acknowledgedLate[$c]
		endswitch
