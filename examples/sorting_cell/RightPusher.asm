/* Moves the right arm out for each order, and back in time. After an emergency stop it stays in. */
asm RightPusher

import ../../library/std/StandardLibrary
import ../../library/std/CTLLibrary
import ../../library/std/LTLLibrary

signature:
	domain Cycles subsetof Integer
	monitored rightOrders: Boolean
	monitored isNewRightOrders: Boolean
	monitored stop: Boolean
	out rightArm: Boolean
	controlled isHalted: Boolean
	/* how long the arm stays out */
	controlled remaining: Cycles
	static stroke: Cycles
	derived ordered: Boolean

definitions:
	domain Cycles = {0 : 5}

	function stroke = 5

	function ordered = isNewRightOrders and rightOrders

	invariant inv_out over rightArm: remaining > 0 implies rightArm

	CTLSPEC ctlSpec_stopped: ag(stop implies ax(ag(not rightArm)))
	CTLSPEC ctlSpec_pushed: not stop implies ef(rightArm)

	/* it is out for as long as a stroke takes since the last new order */
	LTLSPEC ltlSpec_ordered: g(rightArm implies y(ordered or y(ordered or y(ordered or y(ordered or y(ordered))))))
	/* and stays out for that long, unless there was a stop */
	LTLSPEC ltlSpec_stays:
		g(not y(o(stop)) and y(ordered or y(ordered or y(ordered or y(ordered or y(ordered))))) implies rightArm)
	LTLSPEC ltlSpec_begins: not rightArm and remaining = 0

	main rule r_Main =
		if isHalted or stop then
			par
				isHalted := true
				remaining := 0
				rightArm := false
			endpar
		else
			if isNewRightOrders and rightOrders then
				par
					remaining := stroke - 1
					rightArm := true
				endpar
			else
				if remaining > 0 then
					remaining := remaining - 1
				else
					rightArm := false
				endif
			endif
		endif

default init s0:
	function isHalted = false
	function remaining = 0
	function rightArm = false
