/* Says whether the object is seen, and where it is looked for.

   An object that was seen is looked for near where it should be, also while something covers it. It is lost when the head has given it
   up; then it is looked for in the whole image. */
asm Tracker

import ../../library/std/StandardLibrary
import ../../library/std/CTLLibrary
import ../../library/std/LTLLibrary
import Tracking

signature:
	enum domain Mode = {SEARCHING | TRACKING | COVERED}
	/* the object is in this image, where it was looked for */
	monitored found: Boolean
	monitored aim: Pursuit
	out sight: Boolean
	controlled mode: Mode
	derived isGivenUp: Boolean

definitions:
	function isGivenUp = not found and aim != FOLLOWING

	invariant inv_told over sight, mode: sight iff mode = TRACKING

	/* it is looked for near a place only if it was seen since it was lost */
	LTLSPEC ltlSpec_known: g(mode != SEARCHING implies s(mode != SEARCHING, y(found)))
	/* what is told was seen in the last image */
	LTLSPEC ltlSpec_honest: g(sight iff y(found))
	/* it is lost only when the head has given it up, and then at once */
	LTLSPEC ltlSpec_keeps: g(y(mode != SEARCHING) and mode = SEARCHING implies y(not found and aim != FOLLOWING))
	LTLSPEC ltlSpec_lost: g(y(not found and aim != FOLLOWING) implies mode = SEARCHING)
	/* it may be found again and lost again, whatever has happened */
	CTLSPEC ctlSpec_again: ag(ef(mode = TRACKING) and ef(mode = COVERED) and ef(mode = SEARCHING))

	main rule r_Main =
		par
			sight := found
			if found then
				mode := TRACKING
			else
				mode := if mode = SEARCHING or isGivenUp then SEARCHING else COVERED endif
			endif
		endpar

default init s0:
	function sight = false
	function mode = SEARCHING
