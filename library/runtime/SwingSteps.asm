/* The swinging buffer under a lock of the C++ runtime (cpp/include/groundstate/locked_buffer.hpp), N = 2, and its lock in real
   time (pair_lock.hpp): what the program that is generated from a chart does at each buffer, unless it is asked for the wait-free one.

   A step is one thing that a processor does indivisibly: the access to one word of an array or to one member of the buffer, an
   atomic operation on the word of the lock; and what the system does at once: "take the lock or fall asleep", "hand the lock over
   to who sleeps". Which side moves is chosen freely. Who waits gives up at any time, its watchdog having ended. What the memory
   orders of the program must add is argued at SYNC(permit) and SYNC(hand), and checked by ThreadSanitizer.

   The word of the lock keeps the system's mark when the one that slept has given up, as Linux does: the holder then releases
   through the system, which finds nobody. `seeded` is a fault that invariants and refinements find. */
asm SwingSteps

import ../std/StandardLibrary
import ../std/CTLLibrary

export *

signature:
	enum domain Side = {PRODUCER | CONSUMER}
	enum domain Place = {
		BEGINNING | WORKING | MARKING | ASKING | BLOCKING | ASLEEP | INSIDE | TURNING | MOVING_ON | RELEASING |
		UNLOCKING | LOOKING}
	enum domain Fault = {
		NONE | SLAVE_WITHOUT_LOCK | MASTER_WITHOUT_LOCK | RELEASED_EARLY | OTHER_ARRAY | MARK_KEPT | HANDED_TO_NOBODY}
	domain Array subsetof Integer
	domain Word subsetof Integer
	domain Datum subsetof Integer

	// Configuration: asked for in the initial state
	monitored readerLeads: Boolean
	controlled readerIsMaster: Boolean
	controlled seeded: Fault

	// The program's: the lock's word, which is a side's number or 0, with the system's mark; the buffer's members
	controlled holder: Side
	controlled marked: Boolean
	controlled indexRead: Array
	controlled indexWrite: Array
	controlled pending: Boolean
	controlled content: Prod(Array, Word) -> Datum

	// What a side knows alone: how far it is, the array that it works on, and what it writes or has read
	controlled place: Side -> Place
	controlled word: Side -> Word
	controlled held: Array
	controlled datum: Datum
	controlled seen: Word -> Datum

	// What nobody in the program knows: the datum in the array that is pending, the newest one handed over, and the one that this
	// reading has to give
	controlled staged: Datum
	controlled newest: Datum
	controlled due: Datum

	static other: Side -> Side
	derived isMaster: Side -> Boolean
	// the side does what it does under the lock
	derived isInside: Side -> Boolean
	derived withoutLock: Side -> Boolean

