/* Faults seeded into the tasks of a system without time, each of which a refinement check must find: the reader reads the other array; a slave
   gives its lock back when it begins and not when it ends; the index section forgets what is pending; a reader goes on with what it read
   before. The fault is chosen in the initial state; `--bound seeded=LOST` takes one.

   A task makes its step, and then the fault changes what came of it. */
module ServoingFaults

import ../../../library/std/StandardLibrary
import ../../../library/patterns/ControlTask

export *

signature:
	enum domain Slip = {OTHER_ARRAY | RELEASED_EARLY | LOST | STALE}

	monitored seeded: Slip
	controlled slip: Slip

definitions:
	// Reading begins in this step.
	rule r_otherArray($c in Scheduler, $b in SwingingBuffer) =
		let ($wasReading = isDef(sb_readingArray($b))) in
			seq
				r_scheduler_execute[$c]
				if isDef(sb_readingArray($b)) and not $wasReading then
					par
						sb_received($b) := sb_data($b, indexWrite($b))
						sb_receivedSequence($b) := sb_sequence($b, indexWrite($b))
					endpar
				endif
			endseq
		endlet

	rule r_stale($c in Scheduler, $b in SwingingBuffer) =
		let ($received = sb_received($b), $number = sb_receivedSequence($b)) in
			seq
				r_scheduler_execute[$c]
				par
					sb_received($b) := $received
					sb_receivedSequence($b) := $number
				endpar
			endseq
		endlet

	// The post at the end of the access finds it outside.
	rule r_releasedEarly($c in Scheduler, $b in SwingingBuffer, $p in SchedulePhase) =
		seq
			r_scheduler_execute[$c]
			if sb_master($b) != $p then
				par
					sem_illegalPost(sem($b)) := false
					if contains({WRITING, READING}, sb_ctrlState($p)) then
						sem_state(sem($b), scheduler_mainThread($c)) := READY
					endif
				endpar
			endif
		endseq

	rule r_lost($c in Scheduler, $b in SwingingBuffer) =
		let ($read = indexRead($b), $written = indexWrite($b), $updated = indexUpdated($b)) in
			seq
				r_scheduler_execute[$c]
				if indexUpdated($b) and not $updated then
					par
						indexRead($b) := $read
						indexWrite($b) := $written
					endpar
				endif
			endseq
		endlet

	// Phase and buffer are those before the step.
	rule r_slippingTask =
		let ($c = self, $p = scheduler_currentPhase(self), $b = sharedMemory(scheduler_currentPhase(self))) in
			if contains({WRITING_ON_SB, READING_FROM_SB}, action($p)) then
				switch slip
					case OTHER_ARRAY: r_otherArray[$c, $b]
					case RELEASED_EARLY: r_releasedEarly[$c, $b, $p]
					case LOST: r_lost[$c, $b]
					case STALE: r_stale[$c, $b]
				endswitch
			else
				r_scheduler_execute[$c]
			endif
		endlet
