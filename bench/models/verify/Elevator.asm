/* Two lifts in a house of three floors, after the LIFT of E. Börger and R. Stärk, Abstract State Machines, 2003,
   section 2.3. A lift goes on in its direction while somebody there has called it or wants to get off, then turns.
   Calls from a floor are for both lifts, wishes in a cabin for that lift. A lift opens its door only where it stops. A
   step is a push of a button or one move of one lift.
   Seeded fault: r_Move does not close the door. It violates inv_door after 4 steps. */
asm Elevator

import ../../../library/std/StandardLibrary

signature:
	enum domain Lift = {LEFT | RIGHT}
	enum domain Direction = {UP | DOWN}
	domain Floor subsetof Integer
	enum domain Action = {CALL | WISH | MOVE}

	controlled floor: Lift -> Floor
	controlled direction: Lift -> Direction
	controlled moving: Lift -> Boolean
	controlled open: Lift -> Boolean
	// somebody on the floor wants to go there
	controlled called: Prod(Floor, Direction) -> Boolean
	// somebody in the cabin wants to get off
	controlled wished: Prod(Lift, Floor) -> Boolean

	static top: Integer
	static opposite: Direction -> Direction
	// lies that way from the first floor
	static lies: Prod(Floor, Direction, Floor) -> Boolean
	derived attracted: Prod(Lift, Direction) -> Boolean
	derived stopsHere: Lift -> Boolean

definitions:
	domain Floor = {0 : 2}

	function top = 2
	function opposite($d in Direction) = if $d = UP then DOWN else UP endif
	function lies($from in Floor, $d in Direction, $to in Floor) = if $d = UP then $to > $from else $to < $from endif
	function attracted($l in Lift, $d in Direction) =
		(exists $f in Floor with lies(floor($l), $d, $f) and (wished($l, $f) or called($f, UP) or called($f, DOWN)))
	function stopsHere($l in Lift) = wished($l, floor($l)) or called(floor($l), direction($l))

	rule r_Call =
		choose $f in Floor, $d in Direction with $d = UP and $f < top or $d = DOWN and $f > 0 do
			called($f, $d) := true

	rule r_Wish =
		choose $l in Lift, $f in Floor with true do wished($l, $f) := true

	rule r_Travel($l in Lift) =
		if stopsHere($l) or not attracted($l, direction($l)) then
			moving($l) := false
		else
			floor($l) := if direction($l) = UP then floor($l) + 1 else floor($l) - 1 endif
		endif

	rule r_OpenDoor($l in Lift) =
		par
			open($l) := true
			wished($l, floor($l)) := false
			called(floor($l), direction($l)) := false
		endpar

	rule r_Halt($l in Lift) =
		if stopsHere($l) then
			r_OpenDoor[$l]
		else
			if attracted($l, direction($l)) then
				moving($l) := true
			else
				if attracted($l, opposite(direction($l))) or called(floor($l), opposite(direction($l))) then
					direction($l) := opposite(direction($l))
				endif
			endif
		endif

	rule r_Move($l in Lift) =
		if moving($l) then
			r_Travel[$l]
		else
			if open($l) then
				open($l) := false
			else
				r_Halt[$l]
			endif
		endif

	invariant inv_door over open: (forall $l in Lift with not (open($l) and moving($l)))
	// Beyond the last floor nobody calls.
	invariant inv_calls over called: not called(top, UP) and not called(0, DOWN)

	main rule r_Main =
		choose $action in Action with true do
			switch $action
				case CALL: r_Call[]
				case WISH: r_Wish[]
				case MOVE:
					choose $l in Lift with true do r_Move[$l]
			endswitch

default init s0:
	function floor($l in Lift) = 0
	function direction($l in Lift) = UP
	function moving($l in Lift) = false
	function open($l in Lift) = false
	function called($f in Floor, $d in Direction) = false
	function wished($l in Lift, $f in Floor) = false
