/* LatestValue with a fault that a refinement check must find, chosen by `--bound fault=…`: the producer forgets the mark, so nothing new
   ever comes; the consumer takes no array, but reads in the one between the two; the consumer takes the mark away and no array. */
asm LatestFaulty

import ../std/StandardLibrary
import ../runtime/LatestValue

signature:
	enum domain Fault = {UNMARKED | READS_BETWEEN | TAKES_NOTHING}
	monitored fault: Fault
	controlled seeded: Fault

definitions:
	rule r_faultyTake =
		par
			fresh := false
			due := newest
			place(CONSUMER) := READING
		endpar

	rule r_faultyRead =
		par
			seen(word(CONSUMER)) := content(between, word(CONSUMER))
			word(CONSUMER) := 1 - word(CONSUMER)
			if word(CONSUMER) = 1 then
				place(CONSUMER) := LOOKING
			endif
		endpar

	rule r_faultyHandOver =
		par
			written := between
			between := written
			newest := datum
			datum := (datum + 1) mod 4
			place(PRODUCER) := FILLING
		endpar

	main rule r_Main =
		choose $side in Side with true do
			if $side = PRODUCER then
				if seeded = UNMARKED and place(PRODUCER) = EXCHANGING then
					r_faultyHandOver[]
				else
					r_produce[]
				endif
			else
				if seeded = TAKES_NOTHING and place(CONSUMER) = EXCHANGING then
					r_faultyTake[]
				else
					if seeded = READS_BETWEEN and place(CONSUMER) = READING then
						r_faultyRead[]
					else
						r_consume[]
					endif
				endif
			endif

default init s0:
	function seeded = fault
	function atomic = true
	function between = 1
	function fresh = false
	function written = 0
	function held = 2
	function loaded = 1
	function content($a in Array, $w in Word) = 0
	function place($side in Side) = if $side = PRODUCER then FILLING else LOOKING endif
	function word($side in Side) = 0
	function datum = 1
	function seen($w in Word) = 0
	function newest = 0
	function due = 0
