asm Known

import StandardLibrary

signature:
	monitored reading: Integer
	controlled seen: Integer
	controlled peak: Integer

definitions:
    invariant inv_peak over peak: peak >= 0
    invariant inv_small over seen: seen < 1000
	main rule r_Main =
		if peak < seen then
			if seen - peak > 100 then
				peak := peak + 100
			else
				peak := seen
			endif
		else
			seen := max(seen, reading)
		endif

default init s0:
	function seen = 0
	function peak = 0
