/* Tells the stage what to do, and what the image shows; that the part lies right only when successive images have shown it since the order
   came. */
asm Aligner

import ../../library/std/StandardLibrary
import ../../library/std/CTLLibrary
import ../../library/std/LTLLibrary
import Assembling

signature:
	domain Images subsetof Integer
	monitored recipe: Work
	/* all marks are in the image; they make a cross, as exactly as it takes */
	monitored marked: Boolean
	monitored crossed: Boolean
	out guidance: Prod(Work, Marks)
	controlled work: Work
	/* in so many successive images the part lay right */
	controlled right: Images
	static enough: Images
	derived isRight: Boolean

definitions:
	domain Images = {0 : 5}

	function enough = 5

	function isRight = marked and crossed

	rule r_order =
		par
			work := recipe
			right := 0
			guidance := (recipe, if marked then APART else HIDDEN endif)
		endpar

	rule r_look =
		if isRight then
			par
				right := min(right + 1, enough)
				guidance := (work, if right + 1 >= enough then TOGETHER else APART endif)
			endpar
		else
			par
				right := 0
				guidance := (work, if marked then APART else HIDDEN endif)
			endpar
		endif

	/* what is told is about this image, and about what is ordered */
	invariant inv_order over guidance, work: first(guidance) = work
	LTLSPEC ltlSpec_obeys:
		g(
			y(isDef(recipe))
			implies y(recipe = REST) and work = REST
				or y(recipe = ALIGN) and work = ALIGN
				or y(recipe = LOWER) and work = LOWER)
	LTLSPEC ltlSpec_seen: g(y(marked) iff second(guidance) != HIDDEN)

	/* five images in a row have shown the cross, all of them since the order */
	LTLSPEC ltlSpec_together:
		g(
			second(guidance) = TOGETHER
			implies y(
				marked
				and crossed
				and y(
					marked and crossed and y(marked and crossed and y(marked and crossed and y(marked and crossed))))))
	LTLSPEC ltlSpec_enough:
		g(
			y(
				marked
				and crossed
				and recipe = work
				and y(
					marked
					and crossed
					and recipe = work
					and y(
						marked
						and crossed
						and recipe = work
						and y(marked and crossed and recipe = work and y(marked and crossed and recipe = work)))))
			implies second(guidance) = TOGETHER)
	LTLSPEC ltlSpec_since:
		g(y(work = REST) and work = ALIGN or y(work = ALIGN) and work = LOWER implies second(guidance) != TOGETHER)
	CTLSPEC ctlSpec_together: ag(ef(guidance = (ALIGN, TOGETHER)) and ef(guidance = (LOWER, HIDDEN)))

	main rule r_Main =
		if isDef(recipe) and recipe != work then
			r_order[]
		else
			r_look[]
		endif

default init s0:
	function work = REST
	function right = 0
	function guidance = (REST, HIDDEN)
