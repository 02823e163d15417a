/* The swinging buffer: N >= 2 arrays between one producer and one consumer.

   The producer works on the array at `indexWrite`, the consumer on the one at `indexRead`; the lock
   guards the indexes, not the data. One of the two parties, the master, updates the indexes, and only
   inside the lock; the other one, the slave, keeps the lock while it works on its array, so that no
   array is swapped away under its hands.

   A swap hands over the newest array: `indexRead` becomes the old `indexWrite`, and `indexWrite` goes
   on to the next array of the ring, whatever N. It happens only when there is something new to hand
   over (`sb_pending`): a consumer never swaps back to an older datum.

   Data are integers (a time stamp, an identifier, a value); each datum written gets the next sequence
   number of its buffer. A broadcast takes one buffer for each consumer. */
module SwingingBuffer

import ../std/StandardLibrary
import Task
import Semaphore

export *

signature:
	abstract domain SwingingBuffer
	domain ArrayIndex subsetof Integer

	// Configuration
	controlled dimension: SwingingBuffer -> Integer
	controlled sem: SwingingBuffer -> Semaphore

	controlled indexRead: SwingingBuffer -> ArrayIndex
	controlled indexWrite: SwingingBuffer -> ArrayIndex
	// the master has been through the index section and not yet released the lock
	controlled indexUpdated: SwingingBuffer -> Boolean
	// the array at `indexWrite` holds a datum that was not handed over yet
	controlled sb_pending: SwingingBuffer -> Boolean
	// true if the latest writing was cut off: what stands in the array at `indexWrite` is never handed over
	controlled sb_cutOff: SwingingBuffer -> Boolean

	controlled sb_data: Prod(SwingingBuffer, ArrayIndex) -> Integer
	// 0: nothing was ever written there
	controlled sb_sequence: Prod(SwingingBuffer, ArrayIndex) -> Integer

	// What the producer writes next, and what the consumer read last
	controlled sb_staged: SwingingBuffer -> Integer
	controlled sb_received: SwingingBuffer -> Integer
	controlled sb_receivedSequence: SwingingBuffer -> Integer
	// the latest reading brought a datum the consumer had not seen before
	controlled sb_fresh: SwingingBuffer -> Boolean

	// The array somebody is working on at this moment; undef when nobody does
	controlled sb_writingArray: SwingingBuffer -> ArrayIndex
	controlled sb_readingArray: SwingingBuffer -> ArrayIndex

	// Account of every datum
	controlled sb_written: SwingingBuffer -> Integer
	controlled sb_swaps: SwingingBuffer -> Integer
	controlled sb_delivered: SwingingBuffer -> Integer
	// overwritten before it was handed over, or cut off while it was written
	controlled sb_overwritten: SwingingBuffer -> Integer
	// handed over, and replaced before it was read
	controlled sb_unread: SwingingBuffer -> Integer
	// not even written, the lock being busy for too long
	controlled sb_dropped: SwingingBuffer -> Integer

	derived sb_newestSequence: SwingingBuffer -> Integer
	derived sb_lockOwner: SwingingBuffer -> Task
	derived sb_disjoint: SwingingBuffer -> Boolean
	derived sb_newest: SwingingBuffer -> Boolean
	derived sb_accounted: SwingingBuffer -> Boolean

