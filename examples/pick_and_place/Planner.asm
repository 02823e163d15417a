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

	/* the row begins empty; each part that was put down counts, and nothing else does */
	LTLSPEC ltlSpec_begins: work = LOOKING and placed = 0 and images = 0 and moves = (0, REOPEN)
	CTLSPEC ctlSpec_three: ef(placed = 3)
	LTLSPEC ltlSpec_counted:
		(forall $p in Places with
			g(
				y(placed = $p)
				implies (
					placed = $p and not y(move = RISE and work = WAITING and isNewProgress and first(progress) = number)
					or placed = $p + 1
						and y(move = RISE and work = WAITING and isNewProgress and first(progress) = number))))

	/* what is sent next is what the move before is for; without a part the jaw opens again */
	LTLSPEC ltlSpec_over: g(work = WAITING and y(work = LOOKING) implies move = OVER)
	LTLSPEC ltlSpec_follows:
		(forall $m in Move with
			g(
				y(move = $m and work = WAITING and isNewProgress and first(progress) = number)
				implies (
					$m = OVER and move = DOWN
					or $m = DOWN and move = CLOSE
					or $m = CLOSE and move = UP
					or $m = UP
						and (
							move = CARRY and y(isNewProgress and second(progress))
							or move = REOPEN and y(isNewProgress and not second(progress)))
					or $m = CARRY and move = LOWER
					or $m = LOWER and move = OPEN
					or $m = OPEN and move = RISE
					or ($m = RISE or $m = REOPEN) and work = LOOKING and images = 0)))

	/* the robot knows another move by its number, which is the next one */
	LTLSPEC ltlSpec_numbered:
		(forall $n in Number with
			g(
				y(number = $n and (work = LOOKING or work = WAITING and isNewProgress and first(progress) = $n))
					and work = WAITING
				implies number = ($n + 1) mod 4))

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
