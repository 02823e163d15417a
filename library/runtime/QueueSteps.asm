/* The message queue of the C++ runtime (cpp/include/groundstate/message_queue.hpp) with room for two, and the signals on
   which its sides sleep (signal.hpp): the sender when it is full, the receiver when it is empty.

   A step is one thing that a processor does indivisibly: the access to one word of a message, an atomic operation on
   `sent`, `taken`, the count of a signal or its sleeper; and the system's "sleep while the count is the one seen", which
   compares and falls asleep at once. Which side moves is chosen freely. What the memory orders of the program must add is
   argued at SYNC(sent), SYNC(taken) and SYNC(sleeper), and checked by ThreadSanitizer.

   `seeded` is the fault that the invariants find: a message counted before it is written, a side that looks for work before
   it takes the count of its signal, a side that looks for a sleeper before it raises the signal. */
asm QueueSteps

import ../std/StandardLibrary

export *

signature:
	enum domain Side = {SENDER | RECEIVER}
	enum domain Place = {
		OUTSIDE | COUNTING | LOOKING | ANNOUNCING | DOZING | ASLEEP | RETIRING | WORKING | PUBLISHING | RAISING |
		SEEING | WAKING}
	enum domain Fault = {NONE | PUBLISHES_FIRST | LOOKS_FIRST | SEES_FIRST}
	domain Count subsetof Integer
	domain Calls subsetof Integer
	domain Slot subsetof Integer
	domain Word subsetof Integer
	domain Datum subsetof Integer

	// Configuration
	controlled seeded: Fault

	// The program's: two counters, the slots, and a signal for each side: how often it was raised, whether somebody sleeps
	controlled sent: Count
	controlled taken: Count
	controlled content: Prod(Slot, Word) -> Datum
	controlled calls: Side -> Calls
	controlled announced: Side -> Boolean

	// What a side knows alone: the count that it saw, undef when it does not matter; how far it is
	controlled seen: Side -> Calls
	controlled place: Side -> Place
	controlled word: Side -> Word
	controlled read: Word -> Datum

	// What nobody in the program knows: the number of the next message, and of the one that has to come next
	controlled next: Datum
	controlled due: Datum

	static other: Side -> Side
	derived length: Integer
	derived ready: Side -> Boolean

