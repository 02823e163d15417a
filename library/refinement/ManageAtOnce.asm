/* Writing to a swinging buffer as a master, as the paper's listing has it: the master writes, and then manages the buffer in one step,
   which takes the lock, swaps the arrays and gives the lock back. A slave reads under the same lock.

   It refines Latest, a shared value. ManageInTwo refines it: there the lock is asked for in one step, and used in the next. */
asm ManageAtOnce

import ../std/StandardLibrary

export *

signature:
	enum domain Who = {WRITER | READER}
	enum domain Place = {OUTSIDE | WRITING | MANAGING}
	domain Array subsetof Integer
	domain Datum subsetof Integer

	controlled place: Place
	controlled reading: Boolean
	controlled index: Array
	controlled content: Array -> Datum
	controlled got: Datum

	derived moves: Who -> Boolean

definitions:
	domain Array = {0 : 1}
	domain Datum = {0 : 2}

	function moves($w in Who) =
		if $w = WRITER then place != MANAGING or not reading else true endif

	rule r_write =
		switch place
			case OUTSIDE: place := WRITING
			case WRITING:
				par
					content(1 - index) := (content(index) + 1) mod 3
					place := MANAGING
				endpar
			case MANAGING:
				par
					index := 1 - index
					place := OUTSIDE
				endpar
		endswitch

	rule r_read =
		if reading then
			par
				got := content(index)
				reading := false
			endpar
		else
			reading := true
		endif

	main rule r_Main =
		choose $who in Who with moves($who) do
			if $who = WRITER then
				r_write[]
			else
				r_read[]
			endif

default init s0:
	function place = OUTSIDE
	function reading = false
	function index = 0
	function content($a in Array) = 0
	function got = 0
