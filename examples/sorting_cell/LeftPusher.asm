/* Moves the left arm out for each order, and back in time. After an emergency stop it stays in. */
asm LeftPusher

import ../../library/std/StandardLibrary
import ../../library/std/CTLLibrary
import ../../library/std/LTLLibrary

signature:
	domain Cycles subsetof Integer
	monitored leftOrders: Boolean
	monitored isNewLeftOrders: Boolean
	monitored stop: Boolean
	out leftArm: Boolean
	controlled isHalted: Boolean
	/* how long the arm stays out */
	controlled remaining: Cycles
	static stroke: Cycles
	derived ordered: Boolean

definitions:
	domain Cycles = {0 : 5}

	function stroke = 5

	function ordered = isNewLeftOrders and leftOrders

	invariant inv_out over leftArm: remaining > 0 implies leftArm

	CTLSPEC ctlSpec_stopped: ag(stop implies ax(ag(not leftArm)))
	CTLSPEC ctlSpec_pushed: not stop implies ef(leftArm)

	/* it is out for as long as a stroke takes since the last new order */
	LTLSPEC ltlSpec_ordered: g(leftArm implies y(ordered or y(ordered or y(ordered or y(ordered or y(ordered))))))
	/* and stays out for that long, unless there was a stop */
	LTLSPEC ltlSpec_stays:
		g(not y(o(stop)) and y(ordered or y(ordered or y(ordered or y(ordered or y(ordered))))) implies leftArm)
	LTLSPEC ltlSpec_begins: not leftArm and remaining = 0

	main rule r_Main =
		if isHalted or stop then
			par
				isHalted := true
				remaining := 0
				leftArm := false
			endpar
		else
			if isNewLeftOrders and leftOrders then
				par
					remaining := stroke - 1
					leftArm := true
				endpar
			else
				if remaining > 0 then
					remaining := remaining - 1
				else
					leftArm := false
				endif
			endif
		endif

default init s0:
	function isHalted = false
	function remaining = 0
	function leftArm = false
