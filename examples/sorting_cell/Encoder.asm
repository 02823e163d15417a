/* Counts the marks of the belt that pass its eye. */
asm Encoder

import ../../library/std/StandardLibrary
import Parcels

signature:
	monitored mark: Boolean
	out way: Way
	controlled wasMark: Boolean

definitions:
	main rule r_Main =
		par
			wasMark := mark
			if mark and not wasMark then way := (way + 1) mod 4 endif
		endpar

default init s0:
	function way = 0
	function wasMark = false
