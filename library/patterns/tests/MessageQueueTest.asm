/* A sender and a receiver on a queue of three; both may act in the same step. */
asm MessageQueueTest

import ../../std/StandardLibrary
import ../MessageQueue

signature:
	static queue: MessageQueue

	monitored sends: Boolean
	monitored takes: Boolean
	// the messages taken so far, in order
	controlled log: Seq(Integer)

definitions:
	rule r_sender =
		if sends then
			par
				r_mq_send[queue]
				if not mq_isFull(queue) then mq_staged(queue) := mq_staged(queue) + 1 endif
			endpar
		endif

	rule r_receiver =
		if takes and not mq_isEmpty(queue) then
			par
				r_mq_receive[queue]
				log := append(log, mq_slot(queue, mq_taken(queue) mod mq_capacity(queue)))
			endpar
		endif

	invariant inv_bounds over mq_sent, mq_taken: mq_sound(queue)
	// every message arrives, once and in order: they are numbered 1, 2, 3 …
	invariant inv_order over log:
		length(log) = mq_taken(queue)
		and (isEmpty(log) or isUndef(mq_received(queue)) or mq_received(queue) = length(log))

	main rule r_Main =
		par
			r_sender[]
			r_receiver[]
		endpar

default init s0:
	function mq_capacity($q in MessageQueue) = 3
	function mq_staged($q in MessageQueue) = 1
	function mq_sent($q in MessageQueue) = 0
	function mq_taken($q in MessageQueue) = 0
	function mq_refused($q in MessageQueue) = 0
	function log = []
