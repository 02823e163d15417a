/* ManageInTwo with a fault that a refinement check must find, chosen by `--bound fault=…`: the master writes in the array that is read,
   takes the lock without waiting for it, or the slave reads the other array. */
asm ManageFaulty

import ../std/StandardLibrary
import ManageInTwo

signature:
	enum domain Fault = {SAME_ARRAY | UNGRANTED | OTHER_ARRAY}
	monitored fault: Fault
	controlled seeded: Fault

definitions:
	rule r_faultyWrite =
		par
			content(index) := (content(index) + 1) mod 3
			place := MANAGING
		endpar

	rule r_faultyRead =
		par
			got := content(1 - index)
			lock := undef
		endpar

	main rule r_Main =
		choose $who in Who with moves($who) or (seeded = UNGRANTED and $who = WRITER) do
			if $who = WRITER then
				if seeded = SAME_ARRAY and place = WRITING then
					r_faultyWrite[]
				else
					r_write[]
				endif
			else
				if seeded = OTHER_ARRAY and lock = READER then
					r_faultyRead[]
				else
					r_read[]
				endif
			endif

default init s0:
	function seeded = fault
	function early = false
	function place = OUTSIDE
	function index = 0
	function content($a in Array) = 0
	function got = 0
