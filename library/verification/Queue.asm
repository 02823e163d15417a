/* The message queue with every capacity from one to three, and any messages. */
asm Queue

import ../std/StandardLibrary
import ../std/LTLLibrary
import ../patterns/MessageQueue
import QueueSides

signature:

definitions:
	main rule r_Main =
		choose $moves in Moves with true do
			let ($sent = mq_sent(queue), $taken = mq_taken(queue)) in
				seq
					if $moves != RECEIVER_MOVES then
						r_stage[]
					endif
					par
						if $moves != RECEIVER_MOVES then
							r_mq_send[queue]
						endif
						if $moves != SENDER_MOVES then
							r_mq_receive[queue]
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
