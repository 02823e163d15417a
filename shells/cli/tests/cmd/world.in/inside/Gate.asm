asm Gate

import StandardLibrary
import ../Shared

signature:

definitions:
	main rule r_open = opened := true

default init s0:
	function opened = false
