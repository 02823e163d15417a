/* Orders one work after the other: align, and when the part lies right, lower. When the part is placed, or the stage has retracted, it is
   over. */
asm Supervisor

import ../../library/std/StandardLibrary
import ../../library/std/CTLLibrary
import ../../library/std/LTLLibrary
import Assembling

signature:
	enum domain Ending = {DONE | FAILED}
	monitored state: Progress
	out recipe: Work
	/* undef as long as it is not over */
	controlled ending: Ending

definitions:
	rule r_end($ending in Ending) =
		par
			ending := $ending
			recipe := REST
		endpar

	rule r_goOn =
		switch recipe
			case REST: recipe := ALIGN
			case ALIGN:
				if state = ALIGNED then recipe := LOWER endif
			case LOWER:
				if state = PLACED then r_end[DONE] endif
		endswitch

	/* it is over only when the part is placed or the stage has retracted; nothing is ordered any more then */
	invariant inv_rests over recipe, ending: isDef(ending) implies recipe = REST
	LTLSPEC ltlSpec_done: g(ending = DONE implies s(ending = DONE, y(recipe = LOWER and state = PLACED)))
	LTLSPEC ltlSpec_failed: g(ending = FAILED implies s(ending = FAILED, y(state = RETRACTED)))
	CTLSPEC ctlSpec_over: ag(isDef(ending) implies ag(recipe = REST))

	/* it begins at rest */
	LTLSPEC ltlSpec_begins: recipe = REST and isUndef(ending)

	/* the part is lowered only when it was told, while it was to be aligned, that it is */
	LTLSPEC ltlSpec_aligned: g(recipe = LOWER implies s(recipe = LOWER, y(recipe = ALIGN and state = ALIGNED)))
	/* the stage that has retracted is not driven on */
	CTLSPEC ctlSpec_retracted: ag(state = RETRACTED implies ax(recipe = REST))
	/* until it is over, both ends are open */
	CTLSPEC ctlSpec_ends:
		ag(isUndef(ending) and state != PLACED and state != RETRACTED implies ef(ending = DONE) and ef(ending = FAILED))

	main rule r_Main =
		if isUndef(ending) then
			if state = RETRACTED then r_end[FAILED] else r_goOn[] endif
		endif

default init s0:
	function recipe = REST
