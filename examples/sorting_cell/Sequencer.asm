/* Follows the parcels along the belt, and orders the pushers to push.

   A parcel lies under the camera first. While it lies there, it is known by its number what reader and classifier say of it. When the
   belt moves, it is decided where the parcel goes; what is not known by then goes to the end of the belt. One place on is the left
   pusher, two places on the right one. */
asm Sequencer

import ../../library/std/StandardLibrary
import ../../library/std/CTLLibrary
import ../../library/std/LTLLibrary
import Parcels

signature:
	enum domain Mode = {RUNNING | STOPPED}
	monitored stop: Boolean
	monitored arrivals: Parcel
	monitored codes: Prod(Parcel, Bin)
	monitored classes: Prod(Parcel, Shape)
	monitored way: Way
	out leftOrders: Boolean
	out rightOrders: Boolean
	controlled mode: Mode
	/* the last numbers that were seen */
	controlled arrived: Parcel
	controlled come: Way
	/* the parcel under the camera, and what is known of it */
	controlled entering: Parcel
	controlled code: Bin
	controlled shape: Shape
	/* the parcel at the left pusher that goes to the right one */
	controlled following: Parcel
	/* the parcels that are pushed now */
	controlled pushedLeft: Parcel
	controlled pushedRight: Parcel
	derived moved: Boolean
	derived bin: Bin
	derived isLost: Boolean
	/* said of a parcel in this step: another bin; that it is damaged */
	derived isOther: Prod(Parcel, Bin) -> Boolean
	derived isDamaged: Parcel -> Boolean

definitions:
	function moved = isDef(way) and way != come

	function bin = if code = undef or shape != WHOLE then END else code endif

	/* a parcel that was not seen, a mark that was not seen, two parcels in one place: nobody knows any more what lies where */
	function isLost =
		(isDef(way) and way != come and way != (come + 1) mod 4)
		or (
			isDef(arrivals)
			and arrivals != arrived
			and (arrivals != (arrived + 1) mod 6 or (isDef(entering) and not moved)))

	function isOther($p in Parcel, $bin in Bin) = isDef(codes) and first(codes) = $p and second(codes) != $bin
	function isDamaged($p in Parcel) = isDef(classes) and first(classes) = $p and second(classes) = DAMAGED

	rule r_halt =
		par
			mode := STOPPED
			leftOrders := false
			rightOrders := false
			pushedLeft := undef
			pushedRight := undef
		endpar

	/* the belt has moved by one place */
	rule r_move =
		par
			come := way
			leftOrders := isDef(entering) and bin = LEFT
			pushedLeft := if isDef(entering) and bin = LEFT then entering else undef endif
			following := if isDef(entering) and bin = RIGHT then entering else undef endif
			rightOrders := isDef(following)
			pushedRight := following
		endpar

	rule r_rest =
		par
			leftOrders := false
			rightOrders := false
			pushedLeft := undef
			pushedRight := undef
		endpar

	/* what lies under the camera: another parcel, none, or the same, of which more may be known */
	rule r_look =
		if isDef(arrivals) and arrivals != arrived then
			par
				arrived := arrivals
				entering := arrivals
				code := undef
				shape := undef
			endpar
		else
			if moved then
				entering := undef
			else
				if isDef(entering) then
					par
						if isDef(codes) and first(codes) = entering then code := second(codes) endif
						if isDef(classes) and first(classes) = entering then shape := second(classes) endif
					endpar
				endif
			endif
		endif

	rule r_follow =
		if mode = RUNNING then
			if stop or isLost then
				r_halt[]
			else
				par
					if moved then r_move[] else r_rest[] endif
					r_look[]
				endpar
			endif
		endif

	invariant inv_orders over leftOrders, rightOrders:
		(leftOrders iff isDef(pushedLeft)) and (rightOrders iff isDef(pushedRight))
	invariant inv_oneBin over pushedLeft, pushedRight: not (isDef(pushedLeft) and pushedLeft = pushedRight)

	/* in the step that is told of the stop, and ever after */
	CTLSPEC ctlSpec_stopped: ag(stop implies ax(ag(not leftOrders and not rightOrders)))

	/* it runs on just as long as nothing is lost: the belt moves by one place at most, the next parcel comes, and only to a free place */
	LTLSPEC ltlSpec_begins: mode = RUNNING and arrived = 5 and come = 0
	CTLSPEC ctlSpec_counts:
		(forall $w in Way with ag(mode = RUNNING and way = $w implies ax(mode = RUNNING implies come = $w)))
	CTLSPEC ctlSpec_lostWay:
		(forall $w in Way with
			ag(come = $w and (way = ($w + 2) mod 4 or way = ($w + 3) mod 4) implies ax(mode = STOPPED)))
	CTLSPEC ctlSpec_lostParcel:
		(forall $p in Parcel with ag(arrived = $p and arrivals = ($p + 2) mod 6 implies ax(mode = STOPPED)))
	CTLSPEC ctlSpec_onePlace:
		ag(
			isDef(entering) and arrivals = (arrived + 1) mod 6 and (isUndef(way) or way = come)
			implies ax(mode = STOPPED))
	CTLSPEC ctlSpec_goesOn:
		ag(
			mode = RUNNING
				and not stop
				and (isUndef(way) or way = come or way = (come + 1) mod 4)
				and (
					isUndef(arrivals)
					or arrivals = arrived
					or arrivals = (arrived + 1) mod 6 and (isUndef(entering) or way = (come + 1) mod 4))
			implies ax(mode = RUNNING))

	/* unless it is stopped at once, each parcel may be pushed into each bin */
	CTLSPEC ctlSpec_pushed: not stop implies (forall $p in Parcel with ef(pushedLeft = $p) and ef(pushedRight = $p))

	/* since it came, a parcel that is pushed was not pushed before */
	LTLSPEC ltlSpec_once:
		(forall $p in Parcel with
			g(
				(pushedLeft = $p or pushedRight = $p)
				implies y(s(pushedLeft != $p and pushedRight != $p, entering = $p))))

	/* while it lay under the camera, the last that was said of it is that it goes there … */
	LTLSPEC ltlSpec_left:
		(forall $p in Parcel with
			g(
				pushedLeft = $p
				implies y(y(s(entering = $p and not isOther($p, LEFT), entering = $p and codes = ($p, LEFT))))))
	LTLSPEC ltlSpec_right:
		(forall $p in Parcel with
			g(
				pushedRight = $p
				implies s(
					entering != $p,
					following = $p
					and y(y(s(entering = $p and not isOther($p, RIGHT), entering = $p and codes = ($p, RIGHT)))))))

	/* … and that it is whole */
	LTLSPEC ltlSpec_whole:
		(forall $p in Parcel with
			g(
				pushedLeft = $p or following = $p and y(following != $p)
				implies y(y(s(entering = $p and not isDamaged($p), entering = $p and classes = ($p, WHOLE))))))

	/* a number comes again after five others, each of which came in a step of its own */
	LTLSPEC ltlSpec_apart:
		(forall $p in Parcel with
			g(
				arrived = $p and y(arrived != $p)
				implies not y(y(arrived = $p or y(arrived = $p or y(arrived = $p or y(arrived = $p)))))))

	/* the right pusher is one place on: what it pushes lay at the left one before */
	LTLSPEC ltlSpec_further: (forall $p in Parcel with g(pushedRight = $p implies y(following = $p)))

	main rule r_Main = r_follow[]

default init s0:
	function mode = RUNNING
	function arrived = 5
	function come = 0
	function leftOrders = false
	function rightOrders = false
