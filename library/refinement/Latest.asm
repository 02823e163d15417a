/* A shared value as its two sides see it: one writes what it likes, whenever it likes; the other begins to read, which gives what was
   written last, and ends.

   library/runtime/LatestValue refines it: there the same happens in accesses to words of memory. So does ManageAtOnce, a swinging buffer
   under a lock. */
asm Latest

import ../std/StandardLibrary

signature:
	domain Datum subsetof Integer

	controlled value: Datum
	controlled reading: Boolean
	// what was read last
	controlled got: Datum

definitions:
	domain Datum = {0 : 3}

	rule r_write =
		choose $new in Datum with $new != value do
			value := $new

	rule r_read =
		if reading then
			reading := false
		else
			par
				reading := true
				got := value
			endpar
		endif

	main rule r_Main =
		choose $writing in Boolean with true do
			if $writing then
				r_write[]
			else
				r_read[]
			endif

default init s0:
	function value = 0
	function reading = false
	function got = 0
