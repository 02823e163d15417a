/* The alternating bit: K. A. Bartlett, R. A. Scantlebury and P. T. Wilkinson, A note on reliable full-duplex
   transmission over half-duplex links, Communications of the ACM 12, 1969. The sender repeats a datum with its bit
   until that bit comes back; the receiver takes a datum when the bit changes, and repeats the bit of the last one. The
   channels hold 8 messages, in order, and lose or repeat the one at their head.
   Seeded fault: r_Hear goes on at any bit. It violates inv_transferred after 4 steps. */
asm AlternatingBit

import ../../../library/std/StandardLibrary

signature:
	domain Bit subsetof Integer
	domain Datum subsetof Integer
	enum domain Action = {
		FETCH | SEND | TAKE | REPLY | HEAR | LOSE_MESSAGE | LOSE_REPLY | REPEAT_MESSAGE | REPEAT_REPLY}

	// the sender: the datum under way, undef if there is none, and its bit
	controlled datum: Datum
	controlled bit: Bit
	// the receiver: the datum taken last, undef at the beginning, and the bit that comes next
	controlled taken: Datum
	controlled expected: Bit
	controlled messages: Seq(Prod(Bit, Datum))
	controlled replies: Seq(Bit)

	static capacity: Integer

definitions:
	domain Bit = {0 : 1}
	domain Datum = {0 : 7}

	function capacity = 8

	rule r_Fetch =
		if isUndef(datum) then
			choose $d in Datum with true do datum := $d
		endif

	rule r_Send =
		if isDef(datum) and length(messages) < capacity then
			messages := append(messages, (bit, datum))
		endif

	rule r_Take =
		if not isEmpty(messages) then
			par
				messages := tail(messages)
				if first(first(messages)) = expected then
					par
						taken := second(first(messages))
						expected := 1 - expected
					endpar
				endif
			endpar
		endif

	rule r_Reply =
		if length(replies) < capacity then
			replies := append(replies, 1 - expected)
		endif

	rule r_Hear =
		if not isEmpty(replies) then
			par
				replies := tail(replies)
				if isDef(datum) and first(replies) = bit then
					par
						datum := undef
						bit := 1 - bit
					endpar
				endif
			endpar
		endif

	// A datum whose bit the receiver has turned is the one that it took.
	invariant inv_transferred over taken: bit != expected and isDef(datum) implies taken = datum

	main rule r_Main =
		choose $action in Action with true do
			switch $action
				case FETCH: r_Fetch[]
				case SEND: r_Send[]
				case TAKE: r_Take[]
				case REPLY: r_Reply[]
				case HEAR: r_Hear[]
				case LOSE_MESSAGE:
					if not isEmpty(messages) then
						messages := tail(messages)
					endif
				case LOSE_REPLY:
					if not isEmpty(replies) then
						replies := tail(replies)
					endif
				case REPEAT_MESSAGE:
					if not isEmpty(messages) and length(messages) < capacity then
						messages := prepend(first(messages), messages)
					endif
				case REPEAT_REPLY:
					if not isEmpty(replies) and length(replies) < capacity then
						replies := prepend(first(replies), replies)
					endif
			endswitch

default init s0:
	function bit = 0
	function expected = 0
	function messages = []
	function replies = []
