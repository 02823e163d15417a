/* A sender and a receiver on a message queue, who move one at a time or at once. The counters of the queue grow for ever and
   matter only by their difference and by the slot they come to, so the capacity is taken from both after the second round.
   Beside the queue stands the sequence of messages that were sent and not yet received. */
module QueueSides

import ../std/StandardLibrary
import ../std/LTLLibrary
import ../patterns/MessageQueue

export *

signature:
	enum domain Moves = {SENDER_MOVES | RECEIVER_MOVES | BOTH_MOVE}
	domain Message subsetof Integer

	static queue: MessageQueue

	// asked for in the initial state
	monitored capacity: Message
	monitored message: Message

	controlled senderMoved: Boolean
	controlled receiverMoved: Boolean
	// sent and not yet received, oldest first
	controlled onTheWay: Seq(Integer)
	// what the last receiving gave, and what it had to give
	controlled due: Integer
	controlled refused: Boolean
	// the last step sent or refused one message if the sender moved, and took one if the receiver moved and there was one
	controlled isCounted: Boolean

definitions:
	domain Message = {1 : 3}

	rule r_stage =
		mq_staged(queue) := message

	rule r_observe($sent in Integer, $taken in Integer) =
		let ($all = if mq_sent(queue) != $sent then append(onTheWay, mq_staged(queue)) else onTheWay endif,
			$takes = receiverMoved and not isEmpty(onTheWay)) in
			par
				refused := mq_refused(queue) > 0
				isCounted :=
					mq_sent(queue) - $sent + mq_refused(queue) = (if senderMoved then 1 else 0 endif)
					and mq_taken(queue) - $taken = (if $takes then 1 else 0 endif)
				if mq_taken(queue) != $taken then
					par
						due := first($all)
						onTheWay := tail($all)
					endpar
				else
					onTheWay := $all
				endif
			endpar
		endlet

	rule r_shift =
		par
			mq_refused(queue) := 0
			if mq_taken(queue) >= 2 * mq_capacity(queue) then
				par
					mq_taken(queue) := mq_taken(queue) - mq_capacity(queue)
					mq_sent(queue) := mq_sent(queue) - mq_capacity(queue)
				endpar
			endif
		endpar

	invariant inv_bounds over mq_sent, mq_taken: mq_sound(queue)
	// each message comes, once, in the order of sending, unchanged
	invariant inv_order over mq_received: mq_received(queue) = due
	invariant inv_noneLost over onTheWay: length(onTheWay) = mq_length(queue)
	// whoever sends has sent or been refused, and whoever receives has received what there was
	invariant inv_counted over mq_sent, mq_taken: isCounted
	// a message is refused only where the queue was full
	invariant inv_refused over mq_refused:
		refused
		implies (mq_length(queue) = mq_capacity(queue) or (receiverMoved and mq_length(queue) = mq_capacity(queue) - 1))

	JUSTICE senderMoved
	JUSTICE receiverMoved

	// a full queue has room again
	LTLSPEC ltlSpec_roomComes: g(mq_isFull(queue) implies f(not mq_isFull(queue)))
