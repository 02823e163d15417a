/* Whether every reader of a system is told truly if what it has is new, also where it leaves a reading out. A system runs `r_tellFresh`
   after each of its steps, made finite or not.

   A reading has to be new if what was handed over last had not been read when it began, and so is never new twice; a reading that is left
   out has to be old. Only handing over makes a datum that was written no longer pending, and nobody begins to read meanwhile. */
module FreshTold

import ../std/StandardLibrary
import ../patterns/ControlTask

export *

signature:
	controlled mustBeFresh: SwingingBuffer -> Boolean
	// what was handed over last was not read yet
	controlled isUnread: SwingingBuffer -> Boolean
	// as it was before the step
	controlled wasPending: SwingingBuffer -> Boolean
	controlled wasReading: SwingingBuffer -> Boolean
	controlled wasAt: Scheduler -> SchedulePhase

	derived isLeftOut: Prod(Scheduler, SwingingBuffer) -> Boolean

definitions:
	function isLeftOut($c in Scheduler, $b in SwingingBuffer) =
		wasAt($c) != scheduler_currentPhase($c)
		and action(wasAt($c)) = READING_FROM_SB
		and sharedMemory(wasAt($c)) = $b
		and not wasReading($b)

	rule r_tellFresh =
		par
			forall $b in SwingingBuffer with true do
				par
					if isDef(sb_readingArray($b)) and not wasReading($b) then
						par
							mustBeFresh($b) := isUnread($b)
							isUnread($b) := false
						endpar
					else
						par
							if (exists $c in Scheduler with isLeftOut($c, $b)) then
								mustBeFresh($b) := false
							endif
							if wasPending($b) and not sb_pending($b) then
								isUnread($b) := true
							endif
						endpar
					endif
					wasPending($b) := sb_pending($b)
					wasReading($b) := isDef(sb_readingArray($b))
				endpar
			forall $d in Scheduler with true do
				wasAt($d) := scheduler_currentPhase($d)
		endpar

	invariant inv_fresh over sb_fresh: (forall $b in SwingingBuffer with sb_fresh($b) = mustBeFresh($b))
