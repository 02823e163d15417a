/* Says whether the discs are searched, tracked or lost, and whether set-points are given: one step for each image. */
asm Servoing

import ../../library/std/StandardLibrary
import ../../library/std/CTLLibrary
import ../../library/std/LTLLibrary
import Guiding

signature:
	domain Images subsetof Integer
	monitored hasTarget: Boolean
	/* all discs are in this image, where they were looked for */
	monitored isSeen: Boolean
	/* the law gives a set-point for where the discs are, or should be */
	monitored hasLaw: Boolean
	/* the features are as near to the target as they have to be */
	monitored isClose: Boolean
	out panel: ServoMode
	/* a set-point is handed over */
	out guiding: Boolean
	/* for how many images in a row some disc was not seen */
	controlled unseen: Images
	/* so many images are made up for */
	static patience: Images
	derived isFollowing: Boolean

definitions:
	domain Images = {0 : 10}

	function patience = 10

	/* it is known where the discs are */
	function isFollowing = panel = TRACKING or panel = CONVERGED or panel = COVERED

	rule r_is($mode in ServoMode, $guiding in Boolean, $unseen in Images) =
		par
			panel := $mode
			guiding := $guiding
			unseen := $unseen
		endpar

	invariant inv_unseen over panel, unseen: unseen != 0 iff panel = COVERED

	/* set-points are given for a target, by a law, and for discs of which it is known where they are: they were seen since they were lost */
	LTLSPEC ltlSpec_guides: g(guiding implies isFollowing and y(hasTarget and hasLaw))
	LTLSPEC ltlSpec_known: g(isFollowing implies s(isFollowing, y(hasTarget and isSeen)))
	/* and at once when they are seen */
	LTLSPEC ltlSpec_atOnce:
		g(y(hasTarget and isSeen) implies (panel = TRACKING or panel = CONVERGED) and (guiding iff y(hasLaw)))
	/* that it has converged was so in the last image */
	LTLSPEC ltlSpec_converged: g(panel = CONVERGED iff y(hasTarget and isSeen and hasLaw and isClose))
	LTLSPEC ltlSpec_target: g(panel = WITHOUT_TARGET iff not y(hasTarget))
	/* discs that are not seen are made up for in ten images, not in more; only then they are lost */
	CTLSPEC ctlSpec_counts:
		(forall $n in Images with
			ag(
				isFollowing and unseen = $n and hasTarget and not isSeen
				implies ax(panel = COVERED and unseen = $n + 1 or $n = patience and panel = LOST)))
	CTLSPEC ctlSpec_patient: ef(panel = COVERED and unseen = 10)
	LTLSPEC ltlSpec_lost: g(panel = LOST implies s(panel = LOST, y(unseen = patience and not isSeen)))
	/* whatever has happened, it may converge, and lose the discs */
	CTLSPEC ctlSpec_again: ag(ef(panel = CONVERGED) and ef(panel = COVERED) and ef(panel = LOST))

	main rule r_Main =
		if not hasTarget then
			r_is[WITHOUT_TARGET, false, 0]
		else
			if isSeen then
				r_is[if isClose and hasLaw then CONVERGED else TRACKING endif, hasLaw, 0]
			else
				if isFollowing and unseen < patience then
					r_is[COVERED, hasLaw, unseen + 1]
				else
					r_is[if isFollowing or panel = LOST then LOST else SEARCHING endif, false, 0]
				endif
			endif
		endif

default init s0:
	function panel = WITHOUT_TARGET
	function guiding = false
	function unseen = 0
