/* A producer and a consumer over a swinging buffer of two arrays of eight items: one is filled while the other is
   emptied; when both are done the arrays change places. The twin of ../native/producer_consumer.cpp, step by step. */
asm ProducerConsumer

import ../../library/std/StandardLibrary

signature:
	domain Array subsetof Integer
	domain Slot subsetof Integer
	enum domain Mode = {BUSY | DONE}

	controlled buffer: Prod(Array, Slot) -> Integer
	controlled producer: Mode
	controlled consumer: Mode
	// the array being filled
	controlled front: Array
	controlled written: Slot
	controlled taken: Slot
	controlled item: Integer
	controlled total: Integer
	controlled steps: Integer

definitions:
	domain Array = {0 : 1}
	domain Slot = {0 : 7}

	rule r_produce =
		if producer = BUSY then
			par
				buffer(front, written) := item
				item := (item * 5 + 3) mod 1000
				if written = 7 then
					par
						producer := DONE
						written := 0
					endpar
				else
					written := written + 1
				endif
			endpar
		endif

	rule r_consume =
		if consumer = BUSY then
			par
				total := (total + buffer(1 - front, taken)) mod 1000003
				if taken = 7 then
					par
						consumer := DONE
						taken := 0
					endpar
				else
					taken := taken + 1
				endif
			endpar
		endif

	rule r_swap =
		if producer = DONE and consumer = DONE then
			par
				front := 1 - front
				producer := BUSY
				consumer := BUSY
			endpar
		endif

	main rule r_Main =
		par
			r_produce[]
			r_consume[]
			r_swap[]
			steps := steps + 1
		endpar

default init s0:
	function buffer($a in Array, $s in Slot) = 0
	function producer = BUSY
	function consumer = DONE
	function front = 0
	function written = 0
	function taken = 0
	function item = 1
	function total = 0
	function steps = 0
