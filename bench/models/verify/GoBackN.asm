/* Go-back-N: a sliding window over channels that lose messages, as A. S. Tanenbaum gives it (Computer Networks,
   protocol 5, one way). The sender sends up to 4 items that are not acknowledged, numbered modulo 5; when it waits too
   long it sends them all again. The receiver takes items in order only, and acknowledges each message by the number
   that it expects next. Item k carries the datum k modulo 2, and is counted modulo 10, so that every place of the
   window meets every datum. Both channels are sequences of at most 5 messages.
   Seeded fault: a window of 5, as many as there are numbers. It violates inv_window and inv_right after 14 steps. */
asm GoBackN

import ../../../library/std/StandardLibrary

signature:
	domain Item subsetof Integer
	domain Number subsetof Integer
	domain Datum subsetof Integer
	domain Count subsetof Integer
	enum domain Action = {SEND | TIME_OUT | RECEIVE | HEAR | LOSE_DATA | LOSE_ACKNOWLEDGEMENT}

	// the sender: the first item that is not acknowledged, and how many have been sent from there
	controlled first: Item
	controlled sent: Count
	// the receiver: the item that comes next, and whether all it took were those that came next
	controlled expected: Item
	controlled right: Boolean
	controlled data: Seq(Prod(Number, Datum))
	controlled acknowledgements: Seq(Number)

	static window: Integer
	static numbers: Integer
	static items: Integer
	static capacity: Integer
	derived acknowledged: Integer

definitions:
	domain Item = {0 : 9}
	domain Number = {0 : 4}
	domain Datum = {0 : 1}
	domain Count = {0 : 5}

	function window = 4
	function numbers = 5
	function items = 10
	function capacity = 5
	// how many items the acknowledgement that arrives is about
	function acknowledged = (first(acknowledgements) + items - first) mod numbers

	rule r_Send =
		if sent < window and length(data) < capacity then
			let ($item = (first + sent) mod items) in
				par
					data := append(data, ($item mod numbers, $item mod 2))
					sent := sent + 1
				endpar
			endlet
		endif

	rule r_TimeOut =
		sent := 0

	rule r_Receive =
		if not isEmpty(data) and length(acknowledgements) < capacity then
			let ($number = first(first(data)), $datum = second(first(data))) in
				par
					data := tail(data)
					if $number = expected mod numbers then
						par
							right := $datum = expected mod 2
							expected := (expected + 1) mod items
							acknowledgements := append(acknowledgements, (expected + 1) mod numbers)
						endpar
					else
						acknowledgements := append(acknowledgements, expected mod numbers)
					endif
				endpar
			endlet
		endif

	rule r_Hear =
		if not isEmpty(acknowledgements) then
			par
				acknowledgements := tail(acknowledgements)
				first := (first + acknowledged) mod items
				sent := max(sent - acknowledged, 0)
			endpar
		endif

	rule r_LoseData =
		if not isEmpty(data) then
			data := tail(data)
		endif

	rule r_LoseAcknowledgement =
		if not isEmpty(acknowledgements) then
			acknowledgements := tail(acknowledgements)
		endif

	// What was taken is what was sent, and the sender does not think that more was taken.
	invariant inv_window over expected: (expected + items - first) mod items <= window
	invariant inv_right over right: right

	main rule r_Main =
		choose $action in Action with true do
			switch $action
				case SEND: r_Send[]
				case TIME_OUT: r_TimeOut[]
				case RECEIVE: r_Receive[]
				case HEAR: r_Hear[]
				case LOSE_DATA: r_LoseData[]
				case LOSE_ACKNOWLEDGEMENT: r_LoseAcknowledgement[]
			endswitch

default init s0:
	function first = 0
	function sent = 0
	function expected = 0
	function right = true
	function data = []
	function acknowledgements = []
