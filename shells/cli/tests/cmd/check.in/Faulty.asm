asm Faulty

import StandardLibrary

signature:
	enum domain Colour = { RED | GREEN }
	controlled light: Colour
	monitored passed: Boolean

definitions:
	rule r_next = light := GREN

	main rule r_Main =
		par
			if light then r_next[] endif
			passed := true
			r_nxt[]
		endpar
