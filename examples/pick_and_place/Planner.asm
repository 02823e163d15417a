/* Sends the robot one move after the other, so that parts come from the table into the row.

   It looks for a part until the images that were on their way while the arm was moving have passed. Each move is sent when the one
   before is done. If nothing is in the jaw after it went up, the jaw is opened, and the part is looked for again. */
asm Planner

import ../../library/std/StandardLibrary
import ../../library/std/CTLLibrary
import ../../library/std/LTLLibrary
import Placing

signature:
	enum domain Work = {LOOKING | WAITING}
	domain Images subsetof Integer
	domain Places subsetof Integer
	/* whether a part lies outside the row */
	monitored sight: Boolean
	monitored isNewSight: Boolean
	/* the last move that is done, and whether something is in the jaw */
	monitored progress: Prod(Number, Boolean)
	monitored isNewProgress: Boolean
	out moves: Prod(Number, Move)
	controlled work: Work
	/* the last move that was sent */
	controlled number: Number
	controlled move: Move
	/* how many images have come since the arm's last move */
	controlled images: Images
	/* how many parts are in the row */
	controlled placed: Places
	/* so many images may show the arm at its last move */
	static old: Images
	static places: Places
	derived isDone: Boolean

definitions:
	domain Images = {0 : 2}
	domain Places = {0 : 3}

	function old = 2
	function places = 3

	function isDone = work = WAITING and isNewProgress and first(progress) = number

	rule r_send($move in Move) =
		let ($number = (number + 1) mod 4) in
			par
				work := WAITING
				number := $number
				move := $move
				moves := ($number, $move)
			endpar
		endlet

	rule r_rest =
		par
			work := LOOKING
			images := 0
		endpar

	rule r_look =
		if isNewSight then
			if images < old then
				images := images + 1
			else
				if sight and placed < places then r_send[OVER] endif
			endif
		endif

	rule r_goOn =
		switch move
			case OVER: r_send[DOWN]
			case DOWN: r_send[CLOSE]
			case CLOSE: r_send[UP]
			case UP:
				if second(progress) then r_send[CARRY] else r_send[REOPEN] endif
			case CARRY: r_send[LOWER]
			case LOWER: r_send[OPEN]
			case OPEN: r_send[RISE]
			case RISE:
				par
					placed := placed + 1
					r_rest[]
				endpar
			case REOPEN: r_rest[]
		endswitch

	invariant inv_sent over moves: isDef(moves) implies first(moves) = number and second(moves) = move
	invariant inv_room over placed: work = WAITING implies placed < places

	/* whatever has happened, also after grips without a part, the row may be filled; then nothing moves any more */
	CTLSPEC ctlSpec_filled: ag(ef(placed = places))
	CTLSPEC ctlSpec_rest: ag(placed = places implies ag(work = LOOKING))

	/* another move is sent only if the one before is done, or none was waited for */
	LTLSPEC ltlSpec_oneMove:
		(forall $n in Number with
			g(y(number = $n) and number != $n implies y(work = LOOKING or isNewProgress and first(progress) = $n)))

	/* something was in the jaw when it went up, and has been carried since */
	LTLSPEC ltlSpec_held: g(move = CARRY implies s(move = CARRY, y(move = UP and isNewProgress and second(progress))))
	LTLSPEC ltlSpec_gripped: g(move = CLOSE implies s(move = CLOSE, y(move = DOWN)))
	LTLSPEC ltlSpec_lowered: g(move = OPEN implies s(move = OPEN, y(move = LOWER)))

	/* the part was seen in an image that does not show the arm at its last move */
	LTLSPEC ltlSpec_seen:
		g(
			work = WAITING and y(work = LOOKING)
			implies y(
				isNewSight
				and sight
				and y(
					s(
						work = LOOKING,
						work = LOOKING and isNewSight and y(s(work = LOOKING, work = LOOKING and isNewSight))))))

	main rule r_Main =
		if work = LOOKING then
			r_look[]
		else
			if isDone then r_goOn[] endif
		endif

default init s0:
	function work = LOOKING
	function number = 0
	function move = REOPEN
	function moves = (0, REOPEN)
	function images = 0
	function placed = 0
