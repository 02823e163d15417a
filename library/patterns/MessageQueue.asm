/* Asynchronous message passing: a bounded FIFO queue between one sender and one receiver.

   Sender and receiver may step at the same instant, so they share no location: the sender writes the
   slots and `mq_sent`, the receiver `mq_taken`; the length is the difference. Two senders on one
   queue would overwrite each other's message by equal updates of `mq_sent`; a queue therefore has
   one sender, and several senders take a queue each. Data that only the newest matter belong into a
   swinging buffer; a queue keeps every message and its order. */
module MessageQueue

import ../std/StandardLibrary

export *

signature:
	abstract domain MessageQueue
	domain QueueSlot subsetof Integer

	// Configuration; at most as many as there are slots
	controlled mq_capacity: MessageQueue -> Integer

	// Written by the sender alone
	controlled mq_staged: MessageQueue -> Integer
	controlled mq_slot: Prod(MessageQueue, QueueSlot) -> Integer
	controlled mq_sent: MessageQueue -> Integer
	controlled mq_refused: MessageQueue -> Integer

	// Written by the receiver alone
	controlled mq_received: MessageQueue -> Integer
	controlled mq_taken: MessageQueue -> Integer

	derived mq_length: MessageQueue -> Integer
	derived mq_isEmpty: MessageQueue -> Boolean
	derived mq_isFull: MessageQueue -> Boolean
	derived mq_sound: MessageQueue -> Boolean

definitions:
	domain QueueSlot = {0 : 15}

	function mq_length($q in MessageQueue) =
		mq_sent($q) - mq_taken($q)

	function mq_isEmpty($q in MessageQueue) =
		mq_length($q) = 0

	function mq_isFull($q in MessageQueue) =
		mq_length($q) >= mq_capacity($q)

	function mq_sound($q in MessageQueue) =
		mq_length($q) >= 0 and mq_length($q) <= mq_capacity($q)

	// A message for a full queue is refused, and counted; a sender that must not lose it waits.
	rule r_mq_send($q in MessageQueue) =
		if mq_isFull($q) then
			mq_refused($q) := mq_refused($q) + 1
		else
			par
				mq_slot($q, mq_sent($q) mod mq_capacity($q)) := mq_staged($q)
				mq_sent($q) := mq_sent($q) + 1
			endpar
		endif

	rule r_mq_receive($q in MessageQueue) =
		if not mq_isEmpty($q) then
			par
				mq_received($q) := mq_slot($q, mq_taken($q) mod mq_capacity($q))
				mq_taken($q) := mq_taken($q) + 1
			endpar
		endif
