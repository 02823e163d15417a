/* Writing to a swinging buffer as a master, as the pattern machine does it: a step that asks for the lock and is granted it, and a step
   that swaps the arrays and gives the lock back.

   `early` seeds a fault: the lock is given back before the arrays are swapped. */
asm ManageInTwo

import ../std/StandardLibrary

export *

signature:
	enum domain Who = {WRITER | READER}
	enum domain Place = {OUTSIDE | WRITING | MANAGING | SWAPPING}
	domain Array subsetof Integer
	domain Datum subsetof Integer

	// Configuration
	controlled early: Boolean

	controlled place: Place
	// who has the lock; undef when it is free
	controlled lock: Who
	controlled index: Array
	controlled content: Array -> Datum
	controlled got: Datum

	derived moves: Who -> Boolean

definitions:
	domain Array = {0 : 1}
	domain Datum = {0 : 2}

	function moves($w in Who) =
		if $w = WRITER then place != MANAGING or isUndef(lock) else isUndef(lock) or lock = READER endif

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
					if not early then
						lock := WRITER
					endif
					place := SWAPPING
				endpar
			case SWAPPING:
				par
					index := 1 - index
					if not early then
						lock := undef
					endif
					place := OUTSIDE
				endpar
		endswitch

	rule r_read =
		if lock = READER then
			par
				got := content(index)
				lock := undef
			endpar
		else
			lock := READER
		endif

	main rule r_Main =
		choose $who in Who with moves($who) do
			if $who = WRITER then
				r_write[]
			else
				r_read[]
			endif

default init s0:
	function early = false
	function place = OUTSIDE
	function index = 0
	function content($a in Array) = 0
	function got = 0
