/* A gate at a level crossing: it closes when a train comes and opens when the train is gone. Replace it with your machine. */
asm NAME

import StandardLibrary
import CTLLibrary

signature:
	enum domain GateState = {OPENED | CLOSING | CLOSED | OPENING}

	// What the machine sees: asked for in every step.
	monitored train: Boolean
	// the motor has come to its end
	monitored arrived: Boolean

	// What the machine keeps.
	controlled gate: GateState
	controlled closings: Integer

	derived mayPass: Boolean

definitions:
	// Cars may pass.
	function mayPass = gate = OPENED

	rule r_close =
		par
			gate := CLOSING
			// The count goes round, so that the machine has finitely many states.
			closings := (closings + 1) mod 10
		endpar

	invariant inv_closings over closings: closings >= 0 and closings < 10

	// The gate can always be opened again.
	CTLSPEC ctlSpec_opens: ag(ef(gate = OPENED))
	// It is never opened by the step that follows closing: it moves first.
	CTLSPEC ctlSpec_moves: ag(gate = CLOSED implies ax(gate != OPENED))

	main rule r_Main =
		switch gate
			case OPENED:
				if train then r_close[] endif
			case CLOSING:
				if arrived then gate := CLOSED endif
			case CLOSED:
				if not train then gate := OPENING endif
			case OPENING:
				if train then
					r_close[]
				else
					if arrived then gate := OPENED endif
				endif
		endswitch

default init s0:
	function gate = OPENED
	function closings = 0
