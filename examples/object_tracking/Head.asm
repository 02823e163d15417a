/* Follows the object while it is seen, and for some cycles more, in which it should be where it was going. Then the head stands. */
asm Head

import ../../library/std/StandardLibrary
import ../../library/std/CTLLibrary
import ../../library/std/LTLLibrary
import Tracking

signature:
	domain Cycles subsetof Integer
	monitored sight: Boolean
	monitored isNewSight: Boolean
	out aim: Pursuit
	/* how many cycles ago it was told that the object is seen */
	controlled unseen: Cycles
	/* 300 ms: so long an object that is not seen is followed */
	static patience: Cycles
	derived isSeen: Boolean

definitions:
	domain Cycles = {0 : 60}

	function patience = 60

	function isSeen = isNewSight and sight

	invariant inv_patience over aim, unseen: aim = HOLDING iff unseen = patience

	/* it follows only what was seen, and not for longer than it was not seen */
	LTLSPEC ltlSpec_follows: g(aim = FOLLOWING implies s(aim = FOLLOWING, y(isNewSight and sight)))
	CTLSPEC ctlSpec_counts:
		(forall $n in Cycles with
			ag(unseen = $n and not (isNewSight and sight) implies ax(unseen = $n + 1 or $n = patience)))
	LTLSPEC ltlSpec_givesUp: f(g(not (isNewSight and sight))) implies f(g(aim = HOLDING))
	/* it follows at once, and stands only if the object was not seen */
	CTLSPEC ctlSpec_atOnce: ag(isNewSight and sight implies ax(aim = FOLLOWING and unseen = 0))
	/* an object that is not seen is followed for 300 ms */
	CTLSPEC ctlSpec_patient: ef(aim = FOLLOWING and unseen = 59)
	CTLSPEC ctlSpec_again: ag(ef(aim = FOLLOWING) and ef(aim = HOLDING))

	main rule r_Main =
		if isSeen then
			par
				unseen := 0
				aim := FOLLOWING
			endpar
		else
			if unseen < patience then
				par
					unseen := unseen + 1
					if unseen + 1 = patience then aim := HOLDING endif
				endpar
			endif
		endif

default init s0:
	function unseen = patience
	function aim = HOLDING
