/* Every task of a system begins its cycle again and again, but for one that may stay at an endless action. */
module Progress

import ../std/StandardLibrary
import ../std/CTLLibrary
import ../patterns/ControlTask
import SystemInTicks

export *

signature:

definitions:
	// with no assumption of fairness
	CTLSPEC ctlSpec_works: (forall $t in Task with ag(af(isBeginning($t)) and af(not isBeginning($t) or isFree($t))))
