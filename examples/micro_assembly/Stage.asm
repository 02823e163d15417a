/* Says what the axes do: they follow corrections until the part lies right, then go down until the contact is felt. If more is felt than
   the part bears, they go up, whatever is ordered, and stay there. Without images in which the marks are seen they stand. */
asm Stage

import ../../library/std/StandardLibrary
import ../../library/std/CTLLibrary
import ../../library/std/LTLLibrary
import Assembling

signature:
	domain Cycles subsetof Integer
	monitored guidance: Prod(Work, Marks)
	monitored isNewGuidance: Boolean
	monitored contact: Touch
	monitored isNewContact: Boolean
	/* z is as high as it can be */
	monitored isUp: Boolean
	out state: Progress
	out motion: Motion
	/* how many cycles ago an image showed the marks */
	controlled unseen: Cycles
	/* 100 ms: so long the axes go on without another image */
	static patience: Cycles
	derived isSeen: Boolean
	derived isGuided: Boolean

definitions:
	domain Cycles = {0 : 50}

	function patience = 50

	/* an image that shows the marks; one that did so is not too old */
	function isSeen = isNewGuidance and second(guidance) != HIDDEN
	function isGuided = isDef(guidance) and (isSeen or unseen < patience)

	rule r_is($state in Progress, $motion in Motion) =
		par
			state := $state
			motion := $motion
		endpar

	rule r_retract =
		if isUp then r_is[RETRACTED, STAND] else r_is[RETRACTING, UP] endif

	rule r_align =
		r_is[if second(guidance) = TOGETHER then ALIGNED else ALIGNING endif, if isSeen then CORRECT else STAND endif]

	/* no step down without having felt that nothing is there */
	rule r_lower =
		if isNewContact and contact = CONTACT then
			r_is[PLACED, STAND]
		else
			r_is[LOWERING, if isNewContact and contact = FREE then DOWN else STAND endif]
		endif

	rule r_work =
		if not isGuided then
			r_is[PAUSED, STAND]
		else
			switch first(guidance)
				case ALIGN: r_align[]
				case LOWER: r_lower[]
				otherwise r_is[PAUSED, STAND]
			endswitch
		endif

	rule r_count = unseen := if isSeen then 0 else min(unseen + 1, patience) endif

	/* in the step that feels it, and ever after: up, or up there */
	CTLSPEC ctlSpec_overload:
		ag(
			contact = OVERLOAD and state != RETRACTED
			implies ax(ag(motion = UP and state = RETRACTING or motion = STAND and state = RETRACTED)))
	/* nothing else makes it go up, and it says that it has only when it has */
	LTLSPEC ltlSpec_retracts: g(state = RETRACTING iff motion = UP)
	LTLSPEC ltlSpec_forced: g(motion = UP implies s(motion = UP, y(contact = OVERLOAD)))
	LTLSPEC ltlSpec_up: g(state = RETRACTED implies s(state = RETRACTED, y(isUp)))

	/* it goes down only if that is ordered, the marks were seen not long ago, and nothing is felt now */
	LTLSPEC ltlSpec_ordered:
		g(motion = DOWN implies state = LOWERING and y((exist $m in Marks with guidance = (LOWER, $m))))
	LTLSPEC ltlSpec_gentle: g(motion = DOWN implies y(isNewContact and contact = FREE))
	LTLSPEC ltlSpec_sighted:
		g(
			motion = DOWN or motion = CORRECT or state = ALIGNING or state = ALIGNED or state = LOWERING
			implies y(unseen < patience or isNewGuidance and second(guidance) != HIDDEN))
	/* each correction is followed once, and none of an image without marks */
	LTLSPEC ltlSpec_corrects:
		g(motion = CORRECT implies y(isNewGuidance and (guidance = (ALIGN, APART) or guidance = (ALIGN, TOGETHER))))

	/* what is ordered is done at once, if nothing is in its way */
	LTLSPEC ltlSpec_follows:
		g(
			y(
				isNewGuidance
				and (guidance = (ALIGN, APART) or guidance = (ALIGN, TOGETHER))
				and contact != OVERLOAD
				and (state = PAUSED or state = ALIGNING or state = ALIGNED or state = LOWERING))
			implies motion = CORRECT and (state = ALIGNED iff y(guidance = (ALIGN, TOGETHER))))
	LTLSPEC ltlSpec_lowers:
		g(
			y(
				(isNewGuidance and second(guidance) != HIDDEN or unseen < patience)
				and (exist $m in Marks with guidance = (LOWER, $m))
				and isNewContact
				and contact = FREE
				and (state = PAUSED or state = ALIGNING or state = ALIGNED or state = LOWERING))
			implies motion = DOWN)

	/* what it says is so; once placed, the part is not moved any more, unless more is felt than it bears */
	LTLSPEC ltlSpec_aligned: g(state = ALIGNED implies y(guidance = (ALIGN, TOGETHER)))
	LTLSPEC ltlSpec_told:
		g(
			(state = ALIGNING implies y((exist $m in Marks with guidance = (ALIGN, $m))))
			and (state = LOWERING implies y((exist $m in Marks with guidance = (LOWER, $m)))))
	LTLSPEC ltlSpec_placed:
		g(
			state = PLACED
			implies s(
				state = PLACED,
				y(isNewContact and contact = CONTACT and (exist $m in Marks with guidance = (LOWER, $m)))))
	LTLSPEC ltlSpec_rests: g(y(state = PLACED and contact != OVERLOAD) implies state = PLACED and motion = STAND)

	CTLSPEC ctlSpec_counts:
		(forall $n in Cycles with
			ag(
				unseen = $n and not (isNewGuidance and second(guidance) != HIDDEN)
				implies ax(unseen = $n + 1 or $n = patience)))
	CTLSPEC ctlSpec_seen: ag(isNewGuidance and second(guidance) != HIDDEN implies ax(unseen = 0))
	CTLSPEC ctlSpec_works:
		contact != OVERLOAD and not isNewContact
		implies ef(state = ALIGNED) and ef(state = PLACED) and ef(state = RETRACTED)

	/* without another image it goes on for 100 ms */
	CTLSPEC ctlSpec_patient: contact != OVERLOAD and not isNewContact implies ef(motion = DOWN and unseen = 50)

	main rule r_Main =
		par
			r_count[]
			if state = RETRACTED then
				r_is[RETRACTED, STAND]
			else
				if state = RETRACTING or contact = OVERLOAD then
					r_retract[]
				else
					if state = PLACED then motion := STAND else r_work[] endif
				endif
			endif
		endpar

default init s0:
	function state = PAUSED
	function motion = STAND
	function unseen = patience
