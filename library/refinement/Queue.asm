/* A message queue with room for two, as its sides see it: a message is put in, or taken out. The messages are numbered modulo three.

   library/runtime/QueueSteps refines it: there the same happens in accesses to words of memory. */
asm Queue

import ../std/StandardLibrary

signature:
	domain Datum subsetof Integer

	controlled messages: Seq(Datum)
	controlled next: Datum

	// the last message taken; undef before the first
	controlled got: Datum

definitions:
	domain Datum = {0 : 2}

	rule r_put =
		par
			messages := append(messages, next)
			next := (next + 1) mod 3
		endpar

	rule r_take =
		par
			got := first(messages)
			messages := tail(messages)
		endpar

	// A side that finds no room, or no message, gives up.
	main rule r_Main =
		choose $putting in Boolean with true do
			if $putting then
				if length(messages) < 2 then
					r_put[]
				endif
			else
				if not isEmpty(messages) then
					r_take[]
				endif
			endif

default init s0:
	function messages = []
	function next = 0
