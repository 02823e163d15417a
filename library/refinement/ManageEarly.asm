/* ManageInTwo with a fault that a refinement check must find: the lock is given back before the arrays are swapped. */
asm ManageEarly

import ../std/StandardLibrary
import ManageInTwo

signature:

definitions:
	main rule r_Main =
		choose $who in Who with moves($who) do
			if $who = WRITER then
				r_write[]
			else
				r_read[]
			endif

default init s0:
	function early = true
	function place = OUTSIDE
	function index = 0
	function content($a in Array) = 0
	function got = 0
