/* Faults seeded into the machines of a pair: each is one that a programmer makes, and each has to be found. The fault is
   chosen by the environment in the initial state; `--bound seeded=SWAPS_BACK` takes one. */
module PairFaults

import ../std/StandardLibrary
import ../std/CTLLibrary
import ../patterns/ControlTask
import BufferPair

export *

signature:
	enum domain Fault = {
		SLAVE_WITHOUT_LOCK | MASTER_WITHOUT_LOCK | SWAP_FORGOTTEN | SWAPS_BACK | RELEASE_FORGOTTEN | RELEASED_TOO_SOON |
		LOSS_NOT_COUNTED | DROP_NOT_COUNTED | WATCHDOG_IGNORED | WAITS_IN_VAIN}

	monitored seeded: Fault
	controlled fault: Fault

	derived isManaging: Scheduler -> Boolean

definitions:
	function isManaging($c in Scheduler) =
		if contains({WRITING_ON_SB, READING_FROM_SB}, action(scheduler_currentPhase($c))) then
			sb_ctrlState(scheduler_currentPhase($c)) = MANAGING_SB
		else
			false
		endif

	// The slave begins its action without asking, and so has nothing to release.
	rule r_slaveWithoutLock($c in Scheduler) =
		if isManaging($c) and $c != master then
			if $c = producer then
				r_startWriting[$c, scheduler_currentPhase($c)]
			else
				r_startReading[$c, scheduler_currentPhase($c)]
			endif
		else
			if $c != master and isDef(sb_ctrlState(scheduler_currentPhase($c))) and not isInside($c) then
				par
					if $c = producer then
						r_SwingingBuffer_endWrite[buffer]
					else
						r_SwingingBuffer_endRead[buffer]
					endif
					r_SwingingBuffer_giveUp[buffer, owner($c)]
					r_leavePattern[$c]
				endpar
			else
				r_scheduler_execute[$c]
			endif
		endif

	// The master updates the indexes and is inside, whoever else is.
	rule r_masterWithoutLock($c in Scheduler) =
		if isManaging($c) and $c = master and not indexUpdated(buffer) then
			par
				sem_state(lock, owner($c)) := EXECUTION
				r_SwingingBuffer_updateIndexes[buffer]
			endpar
		else
			r_scheduler_execute[$c]
		endif

	// The master's index section, with another body.
	rule r_atIndexSection($c in Scheduler, $body in Rule(Scheduler)) =
		if isManaging($c) and $c = master and lockGranted($c) then
			par
				r_SwingingBuffer_getLock[buffer, owner($c)]
				indexUpdated(buffer) := true
				$body[$c]
			endpar
		else
			r_scheduler_execute[$c]
		endif

	rule r_swapAnyway($c in Scheduler) =
		par
			indexRead(buffer) := indexWrite(buffer)
			indexWrite(buffer) := (indexWrite(buffer) + 1) mod dimension(buffer)
			sb_pending(buffer) := false
			if sb_pending(buffer) then
				sb_swaps(buffer) := sb_swaps(buffer) + 1
			endif
		endpar

	rule r_swapUncounted($c in Scheduler) =
		if sb_pending(buffer) then
			r_swapAnyway[$c]
		endif

	rule r_noSwap($c in Scheduler) = skip

	rule r_releaseForgotten($c in Scheduler) =
		if isManaging($c) and $c = master and indexUpdated(buffer) then
			par
				indexUpdated(buffer) := false
				if $c = producer then
					r_leavePattern[$c]
				else
					r_startReading[$c, scheduler_currentPhase($c)]
				endif
			endpar
		else
			r_scheduler_execute[$c]
		endif

	// The lock is left before the index section is.
	rule r_releasedTooSoon($c in Scheduler) =
		if isManaging($c) and $c = master and indexUpdated(buffer) and isInside($c) then
			r_SwingingBuffer_releaseLock[buffer, owner($c)]
		else
			r_scheduler_execute[$c]
		endif

	rule r_dropNotCounted($c in Scheduler) =
		if isManaging($c) and $c != master and $c = producer and givesUp($c) then
			par
				r_giveUpSb[$c]
				r_leavePattern[$c]
			endpar
		else
			r_scheduler_execute[$c]
		endif

	// The machine of an asynchronous task in a synchronous one.
	rule r_watchdogIgnored($c in Scheduler) =
		if isManaging($c) then
			if $c != master then
				r_async_slave_action[$c]
			else
				if $c = producer then
					r_async_master_writing[$c]
				else
					r_async_master_reading[$c]
				endif
			endif
		else
			r_scheduler_execute[$c]
		endif

	// Having asked once a task waits to be told, and nobody does.
	rule r_waitsInVain($c in Scheduler) =
		if isManaging($c) and not isWaiting($c) or not isManaging($c) then
			r_scheduler_execute[$c]
		endif

	rule r_faulty($c in Scheduler) =
		switch fault
			case SLAVE_WITHOUT_LOCK: r_slaveWithoutLock[$c]
			case MASTER_WITHOUT_LOCK: r_masterWithoutLock[$c]
			case SWAP_FORGOTTEN: r_atIndexSection[$c, <<r_noSwap(Scheduler)>>]
			case SWAPS_BACK: r_atIndexSection[$c, <<r_swapAnyway(Scheduler)>>]
			case LOSS_NOT_COUNTED: r_atIndexSection[$c, <<r_swapUncounted(Scheduler)>>]
			case RELEASE_FORGOTTEN: r_releaseForgotten[$c]
			case RELEASED_TOO_SOON: r_releasedTooSoon[$c]
			case DROP_NOT_COUNTED: r_dropNotCounted[$c]
			case WATCHDOG_IGNORED: r_watchdogIgnored[$c]
			case WAITS_IN_VAIN: r_waitsInVain[$c]
		endswitch
