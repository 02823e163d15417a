/* ManageAtOnce with a fault that a refinement check must find, chosen by `--bound fault=…`: the master writes in the array that is read,
   swaps the arrays while the slave reads, or the slave reads the other array. */
asm SwingFaulty

import ../std/StandardLibrary
import ManageAtOnce

signature:
	enum domain Fault = {SAME_ARRAY | UNLOCKED | OTHER_ARRAY}
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
			reading := false
		endpar

	main rule r_Main =
		choose $who in Who with moves($who) or seeded = UNLOCKED do
			if $who = WRITER then
				if seeded = SAME_ARRAY and place = WRITING then
					r_faultyWrite[]
				else
					r_write[]
				endif
			else
				if seeded = OTHER_ARRAY and reading then
					r_faultyRead[]
				else
					r_read[]
				endif
			endif

default init s0:
	function seeded = fault
	function place = OUTSIDE
	function reading = false
	function index = 0
	function content($a in Array) = 0
	function got = 0
