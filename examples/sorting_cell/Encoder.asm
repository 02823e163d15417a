/* Counts the marks of the belt that pass its eye. */
asm Encoder

import ../../library/std/StandardLibrary
import ../../library/std/LTLLibrary
import Parcels

signature:
	monitored mark: Boolean
	out way: Way
	controlled wasMark: Boolean

definitions:
	/* a mark that comes is one place on, and nothing else is */
	LTLSPEC ltlSpec_counts: (forall $w in Way with g(y(way = $w and mark and not y(mark)) implies way = ($w + 1) mod 4))
	LTLSPEC ltlSpec_keeps: (forall $w in Way with g(y(way = $w and not (mark and not y(mark))) implies way = $w))
	LTLSPEC ltlSpec_begins: way = 0

	main rule r_Main =
		par
			wasMark := mark
			if mark and not wasMark then way := (way + 1) mod 4 endif
		endpar

default init s0:
	function way = 0
	function wasMark = false