definitions:
	// A multiple of the room, more than the room itself; the program's counters have 64 bits.
	domain Count = {0 : 3}
	// Three may come between the look at the count and the sleep: one for an earlier message, and two until the queue is
	// full, or empty. So this is the least; the program's has 32 bits.
	domain Calls = {0 : 3}
	domain Slot = {0 : 1}
	domain Word = {0 : 1}
	// one more than there are slots, so that no old message is mistaken for a new one
	domain Datum = {0 : 2}

	function length =
		(sent - taken + 4) mod 4

	function ready($s in Side) =
		if $s = SENDER then length != 2 else length != 0 endif

	function other($s in Side) =
		if $s = SENDER then RECEIVER else SENDER endif

	// There is something to do.
	rule r_begin($s in Side) =
		if $s = SENDER and seeded = PUBLISHES_FIRST then
			place($s) := PUBLISHING
		else
			place($s) := WORKING
		endif

	rule r_enter($s in Side) =
		if ready($s) then
			r_begin[$s]
		else
			if seeded = LOOKS_FIRST then
				place($s) := LOOKING
			else
				place($s) := COUNTING
			endif
		endif

	rule r_count($s in Side) =
		par
			seen($s) := calls($s)
			if seeded = LOOKS_FIRST then
				place($s) := ANNOUNCING
			else
				place($s) := LOOKING
			endif
		endpar

	// Nothing to do: a side may give up, its watchdog having ended.
	rule r_look($s in Side) =
		if ready($s) then
			par
				seen($s) := undef
				r_begin[$s]
			endpar
		else
			choose $late in Boolean with true do
				if $late then
					par
						seen($s) := undef
						place($s) := OUTSIDE
					endpar
				else
					if seeded = LOOKS_FIRST then
						place($s) := COUNTING
					else
						place($s) := ANNOUNCING
					endif
				endif
		endif

	rule r_announce($s in Side) =
		par
			announced($s) := true
			place($s) := DOZING
		endpar

	rule r_doze($s in Side) =
		par
			seen($s) := undef
			if calls($s) = seen($s) then
				place($s) := ASLEEP
			else
				place($s) := RETIRING
			endif
		endpar

	rule r_retire($s in Side) =
		par
			announced($s) := false
			if seeded = LOOKS_FIRST then
				place($s) := LOOKING
			else
				place($s) := COUNTING
			endif
		endpar

	// One word of the message is written, or read.
	rule r_work($s in Side) =
		par
			if $s = SENDER then
				if seeded = PUBLISHES_FIRST then
					content((sent + 3) mod 2, word($s)) := next
				else
					content(sent mod 2, word($s)) := next
				endif
			else
				read(word($s)) := content(taken mod 2, word($s))
			endif
			word($s) := 1 - word($s)
			if word($s) = 1 then
				if $s = SENDER and seeded = PUBLISHES_FIRST then
					r_finish[$s]
				else
					place($s) := PUBLISHING
				endif
			endif
		endpar

	rule r_finish($s in Side) =
		par
			if $s = SENDER then
				next := (next + 1) mod 3
			endif
			if seeded = SEES_FIRST then
				place($s) := SEEING
			else
				place($s) := RAISING
			endif
		endpar

	rule r_publish($s in Side) =
		if $s = RECEIVER then
			par
				taken := (taken + 1) mod 4
				due := (due + 1) mod 3
				r_finish[$s]
			endpar
		else
			par
				sent := (sent + 1) mod 4
				if seeded = PUBLISHES_FIRST then
					place($s) := WORKING
				else
					r_finish[$s]
				endif
			endpar
		endif

	rule r_raise($s in Side) =
		par
			calls(other($s)) := (calls(other($s)) + 1) mod 4
			if seeded = SEES_FIRST then
				place($s) := OUTSIDE
			else
				place($s) := SEEING
			endif
		endpar

	rule r_see($s in Side) =
		if announced(other($s)) then
			place($s) := WAKING
		else
			if seeded = SEES_FIRST then
				place($s) := RAISING
			else
				place($s) := OUTSIDE
			endif
		endif

	rule r_wake($s in Side) =
		par
			if place(other($s)) = ASLEEP then
				place(other($s)) := RETIRING
			endif
			if seeded = SEES_FIRST then
				place($s) := RAISING
			else
				place($s) := OUTSIDE
			endif
		endpar

	rule r_move($s in Side) =
		switch place($s)
			case OUTSIDE: r_enter[$s]
			case COUNTING: r_count[$s]
			case LOOKING: r_look[$s]
			case ANNOUNCING: r_announce[$s]
			case DOZING: r_doze[$s]
			case RETIRING: r_retire[$s]
			case WORKING: r_work[$s]
			case PUBLISHING: r_publish[$s]
			case RAISING: r_raise[$s]
			case SEEING: r_see[$s]
			case WAKING: r_wake[$s]
		endswitch

	invariant inv_bounds over sent, taken: length <= 2
	// each message comes once, in its order, and whole
	invariant inv_order over place, read: place(RECEIVER) = PUBLISHING implies (forall $w in Word with read($w) = due)
	// what a side saw before it began to work still holds: nobody else takes its message or its room away
	invariant inv_mine over place, sent, taken:
		seeded != PUBLISHES_FIRST implies (forall $s in Side with place($s) = WORKING implies ready($s))
	// no lost wake-up: while somebody sleeps who has something to do, the other is about to wake him
	invariant inv_noLostWakeUp over place, sent, taken:
		(forall $s in Side with
			(place($s) = ASLEEP and ready($s)) implies contains({RAISING, SEEING, WAKING}, place(other($s))))

	main rule r_Main =
		choose $side in Side with place($side) != ASLEEP do
			r_move[$side]

default init s0:
	function seeded = NONE
	function sent = 0
	function taken = 0
	function content($slot in Slot, $w in Word) = 0
	function calls($s in Side) = 0
	function announced($s in Side) = false
	function place($s in Side) = OUTSIDE
	function word($s in Side) = 0
	function read($w in Word) = 0
	function next = 0
	function due = 0
