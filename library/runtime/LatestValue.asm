/* The wait-free swinging buffer of the C++ runtime (cpp/include/groundstate/wait_free_buffer.hpp), N = 3: what
   makes it safe is that every array has one holder at any moment, whatever the interleaving.

   A step is one thing that a processor does indivisibly: an atomic operation on the word `between_` (an array and
   the mark that its datum is new), or the access to one word of the array that a side holds. Which side moves is
   chosen freely. What the memory orders of the program must add, that an array's words are seen as they were
   written when it changes hands, is argued at SYNC(exchange) and checked by ThreadSanitizer.

   With `atomic` false the producer's exchange falls apart into a load and a store: the fault that the invariants
   find. */
asm LatestValue

import ../std/StandardLibrary

export *

signature:
	enum domain Side = {PRODUCER | CONSUMER}
	enum domain Place = {FILLING | EXCHANGING | STORING | LOOKING | READING}
	domain Array subsetof Integer
	domain Word subsetof Integer
	domain Datum subsetof Integer

	// Configuration
	controlled atomic: Boolean

	// The program's: one atomic word, and what each side knows alone
	controlled between: Array
	controlled fresh: Boolean
	controlled written: Array
	controlled held: Array
	// what the producer loaded, in an exchange that is not atomic
	controlled loaded: Array
	controlled content: Prod(Array, Word) -> Datum

	// How far each side is
	controlled place: Side -> Place
	controlled word: Side -> Word
	// what the producer writes, and what the consumer has seen
	controlled datum: Datum
	controlled seen: Word -> Datum

	// What nobody in the program knows: the newest datum handed over, and the one that this reading has to give
	controlled newest: Datum
	controlled due: Datum

	derived oneHolder: Boolean

definitions:
	domain Array = {0 : 2}
	domain Word = {0 : 1}
	// one more than there are arrays, so that no old datum is mistaken for a new one
	domain Datum = {0 : 3}

	function oneHolder =
		written != held and written != between and held != between

	rule r_fill =
		par
			content(written, word(PRODUCER)) := datum
			word(PRODUCER) := 1 - word(PRODUCER)
			if word(PRODUCER) = 1 then
				place(PRODUCER) := EXCHANGING
			endif
		endpar

	rule r_handOver =
		par
			between := written
			fresh := true
			newest := datum
			datum := (datum + 1) mod 4
			place(PRODUCER) := FILLING
		endpar

	rule r_produce =
		switch place(PRODUCER)
			case FILLING: r_fill[]
			case EXCHANGING:
				if atomic then
					par
						written := between
						r_handOver[]
					endpar
				else
					par
						loaded := between
						place(PRODUCER) := STORING
					endpar
				endif
			case STORING:
				par
					written := loaded
					r_handOver[]
				endpar
		endswitch

	rule r_look =
		if fresh then
			place(CONSUMER) := EXCHANGING
		else
			place(CONSUMER) := READING
		endif

	rule r_take =
		par
			held := between
			between := held
			fresh := false
			due := newest
			place(CONSUMER) := READING
		endpar

	rule r_read =
		par
			seen(word(CONSUMER)) := content(held, word(CONSUMER))
			word(CONSUMER) := 1 - word(CONSUMER)
			if word(CONSUMER) = 1 then
				place(CONSUMER) := LOOKING
			endif
		endpar

	rule r_consume =
		switch place(CONSUMER)
			case LOOKING: r_look[]
			case EXCHANGING: r_take[]
			case READING: r_read[]
		endswitch

	invariant inv_oneHolder over between, written, held: oneHolder
	// a reading is whole, and gives the newest datum handed over when it began
	invariant inv_newest over seen: place(CONSUMER) = LOOKING implies (forall $w in Word with seen($w) = due)
	// the newest datum is never lost: it lies between the two, or the consumer has it
	invariant inv_kept over content:
		(forall $w in Word with content((if fresh then between else held endif), $w) = newest)
	// nobody but the consumer takes the mark away, so what it saw still holds at its exchange
	invariant inv_marked over fresh: place(CONSUMER) = EXCHANGING implies fresh

	main rule r_Main =
		choose $side in Side with true do
			if $side = PRODUCER then
				r_produce[]
			else
				r_consume[]
			endif

default init s0:
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