definitions:
	domain ArrayIndex = {0 : 7}

	// The sequence number the next reading will see.
	function sb_newestSequence($b in SwingingBuffer) =
		sb_sequence($b, indexRead($b))

	function sb_lockOwner($b in SwingingBuffer) =
		chooseone({$t in asSet(sem_users(sem($b))) | sem_state(sem($b), $t) = EXECUTION : $t})

	// Reader and writer never work on one array.
	function sb_disjoint($b in SwingingBuffer) =
		indexRead($b) != indexWrite($b) and (isUndef(sb_writingArray($b)) or sb_writingArray($b) != sb_readingArray($b))

	// The reader's array is the newest one handed over, and readings never go back in time.
	function sb_newest($b in SwingingBuffer) =
		sb_receivedSequence($b) <= sb_newestSequence($b)
		and (
			sb_cutOff($b) = true
			or sb_written($b)
				= (if sb_pending($b) then sb_sequence($b, indexWrite($b)) else sb_newestSequence($b) endif))

	// No datum disappears without being counted.
	function sb_accounted($b in SwingingBuffer) =
		sb_written($b) = sb_swaps($b) + sb_overwritten($b) + (if sb_pending($b) then 1 else 0 endif)
		and sb_swaps($b)
			= sb_delivered($b)
				+ sb_unread($b)
				+ (if sb_newestSequence($b) != sb_receivedSequence($b) then 1 else 0 endif)

	rule r_SwingingBuffer_getLock($b in SwingingBuffer, $t in Task) =
		r_sem_wait[sem($b), $t]

	rule r_SwingingBuffer_giveUp($b in SwingingBuffer, $t in Task) =
		r_sem_giveUp[sem($b), $t]

	rule r_SwingingBuffer_releaseLock($b in SwingingBuffer, $t in Task) =
		r_sem_post[sem($b), $t]

	// The index section; its caller is inside the lock.
	rule r_SwingingBuffer_updateIndexes($b in SwingingBuffer) =
		par
			indexUpdated($b) := true
			if sb_pending($b) then
				par
					indexRead($b) := indexWrite($b)
					indexWrite($b) := (indexWrite($b) + 1) mod dimension($b)
					sb_pending($b) := false
					sb_swaps($b) := sb_swaps($b) + 1
					if sb_newestSequence($b) != sb_receivedSequence($b) then
						sb_unread($b) := sb_unread($b) + 1
					endif
				endpar
			endif
		endpar

	rule r_SwingingBuffer_write($b in SwingingBuffer) =
		let ($array = indexWrite($b), $number = sb_written($b) + 1) in
			par
				sb_writingArray($b) := $array
				sb_data($b, $array) := sb_staged($b)
				sb_sequence($b, $array) := $number
				sb_written($b) := $number
				// always, so that a swap in the same step would clash instead of losing the datum
				sb_pending($b) := true
				if sb_pending($b) then
					sb_overwritten($b) := sb_overwritten($b) + 1
				endif
				if sb_cutOff($b) = true then
					sb_cutOff($b) := false
				endif
			endpar
		endlet

	rule r_SwingingBuffer_endWrite($b in SwingingBuffer) =
		sb_writingArray($b) := undef

	// A writing ends before its datum is whole. What it has replaced is lost, too.
	rule r_SwingingBuffer_cutOffWrite($b in SwingingBuffer) =
		par
			r_SwingingBuffer_endWrite[$b]
			sb_pending($b) := false
			sb_cutOff($b) := true
			sb_overwritten($b) := sb_overwritten($b) + 1
		endpar

	// A buffer in which nothing was handed over yet gives nothing, and says so by `sb_fresh`.
	rule r_SwingingBuffer_read($b in SwingingBuffer) =
		let ($array = indexRead($b), $number = sb_sequence($b, $array), $isNew = $number != sb_receivedSequence($b)) in
			par
				sb_readingArray($b) := $array
				sb_fresh($b) := $isNew
				if $isNew then
					par
						sb_received($b) := sb_data($b, $array)
						sb_receivedSequence($b) := $number
						sb_delivered($b) := sb_delivered($b) + 1
					endpar
				endif
			endpar
		endlet

	rule r_SwingingBuffer_endRead($b in SwingingBuffer) =
		sb_readingArray($b) := undef

	// The lock came too late for a slave: the reader keeps what it has, marked as old; a datum that
	// was to be written is lost, and counted.
	rule r_SwingingBuffer_skipRead($b in SwingingBuffer) =
		sb_fresh($b) := false

	rule r_SwingingBuffer_skipWrite($b in SwingingBuffer) =
		sb_dropped($b) := sb_dropped($b) + 1
