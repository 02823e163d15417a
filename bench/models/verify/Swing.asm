/* The swinging buffer: a producer writes an array word by word and swaps it under the lock; a consumer takes the lock and
   copies the other array word by word. A step is one move of one of the two, chosen. */
asm Swing

import ../../../library/std/StandardLibrary

signature:
	enum domain Side = {PRODUCER | CONSUMER}
	enum domain Lock = {FREE | PRODUCING | CONSUMING}
	domain Place subsetof Integer
	domain Array subsetof Integer
	domain Word subsetof Integer
	domain Datum subsetof Integer

	controlled lock: Lock
	// the array that the producer writes
	controlled written: Array
	controlled buffer: Prod(Array, Word) -> Datum
	controlled place: Side -> Place
	controlled word: Side -> Word
	controlled datum: Datum
	controlled copy: Word -> Datum

definitions:
	domain Place = {0 : 3}
	domain Array = {0 : 1}
	domain Word = {0 : 1}
	domain Datum = {0 : 2}

	rule r_Produce =
		switch place(PRODUCER)
			case 0:
				par
					buffer(written, word(PRODUCER)) := datum
					word(PRODUCER) := (word(PRODUCER) + 1) mod 2
					if word(PRODUCER) = 1 then
						place(PRODUCER) := 1
					endif
				endpar
			case 1:
				if lock = FREE then
					par
						lock := PRODUCING
						place(PRODUCER) := 2
					endpar
				endif
			case 2:
				par
					written := 1 - written
					place(PRODUCER) := 3
				endpar
			case 3:
				par
					lock := FREE
					datum := (datum + 1) mod 3
					place(PRODUCER) := 0
				endpar
		endswitch

	rule r_Consume =
		switch place(CONSUMER)
			case 0:
				if lock = FREE then
					par
						lock := CONSUMING
						place(CONSUMER) := 1
					endpar
				endif
			case 1:
				par
					copy(word(CONSUMER)) := buffer(1 - written, word(CONSUMER))
					word(CONSUMER) := (word(CONSUMER) + 1) mod 2
					if word(CONSUMER) = 1 then
						place(CONSUMER) := 2
					endif
				endpar
			case 2:
				par
					lock := FREE
					place(CONSUMER) := 3
				endpar
			case 3:
				par
					forall $w in Word with true do copy($w) := 0
					place(CONSUMER) := 0
				endpar
		endswitch

	invariant inv_whole over copy: place(CONSUMER) >= 2 implies (forall $w in Word with copy($w) = copy(0))

	main rule r_Main =
		choose $side in Side with true do
			if $side = PRODUCER then
				r_Produce[]
			else
				r_Consume[]
			endif

default init s0:
	function lock = FREE
	function written = 0
	function buffer($a in Array, $w in Word) = 0
	function place($side in Side) = 0
	function word($side in Side) = 0
	function datum = 0
	function copy($w in Word) = 0
