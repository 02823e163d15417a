/* Made from Producer.chart. The rules of its machines and the domains of its control states are written
   anew from there; all else is kept. */
asm Producer

import StandardLibrary

signature:
	abstract domain Scheduler
	static scheduler1: Scheduler
	// the control states
	enum domain PhaseState = {WAITING | ELABORATING | PRODUCER_WRITING}
	controlled phase: Scheduler -> PhaseState
	// the control states
	enum domain Sb_ctrlState = {WRITING | MANAGING_SB}
	controlled sb_ctrlState: Scheduler -> Sb_ctrlState
	// to be refined
	monitored trigger: Scheduler -> Boolean
	// Elaboration time elapsed
	monitored tElapsed: Scheduler -> Boolean
	// Swinging buffer managed
	monitored swingingBufferManaged: Scheduler -> Boolean

definitions:
	// to be refined
	rule r_elaborate($c in Scheduler) = skip

	// WRITE
	rule r_write($c in Scheduler) = skip

	// MANAGE SWINGING BUFFER
	rule r_manageSb($c in Scheduler) = skip

	// RELEASE SWINGING BUFFER
	rule r_releaseSb($c in Scheduler) = skip

	// Data producer
	rule r_producer($c in Scheduler) =
		par
			// Waiting for trigger
			if phase($c) = WAITING then
				if trigger($c) then
					par
						r_elaborate[$c]
						phase($c) := ELABORATING
					endpar
				endif
			endif
			// Elaborating
			if phase($c) = ELABORATING then
				if tElapsed($c) then
					par
						r_async_master_writing[$c]
						phase($c) := PRODUCER_WRITING
					endpar
				endif
			endif
			// Write
			if phase($c) = PRODUCER_WRITING then
				if isUndef(sb_ctrlState($c)) then
					phase($c) := WAITING
				else
					r_async_master_writing[$c]
				endif
			endif
		endpar

	// Asynchronous master writing
	rule r_async_master_writing($c in Scheduler) =
		par
			// entering
			if isUndef(sb_ctrlState($c)) then
				par
					r_write[$c]
					sb_ctrlState($c) := WRITING
				endpar
			endif
			// Writing
			if sb_ctrlState($c) = WRITING then
				if tElapsed($c) then
					par
						r_manageSb[$c]
						sb_ctrlState($c) := MANAGING_SB
					endpar
				endif
			endif
			// Managing swinging buffer
			if sb_ctrlState($c) = MANAGING_SB then
				if swingingBufferManaged($c) then
					par
						r_releaseSb[$c]
						sb_ctrlState($c) := undef // exit
					endpar
				else
					par
						r_manageSb[$c]
						sb_ctrlState($c) := MANAGING_SB
					endpar
				endif
			endif
		endpar

	main rule r_Main =
		forall $c in Scheduler with true do r_producer[$c]

default init s0:
	function phase($c in Scheduler) = WAITING
