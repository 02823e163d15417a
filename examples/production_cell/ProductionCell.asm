/* A production cell: a feed belt brings blanks, a robot with one arm puts them into a press and takes
   the forged plates out to the deposit belt. Each device is an agent and a control-state machine; all
   of them step at once. Two devices meet only at a place (belt end, press) that is full or empty, and
   each change of a place has one device responsible for it. */
asm ProductionCell

import ../../library/std/StandardLibrary

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

	main rule r_Main =
		forall $d in Device with true do program($d)

default init s0:
	function armState = AT_FEED
	function pressState = OPEN_EMPTY
	function forgingTicks = 0
	function blanksIn = 0
	function platesOut = 0
	agent Device: r_device[]
