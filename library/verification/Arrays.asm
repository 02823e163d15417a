/* The arrays of a swinging buffer, two to four of them, against what is known beside it: what the producer wrote last, what was handed
   over last, and whether it was read. In each step something happens that the lock allows: a writing or a reading begins or ends, or both
   begin at once; the master swaps while the slave works on no array; the slave leaves out a writing or a reading. The master and the
   number of arrays are asked for in the initial state. */
asm Arrays

import ../std/StandardLibrary
import ../std/CTLLibrary
import ../patterns/ControlTask
import Quotient

signature:
	enum domain Happening = {
		WRITES | READS | WRITES_AND_READS | STOPS_WRITING | STOPS_READING | CUTS_OFF | SWAPS | LEAVES_OUT}
	domain Arrays subsetof Integer

	static buffer: SwingingBuffer
	static lock: Semaphore
	static write: SchedulePhase
	static read: SchedulePhase

	// asked for in the initial state
	monitored arrays: Arrays
	monitored readerIsMaster: Boolean

	// the number of arrays, as it was asked for
	controlled ring: Arrays

	// What nobody in the program knows
	controlled newest: Integer
	controlled handed: Integer
	controlled isPending: Boolean
	controlled isUnread: Boolean
	// what the last reading gave by right, and whether it is new
	controlled due: Integer
	controlled mustBeFresh: Boolean
	controlled isWriting: Boolean
	controlled isReading: Boolean
	// the last writing was cut off
	controlled isCutOff: Boolean
	// what came of the last step is what had to come
	controlled isCounted: Boolean
	controlled isTurned: Boolean

	derived asReader: Boolean
	derived slaveWorks: Boolean
	derived mayHappen: Happening -> Boolean
	static increment: Boolean -> Integer

