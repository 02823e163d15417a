/* The message queue with a fault in it, as Queue.asm is without. */
asm QueueFaulty

import ../std/StandardLibrary
import ../std/LTLLibrary
import ../patterns/MessageQueue
import QueueSides

signature:
	enum domain Fault = {OVERWRITES | REFUSES_TOO_SOON | TAKES_FROM_EMPTY | LAST_IN_FIRST_OUT | TWO_SENDERS}

	monitored seeded: Fault
	controlled fault: Fault

definitions:
	rule r_put($at in Integer) =
		par
			mq_slot(queue, $at mod mq_capacity(queue)) := mq_staged(queue)
			mq_sent(queue) := mq_sent(queue) + 1
		endpar

	// A second sender in the same step: equal updates of the counter make one message of two.
	rule r_putTwice =
		if not mq_isFull(queue) then
			par
				r_put[mq_sent(queue)]
				onTheWay := append(onTheWay, mq_staged(queue))
			endpar
		endif

	rule r_refuseTooSoon =
		if mq_length(queue) >= mq_capacity(queue) - 1 then
			mq_refused(queue) := mq_refused(queue) + 1
		else
			r_mq_send[queue]
		endif

	rule r_send =
		switch fault
			case REFUSES_TOO_SOON: r_refuseTooSoon[]
			case OVERWRITES: r_put[mq_sent(queue)]
			case LAST_IN_FIRST_OUT:
				if not mq_isFull(queue) then r_put[mq_taken(queue)] endif
			case TWO_SENDERS: r_putTwice[]
			otherwise r_mq_send[queue]
		endswitch

	rule r_receive =
		if fault = TAKES_FROM_EMPTY then
			par
				mq_received(queue) := mq_slot(queue, mq_taken(queue) mod mq_capacity(queue))
				mq_taken(queue) := mq_taken(queue) + 1
			endpar
		else
			r_mq_receive[queue]
		endif

	main rule r_Main =
		choose $moves in Moves with true do
			let ($sent = mq_sent(queue), $taken = mq_taken(queue)) in
				seq
					if $moves != RECEIVER_MOVES then
						r_stage[]
					endif
					par
						if $moves != RECEIVER_MOVES then
							r_send[]
						endif
						if $moves != SENDER_MOVES then
							r_receive[]
						endif
						senderMoved := $moves != RECEIVER_MOVES
						receiverMoved := $moves != SENDER_MOVES
					endpar
					r_observe[$sent, $taken]
					r_shift[]
				endseq
			endlet

default init s0:
	function mq_capacity($q in MessageQueue) = capacity
	function mq_staged($q in MessageQueue) = 0
	function mq_slot($q in MessageQueue, $n in QueueSlot) = 0
	function mq_sent($q in MessageQueue) = 0
	function mq_refused($q in MessageQueue) = 0
	function mq_received($q in MessageQueue) = 0
	function mq_taken($q in MessageQueue) = 0
	function senderMoved = false
	function receiverMoved = false
	function onTheWay = []
	function due = 0
	function refused = false
	function isCounted = true
	function fault = seeded
