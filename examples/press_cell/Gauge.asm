/* Says how high the press stands. */
asm Gauge

import ../../library/std/StandardLibrary
import PressData

signature:
	monitored height: Position
	out position: Position

definitions:
	main rule r_Main = position := height

default init s0:
	function position = BETWEEN
