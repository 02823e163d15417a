/* How often readers get something new, with finitely many states: statistics begin anew, and a time that is too long is as long as the
   shortest one that is. */
module FreshInTicks

import ../std/StandardLibrary
import ../std/CTLLibrary
import ../patterns/FreshReadings

export *

signature:

definitions:
	rule r_forgetReadings =
		forall $r in FreshReading with true do
			par
				reading_longest($r) := 0
				reading_starved($r) := min(reading_starved($r), 1)
				if isDef(reading_since($r)) then
					reading_since($r) := min(reading_since($r), reading_limit($r) + 1)
				endif
			endpar

	// the time begins to count: something new comes once at least
	CTLSPEC ctlSpec_fresh: (forall $r in FreshReading with af(isDef(reading_since($r))))
