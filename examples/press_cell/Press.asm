/* The controller of the press. Its machine is drawn in Press.chart; `chart build` writes the rule r_press and the control states. */
asm Press

import ../../library/std/StandardLibrary
import ../../library/std/CTLLibrary
import ../../library/std/LTLLibrary
import PressData

signature:
	monitored start: Boolean
	monitored curtain: Boolean
	monitored acknowledge: Boolean
	monitored position: Position
	monitored isNewPosition: Boolean
	out lamp: Boolean
	out command: Command
	/* the last stroke has come to its end */
	controlled done: Boolean

	// the control states
	enum domain ModeState = {IDLE | LOWERING | RAISING | STOPPED}

	controlled mode: ModeState

	// where Working was left
	controlled workingLeft: ModeState

definitions:
	/* the lamp says that it works */
	invariant inv_moves over mode, lamp: lamp = (mode = LOWERING or mode = RAISING)

	/* the last stroke is done just as long as no other one has begun */
	invariant inv_done over mode, done: done iff mode = IDLE

	/* a broken curtain stops it in the next step, from any state in which it works */
	CTLSPEC ctlSpec_still: ag(curtain implies ax(command = HOLD and not lamp))

	/* after that it goes on where it was */
	LTLSPEC ltlSpec_lowersOn: g(mode = LOWERING and y(mode = STOPPED) implies y(s(mode = STOPPED, mode = LOWERING)))
	LTLSPEC ltlSpec_raisesOn: g(mode = RAISING and y(mode = STOPPED) implies y(s(mode = STOPPED, mode = RAISING)))

	/* whatever has happened, a stroke can be finished, and another one goes down */
	CTLSPEC ctlSpec_finishes: ag(ef(done and mode = IDLE))
	CTLSPEC ctlSpec_lowers: ag(ef(command = LOWER))

	/* it comes up only if it was down since it began */
	LTLSPEC ltlSpec_down: g(mode = RAISING implies o(isNewPosition and position = LOW))

	/* a stroke begins, turns, ends and goes on when it is told so, and only then */
	LTLSPEC ltlSpec_begins: mode = IDLE and command = HOLD
	LTLSPEC ltlSpec_idle:
		g(y(mode = IDLE) implies if y(start and not curtain) then mode = LOWERING else mode = IDLE endif)
	LTLSPEC ltlSpec_lowering:
		g(
			y(mode = LOWERING and not curtain)
			implies if y(isNewPosition and position = LOW) then mode = RAISING else mode = LOWERING endif)
	LTLSPEC ltlSpec_raising:
		g(
			y(mode = RAISING and not curtain)
			implies if y(isNewPosition and position = HIGH) then mode = IDLE else mode = RAISING endif)
	LTLSPEC ltlSpec_stops: g(y((mode = LOWERING or mode = RAISING) and curtain) implies mode = STOPPED)
	LTLSPEC ltlSpec_goesOn: g(y(mode = STOPPED) implies (mode = STOPPED iff y(curtain or not acknowledge)))

	/* the drive does in the next cycle what the machine is in now */
	LTLSPEC ltlSpec_drive:
		g(
			(y(mode = LOWERING and not curtain) implies command = LOWER)
			and (y(mode = RAISING and not curtain) implies command = RAISE)
			and (y(mode = IDLE or mode = STOPPED) implies command = HOLD))

	// Press controller
	rule r_press =
		par
			// Idle
			if mode = IDLE then
				if start and not curtain then
					par
						done := false
						lamp := true
						mode := LOWERING
					endpar
				endif
			endif
			// Lowering
			if mode = LOWERING then
				if curtain then
					par
						lamp := false
						workingLeft := LOWERING
						mode := STOPPED
					endpar
				else
					if isNewPosition and position = LOW then
						mode := RAISING
					endif
				endif
			endif
			// Raising
			if mode = RAISING then
				if curtain then
					par
						lamp := false
						workingLeft := RAISING
						mode := STOPPED
					endpar
				else
					if isNewPosition and position = HIGH then
						par
							done := true
							lamp := false
							workingLeft := RAISING
							mode := IDLE
						endpar
					endif
				endif
			endif
			// Stopped
			if mode = STOPPED then
				if acknowledge and not curtain then
					if workingLeft = RAISING then
						par
							lamp := true
							mode := RAISING
						endpar
					else
						par
							lamp := true
							mode := LOWERING
						endpar
					endif
				endif
			endif
		endpar

	/* what the drive has to do now */
	rule r_drive =
		if curtain or mode = IDLE or mode = STOPPED then
			command := HOLD
		else
			if mode = LOWERING then command := LOWER else command := RAISE endif
		endif

	main rule r_Main =
		par
			r_press[]
			r_drive[]
		endpar

default init s0:
	function mode = IDLE
	function lamp = false
	function command = HOLD
	function done = true
