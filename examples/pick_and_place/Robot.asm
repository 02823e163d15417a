/* Makes the moves that the planner sends, orders the jaw, and reports what is done.

   A move of the jaw is done when the gripper says so; any other one when the tool has arrived. */
asm Robot

import ../../library/std/StandardLibrary
import ../../library/std/CTLLibrary
import ../../library/std/LTLLibrary
import Placing

signature:
	monitored moves: Prod(Number, Move)
	monitored isNewMoves: Boolean
	monitored grip: Jaw
	/* the tool stands where the move is to bring it */
	monitored arrived: Boolean
	/* the jaw is to be closed */
	out jaw_order: Boolean
	out progress: Prod(Number, Boolean)
	controlled number: Number
	controlled move: Move
	derived isAnother: Boolean
	derived isDone: Boolean

definitions:
	function isAnother = isNewMoves and first(moves) != number

	function isDone =
		switch move
			case CLOSE: grip = EMPTY or grip = HOLDING
			case OPEN: grip = OPENED
			case REOPEN: grip = OPENED
			otherwise arrived
		endswitch

	rule r_begin =
		par
			number := first(moves)
			move := second(moves)
			if second(moves) = CLOSE then jaw_order := true endif
			if second(moves) = OPEN or second(moves) = REOPEN then jaw_order := false endif
		endpar

	invariant inv_closed over jaw_order: move = CLOSE implies jaw_order
	invariant inv_open over jaw_order: move = OPEN or move = REOPEN implies not jaw_order

	/* nothing but its own moves opens or closes the jaw */
	LTLSPEC ltlSpec_keeps: g(y(jaw_order) and not jaw_order implies move = OPEN or move = REOPEN)
	LTLSPEC ltlSpec_grips: g(y(not jaw_order) and jaw_order implies move = CLOSE)

	/* only what is done is reported as done, and what was in the jaw then */
	LTLSPEC ltlSpec_honest:
		(forall $n in Number with
			g(y(first(progress) != $n) and first(progress) = $n implies y(number = $n and isDone)))
	LTLSPEC ltlSpec_holds: g(y(not second(progress)) and second(progress) implies y(grip = HOLDING))

	/* each move may be done, whatever was before */
	CTLSPEC ctlSpec_done: ag((forall $n in Number with ef(first(progress) = $n)))

	/* the jaw has closed, with a part or without; it is open; the tool has arrived: then it is done, and reported */
	LTLSPEC ltlSpec_closed:
		(forall $n in Number with
			g(
				y(first(progress) != $n and move = CLOSE) and first(progress) = $n
				implies y(grip = EMPTY or grip = HOLDING)))
	LTLSPEC ltlSpec_opened:
		(forall $n in Number with
			g(
				y(first(progress) != $n and (move = OPEN or move = REOPEN)) and first(progress) = $n
				implies y(grip = OPENED)))
	LTLSPEC ltlSpec_arrived:
		(forall $n in Number with
			g(
				y(first(progress) != $n and move != CLOSE and move != OPEN and move != REOPEN) and first(progress) = $n
				implies y(arrived)))
	LTLSPEC ltlSpec_reports:
		(forall $n in Number with
			g(
				y(
					number = $n
					and not (isNewMoves and first(moves) != $n)
					and (
						move = CLOSE and (grip = EMPTY or grip = HOLDING)
						or (move = OPEN or move = REOPEN) and grip = OPENED
						or move != CLOSE and move != OPEN and move != REOPEN and arrived))
				implies first(progress) = $n and (second(progress) iff y(grip = HOLDING))))

	/* it begins as if the jaw had just been opened */
	LTLSPEC ltlSpec_begins: number = 0 and move = REOPEN and progress = (0, false)

	main rule r_Main =
		if isAnother then
			r_begin[]
		else
			if isDone then progress := (number, grip = HOLDING) endif
		endif

default init s0:
	function number = 0
	function move = REOPEN
	function jaw_order = false
	function progress = (0, false)