definitions:
	domain Arrays = {2 : 4}

	function increment($is in Boolean) =
		if $is then 1 else 0 endif

	// the master
	function asReader =
		sb_master(buffer) = read

	function slaveWorks =
		if asReader then isWriting else isReading endif

	// A master's indexes stay as they are until it has done its action, too.
	function mayHappen($h in Happening) =
		switch $h
			case WRITES: not isWriting
			case READS: not isReading
			case WRITES_AND_READS: not isWriting and not isReading
			case STOPS_WRITING: isWriting
			case STOPS_READING: isReading
			case CUTS_OFF: isWriting
			case SWAPS: not isWriting and not isReading
			otherwise not slaveWorks
		endswitch

	rule r_happen($h in Happening) =
		switch $h
			case WRITES: r_SwingingBuffer_write[buffer]
			case READS: r_SwingingBuffer_read[buffer]
			case WRITES_AND_READS:
				par
					r_SwingingBuffer_write[buffer]
					r_SwingingBuffer_read[buffer]
				endpar
			case STOPS_WRITING: r_SwingingBuffer_endWrite[buffer]
			case STOPS_READING: r_SwingingBuffer_endRead[buffer]
			case CUTS_OFF: r_SwingingBuffer_cutOffWrite[buffer]
			case SWAPS: r_SwingingBuffer_updateIndexes[buffer]
			otherwise
				if asReader then
					r_SwingingBuffer_skipWrite[buffer]
				else
					r_SwingingBuffer_skipRead[buffer]
				endif
		endswitch

	// Data go round in a circle of three. Counters begin with different numbers, so that none is taken for another.
	rule r_prepare =
		par
			sb_staged(buffer) := 7 + (sb_staged(buffer) - 6) mod 3
			indexUpdated(buffer) := false
			sb_overwritten(buffer) := sb_overwritten(buffer) + 10
			sb_unread(buffer) := sb_unread(buffer) + 20
			sb_dropped(buffer) := sb_dropped(buffer) + 30
		endpar

	rule r_restore =
		par
			sb_overwritten(buffer) := sb_overwritten(buffer) - 10
			sb_unread(buffer) := sb_unread(buffer) - 20
			sb_dropped(buffer) := sb_dropped(buffer) - 30
		endpar

	rule r_forgetNumbers($all in Powerset(Integer)) =
		par
			r_turn[buffer, $all]
			r_renumber[buffer, $all]
		endpar

	rule r_observe(
		$h in Happening,
		$written in Integer,
		$swaps in Integer,
		$delivered in Integer,
		$read in Integer,
		$write in Integer) =
		let ($writes = $h = WRITES or $h = WRITES_AND_READS, $reads = $h = READS or $h = WRITES_AND_READS) in
			par
				if $writes then
					par
						newest := sb_staged(buffer)
						isPending := true
						isWriting := true
						isCutOff := false
					endpar
				endif
				if $h = STOPS_WRITING then
					isWriting := false
				endif
				if $h = CUTS_OFF then
					par
						isPending := false
						isWriting := false
						isCutOff := true
					endpar
				endif
				if $reads then
					par
						mustBeFresh := isUnread
						isUnread := false
						isReading := true
						if isUnread then
							due := handed
						endif
					endpar
				endif
				if $h = STOPS_READING then
					isReading := false
				endif
				if $h = SWAPS and isPending then
					par
						handed := newest
						isPending := false
						isUnread := true
					endpar
				endif
				if $h = LEAVES_OUT and not asReader then
					mustBeFresh := false
				endif
				isCounted :=
					sb_written(buffer) - $written = increment($writes)
					and sb_overwritten(buffer) = 10 + increment($writes and isPending or $h = CUTS_OFF)
					and sb_swaps(buffer) - $swaps = increment($h = SWAPS and isPending)
					and sb_unread(buffer) = 20 + increment($h = SWAPS and isPending and isUnread)
					and sb_delivered(buffer) - $delivered = increment($reads and isUnread)
					and sb_dropped(buffer) = 30 + increment($h = LEAVES_OUT and asReader)
				isTurned :=
					if $h = SWAPS and isPending then
						indexRead(buffer) = $write and indexWrite(buffer) = ($write + 1) mod ring
					else
						indexRead(buffer) = $read and indexWrite(buffer) = $write
					endif
					and indexUpdated(buffer) = ($h = SWAPS)
			endpar
		endlet

	invariant inv_disjoint over sb_writingArray, sb_readingArray: sb_disjoint(buffer)
	invariant inv_newest over sb_sequence: sb_newest(buffer)
	invariant inv_accounted over sb_written: sb_accounted(buffer)
	// each writing, swap, reading and omission is counted as what it is
	invariant inv_counted over sb_overwritten, sb_unread, sb_dropped: isCounted
	// a swap hands over the array that was written, and goes on to the next one of the ring
	invariant inv_turned over indexRead, indexWrite: isTurned
	invariant inv_pending over sb_pending: sb_pending(buffer) = isPending
	invariant inv_working over sb_writingArray, sb_readingArray:
		isDef(sb_writingArray(buffer)) = isWriting and isDef(sb_readingArray(buffer)) = isReading
	// it is remembered until the next writing that one was cut off
	invariant inv_cutOff over sb_cutOff: (sb_cutOff(buffer) = true) = isCutOff
	// a reading gives what was handed over last, and its array stays as it is
	invariant inv_received over sb_received: sb_received(buffer) = due
	invariant inv_whole over sb_data: isReading implies sb_data(buffer, sb_readingArray(buffer)) = due
	// it is new once, and never after it was left out
	invariant inv_fresh over sb_fresh: sb_fresh(buffer) = mustBeFresh

	CTLSPEC ctlSpec_news: ag(ef(mustBeFresh))

	main rule r_Main =
		choose $h in Happening with mayHappen($h) do
			let ($written = sb_written(buffer),
				$swaps = sb_swaps(buffer),
				$delivered = sb_delivered(buffer),
				$read = indexRead(buffer),
				$write = indexWrite(buffer)) in
				seq
					r_prepare[]
					r_happen[$h]
					r_observe[$h, $written, $swaps, $delivered, $read, $write]
					r_restore[]
					r_forgetNumbers[numbers(buffer)]
				endseq
			endlet

default init s0:
	function clock = 0
	function ring = arrays
	function dimension($b in SwingingBuffer) = arrays
	function sem($b in SwingingBuffer) = lock
	function sb_master($b in SwingingBuffer) = if readerIsMaster then read else write endif
	function indexWrite($b in SwingingBuffer) = 0
	function indexRead($b in SwingingBuffer) = 1
	function indexUpdated($b in SwingingBuffer) = false
	function sb_pending($b in SwingingBuffer) = false
	function sb_sequence($b in SwingingBuffer, $n in ArrayIndex) = 0
	function sb_staged($b in SwingingBuffer) = 7
	function sb_receivedSequence($b in SwingingBuffer) = 0
	function sb_fresh($b in SwingingBuffer) = false
	function sb_written($b in SwingingBuffer) = 0
	function sb_swaps($b in SwingingBuffer) = 0
	function sb_delivered($b in SwingingBuffer) = 0
	function sb_overwritten($b in SwingingBuffer) = 0
	function sb_unread($b in SwingingBuffer) = 0
	function sb_dropped($b in SwingingBuffer) = 0
	function handedOver($b in SwingingBuffer) = 0
	function isPending = false
	function isUnread = false
	function mustBeFresh = false
	function isWriting = false
	function isReading = false
	function isCutOff = false
	function isCounted = true
	function isTurned = true
