asm Hurried

import StandardLibrary

signature:
	monitored reading: Integer
	controlled seen: Integer
	controlled peak: Integer

definitions:
	main rule r_Main =
		if peak < seen then
			par
				peak := min(peak + 100, seen)
				if reading > peak then
					seen := reading
				endif
			endpar
		else
			seen := max(seen, reading)
		endif

default init s0:
	function seen = 0
	function peak = 0
