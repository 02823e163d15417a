/* Tells the motor when a new sighting is far off: the machine of the dock's logger, one of two readers of both channels. */
asm Logger

import StandardLibrary

signature:
	monitored sighting: Integer
	monitored isNewSighting: Boolean
	monitored aim: Integer
	out alarm: Boolean

definitions:
	main rule r_Main = alarm := isNewSighting and sighting > 6 and isDef(aim)

default init s0:
	function alarm = false
