asm Door
import StandardLibrary
signature:
	enum domain State = {OPEN | CLOSED | LOCKED}
	enum domain Wish = {PUSH | PULL}
	controlled door: State
	controlled rung: Integer
	monitored wish: Wish
definitions:
	main rule r_Main =
		if door = OPEN and wish = PUSH then
			door := CLOSED
		else
			if door = CLOSED and wish = PULL then
				door := OPEN
			else
				if door = LOCKED then
					rung := rung + 1
				endif
			endif
		endif
default init s0:
	function door = CLOSED
	function rung = 0
