asm Tank

import StandardLibrary

signature:
	enum domain Work = {RESTING | FILLING | DRAINING | ALARM}
	controlled work: Work
	monitored level: Integer
	monitored rise: Integer

definitions:
	rule r_tank =
		if work = RESTING then
			par
				if level < 5 then
					work := FILLING
				endif
				if level > 3 then
					work := DRAINING
				endif
				if level + rise > 100 and rise > 50 then
					work := ALARM
				endif
			endpar
		endif

	main rule r_Main =
		r_tank[]

default init s0:
	function work = RESTING
