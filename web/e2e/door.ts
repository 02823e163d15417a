// A door as a chart, and a model of it that has a choice and an invariant that breaks: what several tests check.

export const DOOR = `chart Door

machine door "Door"
	control door
	initial state shut "Shut"
	state ajar "Ajar"
	state open "Open"
	guard pushed "Pushed"
	shut -> pushed yes -> ajar
	ajar -> open
	open -> pushed
	pushed no -> shut
endmachine
`

// The model is not the one that the chart would be built to: this one has a choice, and an invariant that breaks.
export const MODEL = `asm Door
import StandardLibrary
signature:
	enum domain DoorState = { SHUT | AJAR | OPEN }
	domain Force subsetof Integer
	controlled door: DoorState
	controlled force: Force
	monitored pushed: Boolean
definitions:
	domain Force = { 0 : 4 }
	invariant inv_gentle over force: force < 3
	main rule r_Main =
		switch door
			case SHUT: if pushed then door := AJAR endif
			case AJAR:
				choose $f in { 1, 2 } with force + $f <= 4 do
					par
						force := force + $f
						door := OPEN
					endpar
			case OPEN: door := AJAR
		endswitch
default init s0:
	function door = SHUT
	function force = 0
`
