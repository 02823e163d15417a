/* The swinging buffer of Swing.asm, with what is promised of its runs. The consumer reads again and again only if it gets
   the lock again and again when that is free again and again (strong fairness). Weak fairness does not give it that: the producer
   may hold the lock whenever the consumer looks, and the other way round. */
asm SwingLive

import ../../../library/std/StandardLibrary
import ../../../library/std/CTLLibrary
import ../../../library/std/LTLLibrary

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
	CTLSPEC ctlSpec_canRead: ag(ef(place(CONSUMER) = 3))
	CTLSPEC ctlSpec_excluded: ag(not (lock = PRODUCING and place(CONSUMER) = 1))
	CTLSPEC ctlSpec_reads: ag(af(place(CONSUMER) = 3))
	LTLSPEC ltlSpec_writes: g(f(place(PRODUCER) = 3))
	LTLSPEC ltlSpec_reads: g(f(place(CONSUMER) = 3))
	LTLSPEC ltlSpec_readsIfLetIn:
		(g(f(lock = FREE)) implies g(f(place(CONSUMER) = 1))) implies g(f(place(CONSUMER) = 3))
	LTLSPEC ltlSpec_readsWhatWasWritten: g(place(CONSUMER) = 3 and copy(0) != 0 implies o(place(PRODUCER) = 3))

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
