/* Aims at what was sighted, and counts how often nothing new was: the machine of the dock's tracker. */
asm Tracker

import StandardLibrary

signature:
	monitored sighting: Integer
	monitored isNewSighting: Boolean
	out aim: Integer
	controlled misses: Integer

definitions:
	main rule r_Main =
		if isNewSighting then
			par
				aim := sighting * 2
				misses := 0
			endpar
		else
			misses := min(misses + 1, 5)
		endif

default init s0:
	function aim = 0
	function misses = 0
