/* Says how high the press stands. */
asm Gauge

import ../../library/std/StandardLibrary
import ../../library/std/LTLLibrary
import PressData

signature:
	monitored height: Position
	out position: Position

definitions:
	/* it says what it sees, and takes nothing for an end before it has looked */
	LTLSPEC ltlSpec_says: (forall $p in Position with g(y(height = $p) implies position = $p))
	LTLSPEC ltlSpec_begins: position = BETWEEN

	main rule r_Main = position := height

default init s0:
	function position = BETWEEN
