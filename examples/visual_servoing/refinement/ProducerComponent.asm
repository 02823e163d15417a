/* The data producer of the paper's Figure 7: it waits for its trigger, elaborates, and writes to shared memory. What the pattern machine of the
   writing does is left open, but for what comes of it: the datum that was made is stored, once, before the machine is left. A
   synchronous slave may also leave it out, if it does not get the lock in time.

   Each producer of library/verification/PairInTicks refines it: a task that ControlTask and Producer take through its phases. */
asm ProducerComponent

import ../../../library/std/StandardLibrary

signature:
	enum domain ProducerState = {PRODUCER_WAITING | PRODUCER_ELABORATING | PRODUCER_WRITING}
	domain Datum subsetof Integer

	monitored triggered: Boolean
	monitored elapsed: Boolean
	// asked for in the initial state
	monitored isImpatient: Boolean
	controlled mayLeaveOut: Boolean

	controlled producerState: ProducerState
	controlled made: Datum
	// in shared memory
	controlled stored: Datum
	controlled isStored: Boolean

definitions:
	domain Datum = {0 : 2}

	rule r_elaborate =
		par
			made := (made + 1) mod 3
			isStored := false
			producerState := PRODUCER_ELABORATING
		endpar

	rule r_store =
		par
			stored := made
			isStored := true
		endpar

	rule r_produce =
		switch producerState
			case PRODUCER_WAITING:
				if triggered then
					r_elaborate[]
				endif
			case PRODUCER_ELABORATING:
				if elapsed then
					producerState := PRODUCER_WRITING
				endif
			case PRODUCER_WRITING:
				choose $leaves in Boolean with true do
					if $leaves then
						if isStored or mayLeaveOut then
							producerState := PRODUCER_WAITING
						endif
					else
						if not isStored then
							r_store[]
						endif
					endif
		endswitch

	// a datum is in shared memory when its machine is left, unless it may be left out
	invariant inv_stored over producerState:
		(producerState = PRODUCER_WAITING and not mayLeaveOut) implies stored = made

	main rule r_Main =
		choose $moves in Boolean with true do
			if $moves then
				r_produce[]
			endif

default init s0:
	function producerState = PRODUCER_WAITING
	function made = 0
	function stored = 0
	function isStored = true
	function mayLeaveOut = isImpatient
