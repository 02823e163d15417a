/* Missed deadlines with finitely many states: statistics begin anew; that more were missed than may be is kept, and then it does not
   matter any more which. */
module MissedInTicks

import ../std/StandardLibrary
import ../patterns/Task
import ../patterns/MissedDeadlines

export *

signature:

definitions:
	rule r_forgetMissed =
		forall $t in Task with isWeaklyHard($t) do
			par
				task_mostMissed($t) := 0
				if task_tooManyMissed($t) > 0 then
					par
						task_tooManyMissed($t) := 1
						task_lateCycles($t) := {}
					endpar
				endif
			endpar
