/* A production cell: a feed belt brings blanks, a robot with one arm puts them into a press and takes
   the forged plates out to the deposit belt. Each device is an agent and a control-state machine; all
   of them step at once. Two devices meet only at a place (belt end, press) that is full or empty, and
   each change of a place has one device responsible for it. */
asm ProductionCell

import ../../library/std/StandardLibrary
import ../../library/std/CTLLibrary
import ../../library/std/LTLLibrary

signature:
	domain Device subsetof Agent
	static feedBelt: Device
	static robot: Device
	static press: Device
	static depositBelt: Device

	enum domain ArmState = {AT_FEED | TO_PRESS_FULL | AT_PRESS | TO_DEPOSIT_FULL}
	enum domain PressState = {OPEN_EMPTY | CLOSING | FORGING | OPENING | OPEN_FORGED}
	enum domain Item = {BLANK | PLATE}

	// a new blank lies at the start of the feed belt
	monitored blankArrives: Boolean
	static forgingTime: Integer

	controlled feedEnd: Item
	controlled inArm: Item
	controlled inPress: Item
	controlled depositStart: Item
	controlled armState: ArmState
	controlled pressState: PressState
	controlled forgingTicks: Integer
	controlled blanksIn: Integer
	controlled platesOut: Integer

	static occupied: Item -> Integer
	derived inCell: Integer

definitions:
	function forgingTime = 3

	function occupied($x in Item) = if isDef($x) then 1 else 0 endif

	function inCell =
		occupied(feedEnd) + occupied(inArm) + occupied(inPress) + occupied(depositStart)

	// The belt moves on only when its end is free: no blank falls down.
	rule r_feed =
		if isUndef(feedEnd) and blankArrives then
			par
				feedEnd := BLANK
				blanksIn := blanksIn + 1
			endpar
		endif

	rule r_pickBlank =
		par
			inArm := BLANK
			feedEnd := undef
			armState := TO_PRESS_FULL
		endpar

	rule r_loadPress =
		par
			inPress := BLANK
			inArm := undef
			pressState := CLOSING
			armState := AT_PRESS
		endpar

	rule r_unloadPress =
		par
			inArm := PLATE
			inPress := undef
			pressState := OPEN_EMPTY
			armState := TO_DEPOSIT_FULL
		endpar

	rule r_putPlate =
		par
			depositStart := PLATE
			inArm := undef
			armState := AT_FEED
		endpar

	// While the press is open it belongs to the robot, else to the press.
	rule r_robot =
		switch armState
			case AT_FEED:
				if feedEnd = BLANK then r_pickBlank[] endif
			case TO_PRESS_FULL:
				if pressState = OPEN_EMPTY then r_loadPress[] endif
			case AT_PRESS:
				if pressState = OPEN_FORGED then r_unloadPress[] endif
			case TO_DEPOSIT_FULL:
				if isUndef(depositStart) then r_putPlate[] endif
		endswitch

	rule r_press =
		switch pressState
			case CLOSING:
				par
					pressState := FORGING
					forgingTicks := 0
				endpar
			case FORGING:
				if forgingTicks + 1 >= forgingTime then
					par
						pressState := OPENING
						inPress := PLATE
					endpar
				else
					forgingTicks := forgingTicks + 1
				endif
			case OPENING:
				pressState := OPEN_FORGED
		endswitch

	rule r_deposit =
		if depositStart = PLATE then
			par
				depositStart := undef
				platesOut := platesOut + 1
			endpar
		endif

	rule r_device =
		switch self
			case feedBelt: r_feed[]
			case robot: r_robot[]
			case press: r_press[]
			case depositBelt: r_deposit[]
		endswitch

	// no blank is lost and none is made
	invariant inv_conservation over blanksIn, platesOut: blanksIn = platesOut + inCell
	// the press closes on a blank only
	invariant inv_press over pressState: (pressState = FORGING or pressState = CLOSING) implies inPress = BLANK
	invariant inv_deposit over depositStart: depositStart != BLANK

	// it begins empty, and whatever comes goes out as a plate
	LTLSPEC ltlSpec_begins:
		inCell = 0 and blanksIn = 0 and forgingTicks = 0 and armState = AT_FEED and pressState = OPEN_EMPTY
	CTLSPEC ctlSpec_plates: ag(ef(blanksIn = 3 and platesOut = 3))

	// a blank that arrives is taken where nothing lies
	LTLSPEC ltlSpec_feeds: g(y(isUndef(feedEnd)) implies (feedEnd = BLANK iff y(blankArrives)))
	LTLSPEC ltlSpec_waits: g(y(feedEnd = BLANK and armState != AT_FEED) implies feedEnd = BLANK)

	// the robot goes on when there is something to take; where it puts something, there is always room
	LTLSPEC ltlSpec_picks:
		g(
			y(armState = AT_FEED)
			implies if y(feedEnd = BLANK) then
				armState = TO_PRESS_FULL and inArm = BLANK and isUndef(feedEnd)
			else
				armState = AT_FEED
			endif)
	LTLSPEC ltlSpec_loads:
		g(
			y(armState = TO_PRESS_FULL)
			implies armState = AT_PRESS and isUndef(inArm) and inPress = BLANK and pressState = CLOSING)
	LTLSPEC ltlSpec_unloads:
		g(
			y(armState = AT_PRESS)
			implies if y(pressState = OPEN_FORGED) then
				armState = TO_DEPOSIT_FULL and inArm = PLATE and isUndef(inPress) and pressState = OPEN_EMPTY
			else
				armState = AT_PRESS
			endif)
	LTLSPEC ltlSpec_puts:
		g(y(armState = TO_DEPOSIT_FULL) implies armState = AT_FEED and isUndef(inArm) and depositStart = PLATE)
	LTLSPEC ltlSpec_takesAway: g(y(depositStart = PLATE) implies isUndef(depositStart))

	// a blank is forged for three steps; then the press opens on a plate
	LTLSPEC ltlSpec_closes: g(y(pressState = CLOSING) implies pressState = FORGING)
	LTLSPEC ltlSpec_forges:
		g(
			y(pressState = FORGING)
			implies if y(y(pressState = FORGING and y(pressState = FORGING))) then
				pressState = OPENING
			else
				pressState = FORGING
			endif)
	LTLSPEC ltlSpec_opens: g(y(pressState = OPENING) implies pressState = OPEN_FORGED and inPress = PLATE)

	main rule r_Main =
		forall $d in Device with true do program($d)

default init s0:
	function armState = AT_FEED
	function pressState = OPEN_EMPTY
	function forgingTicks = 0
	function blanksIn = 0
	function platesOut = 0
	agent Device: r_device[]
