asm Free

import StandardLibrary

signature:
	domain Level subsetof Integer
	monitored inflow: Integer
	monitored open: Boolean
	controlled level: Level
	controlled alarm: Boolean

definitions:
	domain Level = {0 : 10}

	invariant inv_alarm over alarm: alarm implies level > 5

	main rule r_Main =
		par
			if open then
				level := max(level - 2, 0)
			else
				level := level + inflow
			endif
			alarm := level > 8
			if level > 100 then
				alarm := false
			endif
		endpar

default init s0:
	function level = 0
	function alarm = false
