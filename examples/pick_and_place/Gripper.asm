/* Moves the jaw as it is ordered, and says how far it is, and whether it holds something. */
asm Gripper

import ../../library/std/StandardLibrary
import ../../library/std/CTLLibrary
import ../../library/std/LTLLibrary
import Placing

signature:
	/* the jaw is to be closed */
	monitored jaw_order: Boolean
	monitored isNewJaw_order: Boolean
	monitored jaw: Feel
	/* air that closes the jaw */
	out valve: Boolean
	out grip: Jaw

definitions:
	rule r_feel =
		if valve then
			switch jaw
				case AROUND: grip := HOLDING
				case SHUT: grip := EMPTY
				otherwise grip := BUSY
			endswitch
		else
			grip := if jaw = WIDE then OPENED else BUSY endif
		endif

	invariant inv_holds over grip, valve: grip = HOLDING or grip = EMPTY implies valve
	invariant inv_opened over grip, valve: grip = OPENED implies not valve

	/* what is said was felt, and the jaw was not ordered otherwise then */
	LTLSPEC ltlSpec_felt:
		g(
			(grip = HOLDING implies y(jaw = AROUND and valve))
			and (grip = EMPTY implies y(jaw = SHUT and valve))
			and (grip = OPENED implies y(jaw = WIDE and not valve)))
	/* the jaw goes where it is ordered, and stays */
	LTLSPEC ltlSpec_obeys: g(valve implies s(y(not isNewJaw_order or jaw_order), y(isNewJaw_order and jaw_order)))
	LTLSPEC ltlSpec_opens: g(y(isNewJaw_order and not jaw_order) implies not valve)
	CTLSPEC ctlSpec_held: ag(ef(grip = HOLDING) and ef(grip = EMPTY) and ef(grip = OPENED))

	main rule r_Main =
		if isNewJaw_order and jaw_order != valve then
			par
				valve := jaw_order
				grip := BUSY
			endpar
		else
			r_feel[]
		endif

default init s0:
	function valve = false
	function grip = BUSY
