/* Misuse: two senders on one queue. Both write the same slot; when their messages differ the step
   clashes, when they are equal one of the two is silently gone. */
asm QueueTwoSenders

import ../../std/StandardLibrary
import ../MessageQueue

signature:
	enum domain Sender = {LEFT | RIGHT}
	static queue: MessageQueue
	controlled accepted: Sender -> Integer
	monitored message: Sender -> Integer

definitions:
	rule r_send($s in Sender) =
		if not mq_isFull(queue) then
			par
				mq_slot(queue, mq_sent(queue) mod mq_capacity(queue)) := message($s)
				mq_sent(queue) := mq_sent(queue) + 1
				accepted($s) := accepted($s) + 1
			endpar
		endif

	invariant inv_nothingLost over mq_sent: mq_sent(queue) = accepted(LEFT) + accepted(RIGHT)

	main rule r_Main =
		forall $s in Sender with true do r_send[$s]

default init s0:
	function mq_capacity($q in MessageQueue) = 8
	function mq_sent($q in MessageQueue) = 0
	function mq_taken($q in MessageQueue) = 0
	function accepted($s in Sender) = 0