definitions:
	domain Array = {0 : 1}
	domain Word = {0 : 1}
	// so many that no old datum is mistaken for a new one
	domain Datum = {0 : 3}

	function other($s in Side) =
		if $s = PRODUCER then CONSUMER else PRODUCER endif

	function isMaster($s in Side) =
		if $s = CONSUMER then readerIsMaster else not readerIsMaster endif

	function isInside($s in Side) =
		contains({INSIDE, TURNING, MOVING_ON, RELEASING, UNLOCKING}, place($s))
		or (not isMaster($s) and contains({WORKING, MARKING, LOOKING}, place($s)))

	function withoutLock($s in Side) =
		seeded = (if isMaster($s) then MASTER_WITHOUT_LOCK else SLAVE_WITHOUT_LOCK endif)

	rule r_enter($s in Side) =
		place($s) := INSIDE

	// Where a side goes on that has given up: a master reads the old array, or leaves its datum pending; a slave leaves the action out.
	rule r_giveUp($s in Side) =
		if $s = CONSUMER and isMaster($s) then
			place($s) := LOOKING
		else
			place($s) := BEGINNING
		endif

	// What a side does after the lock: a master of a reading reads, all others have ended.
	rule r_leave($s in Side) =
		if $s = CONSUMER and isMaster($s) then
			place($s) := LOOKING
		else
			place($s) := BEGINNING
		endif

	rule r_begin($s in Side) =
		if $s = PRODUCER and isMaster($s) then
			par
				pending := false
				place($s) := WORKING
			endpar
		else
			place($s) := ASKING
		endif

	// One word of the datum is written, or read.
	rule r_work($s in Side) =
		par
			if $s = PRODUCER then
				content(indexWrite, word($s)) := datum
			else
				seen(word($s)) := content(held, word($s))
			endif
			word($s) := 1 - word($s)
			if word($s) = 1 then
				if $s = PRODUCER then
					place($s) := MARKING
				else
					if isMaster($s) or seeded = RELEASED_EARLY then
						place($s) := BEGINNING
					else
						place($s) := RELEASING
					endif
				endif
			endif
		endpar

	// The array that is written holds a datum that was not handed over.
	rule r_mark =
		par
			pending := true
			staged := datum
			datum := (datum + 1) mod 4
			if isMaster(PRODUCER) then
				place(PRODUCER) := ASKING
			else
				place(PRODUCER) := RELEASING
			endif
		endpar

	// An exchange takes the lock that nobody has.
	rule r_ask($s in Side) =
		if withoutLock($s) then
			r_enter[$s]
		else
			if isUndef(holder) then
				par
					holder := $s
					r_enter[$s]
				endpar
			else
				choose $late in Boolean with true do
					if $late then
						r_giveUp[$s]
					else
						place($s) := BLOCKING
					endif
			endif
		endif

	// The system: takes it, or marks it and puts the thread to sleep, at once.
	rule r_block($s in Side) =
		if isUndef(holder) then
			par
				holder := $s
				r_enter[$s]
			endpar
		else
			par
				marked := true
				place($s) := ASLEEP
			endpar
		endif

	// What a side does inside: a master swaps, a slave works.
	rule r_goIn($s in Side) =
		if isMaster($s) then
			if pending then
				place($s) := TURNING
			else
				place($s) := RELEASING
			endif
		else
			if $s = PRODUCER then
				par
					pending := false
					place($s) := WORKING
				endpar
			else
				place($s) := LOOKING
			endif
		endif

	// The index section, member by member.
	rule r_turn($s in Side) =
		par
			indexRead := indexWrite
			newest := staged
			place($s) := MOVING_ON
		endpar

	rule r_moveOn($s in Side) =
		par
			indexWrite := (indexWrite + 1) mod 2
			if seeded != MARK_KEPT then
				pending := false
			endif
			place($s) := RELEASING
		endpar

	// Which array is read.
	rule r_look =
		par
			if seeded = OTHER_ARRAY then
				held := indexWrite
			else
				held := indexRead
			endif
			due := newest
			if seeded = RELEASED_EARLY and not isMaster(CONSUMER) then
				place(CONSUMER) := RELEASING
			else
				place(CONSUMER) := WORKING
			endif
		endpar

	// An exchange gives the lock back that has no mark; the system does it otherwise.
	rule r_release($s in Side) =
		if withoutLock($s) then
			r_leave[$s]
		else
			if marked then
				place($s) := UNLOCKING
			else
				par
					holder := undef
					if seeded = RELEASED_EARLY and $s = CONSUMER and not isMaster($s) then
						place($s) := WORKING
					else
						r_leave[$s]
					endif
				endpar
			endif
		endif

	rule r_unlock($s in Side) =
		par
			marked := false
			if place(other($s)) = ASLEEP then
				par
					holder := other($s)
					r_enter[other($s)]
				endpar
			else
				if seeded = HANDED_TO_NOBODY then
					holder := other($s)
				else
					holder := undef
				endif
			endif
			if seeded = RELEASED_EARLY and $s = CONSUMER and not isMaster($s) then
				place($s) := WORKING
			else
				r_leave[$s]
			endif
		endpar

	rule r_move($s in Side) =
		switch place($s)
			case BEGINNING: r_begin[$s]
			case WORKING: r_work[$s]
			case MARKING: r_mark[]
			case ASKING: r_ask[$s]
			case BLOCKING: r_block[$s]
			case ASLEEP: r_giveUp[$s]
			case INSIDE: r_goIn[$s]
			case TURNING: r_turn[$s]
			case MOVING_ON: r_moveOn[$s]
			case RELEASING: r_release[$s]
			case UNLOCKING: r_unlock[$s]
			case LOOKING: r_look[]
		endswitch

	// who does what is done under the lock has it, and nobody else
	invariant inv_oneInside over place, holder:
		(forall $s in Side with isInside($s) implies (holder = $s and not isInside(other($s))))
	// who has the lock is inside: it is never lost
	invariant inv_notLost over place, holder: isDef(holder) implies isInside(holder)
	// who sleeps is woken: the other has the lock, and will find the mark
	invariant inv_noLostWakeUp over place, marked:
		(forall $s in Side with place($s) = ASLEEP implies (holder = other($s) and marked))
	// a reading that has ended is whole, and gives the newest datum handed over when it began
	invariant inv_newest over seen:
		(word(CONSUMER) = 0 and contains({BEGINNING, RELEASING}, place(CONSUMER)) and not readerIsMaster)
			or (place(CONSUMER) = BEGINNING and readerIsMaster)
		implies (forall $w in Word with seen($w) = due)
	// the newest datum handed over is kept for who reads
	invariant inv_kept over content, indexRead: (forall $w in Word with content(indexRead, $w) = newest)

	// with no assumption: readings and new data stay possible
	CTLSPEC ctlSpec_canRead: ag(ef(place(CONSUMER) = WORKING))
	CTLSPEC ctlSpec_canHandOver: (forall $d in Datum with ag(ef(newest = $d)))

	main rule r_Main =
		choose $side in Side with true do
			r_move[$side]

default init s0:
	function readerIsMaster = readerLeads
	function seeded = NONE
	function holder = undef
	function marked = false
	function indexRead = 1
	function indexWrite = 0
	function pending = false
	function content($a in Array, $w in Word) = 0
	function place($s in Side) = BEGINNING
	function word($s in Side) = 0
	function held = 1
	function datum = 1
	function seen($w in Word) = 0
	function staged = 0
	function newest = 0
	function due = 0
