/* Faults seeded into the machines of tasks on swinging buffers: each is one that a programmer makes, and each has to be
   found. The fault is chosen by the environment in the initial state; `--bound seeded=SWAPS_BACK` takes one. */
module BufferFaults

import ../std/StandardLibrary
import ../patterns/ControlTask

export *

signature:
	enum domain Fault = {
		NONE | SLAVE_WITHOUT_LOCK | MASTER_WITHOUT_LOCK | SWAP_FORGOTTEN | SWAPS_BACK | RELEASE_FORGOTTEN |
		RELEASED_TOO_SOON | LOSS_NOT_COUNTED | DROP_NOT_COUNTED | WATCHDOG_IGNORED | HUNG_UNWATCHED | WAITS_IN_VAIN |
		NEW_TWICE | NEW_AFTER_SKIP | MARKED_FOR_ALL}

	monitored seeded: Fault
	controlled fault: Fault

	derived here: Scheduler -> SwingingBuffer
	derived onBuffer: Scheduler -> Boolean
	derived isManaging: Scheduler -> Boolean
	derived asMaster: Scheduler -> Boolean
	derived asWriter: Scheduler -> Boolean
	derived lockState: Scheduler -> TaskCSState

definitions:
	function here($c in Scheduler) =
		sharedMemory(scheduler_currentPhase($c))

	function onBuffer($c in Scheduler) =
		contains({WRITING_ON_SB, READING_FROM_SB}, action(scheduler_currentPhase($c)))

	function isManaging($c in Scheduler) =
		if onBuffer($c) then sb_ctrlState(scheduler_currentPhase($c)) = MANAGING_SB else false endif

	function asMaster($c in Scheduler) =
		syncPriority(scheduler_currentPhase($c)) = MASTER

	function asWriter($c in Scheduler) =
		action(scheduler_currentPhase($c)) = WRITING_ON_SB

	function lockState($c in Scheduler) =
		sem_state(sem(here($c)), scheduler_mainThread($c))

	rule r_leaveWithoutLock($c in Scheduler) =
		if tElapsed($c) then
			par
				if asWriter($c) then
					r_SwingingBuffer_endWrite[here($c)]
				else
					r_SwingingBuffer_endRead[here($c)]
				endif
				r_SwingingBuffer_giveUp[here($c), scheduler_mainThread($c)]
				r_leavePattern[$c]
			endpar
		endif

	// The slave begins its action without asking, and so has nothing to release.
	rule r_slaveWithoutLock($c in Scheduler) =
		if not onBuffer($c) then
			r_scheduler_execute[$c]
		else
			if asMaster($c) or isUndef(sb_ctrlState(scheduler_currentPhase($c))) then
				r_scheduler_execute[$c]
			else
				if isManaging($c) then
					if asWriter($c) then
						r_startWriting[$c, scheduler_currentPhase($c)]
					else
						r_startReading[$c, scheduler_currentPhase($c)]
					endif
				else
					r_leaveWithoutLock[$c]
				endif
			endif
		endif

	// The master updates the indexes and is inside, whoever else is.
	rule r_masterWithoutLock($c in Scheduler) =
		if isManaging($c) and asMaster($c) and not indexUpdated(here($c)) then
			par
				sem_state(sem(here($c)), scheduler_mainThread($c)) := EXECUTION
				r_SwingingBuffer_updateIndexes[here($c)]
			endpar
		else
			r_scheduler_execute[$c]
		endif

	// The master's index section, with another body.
	rule r_atIndexSection($c in Scheduler, $body in Rule(SwingingBuffer)) =
		if isManaging($c) and asMaster($c) and lockGranted($c) then
			par
				r_SwingingBuffer_getLock[here($c), scheduler_mainThread($c)]
				indexUpdated(here($c)) := true
				$body[here($c)]
			endpar
		else
			r_scheduler_execute[$c]
		endif

	rule r_swapAnyway($b in SwingingBuffer) =
		par
			indexRead($b) := indexWrite($b)
			indexWrite($b) := (indexWrite($b) + 1) mod dimension($b)
			sb_pending($b) := false
			if sb_pending($b) then
				sb_swaps($b) := sb_swaps($b) + 1
			endif
		endpar

	rule r_swapUncounted($b in SwingingBuffer) =
		if sb_pending($b) then
			r_swapAnyway[$b]
		endif

	rule r_noSwap($b in SwingingBuffer) = skip

	rule r_releaseForgotten($c in Scheduler) =
		if isManaging($c) and asMaster($c) and indexUpdated(here($c)) then
			par
				indexUpdated(here($c)) := false
				if asWriter($c) then
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
		if isManaging($c) and asMaster($c) and indexUpdated(here($c)) and lockState($c) = EXECUTION then
			r_SwingingBuffer_releaseLock[here($c), scheduler_mainThread($c)]
		else
			r_scheduler_execute[$c]
		endif

	rule r_dropNotCounted($c in Scheduler) =
		if isManaging($c) and not asMaster($c) and asWriter($c) and givesUp($c) then
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
			if not asMaster($c) then
				r_async_slave_action[$c]
			else
				if asWriter($c) then
					r_async_master_writing[$c]
				else
					r_async_master_reading[$c]
				endif
			endif
		else
			r_scheduler_execute[$c]
		endif

	// Nobody releases, and nobody watches.
	rule r_hungUnwatched($c in Scheduler) =
		if isManaging($c) and asMaster($c) and indexUpdated(here($c)) then
			r_releaseForgotten[$c]
		else
			r_watchdogIgnored[$c]
		endif

	// Having asked once a task waits to be told, and nobody does.
	rule r_waitsInVain($c in Scheduler) =
		if isManaging($c) and lockState($c) != WAITING or not isManaging($c) then
			r_scheduler_execute[$c]
		endif

	// Whoever reads says that it is new.
	rule r_newTwice($c in Scheduler) =
		let ($b = here($c)) in
			seq
				r_scheduler_execute[$c]
				if isDef($b) then
					if isDef(sb_readingArray($b)) then
						sb_fresh($b) := true
					endif
				endif
			endseq
		endlet

	// A reader that goes on without its reading leaves the mark as it was.
	rule r_newAfterSkip($c in Scheduler) =
		if isManaging($c) and not asMaster($c) and not asWriter($c) and givesUp($c) then
			par
				r_giveUpSb[$c]
				r_leavePattern[$c]
			endpar
		else
			r_scheduler_execute[$c]
		endif

	// Of a broadcast, one reader marks the datum as read for the other ones, too.
	rule r_markedForAll($c in Scheduler) =
		let ($wasManaging = isManaging($c), $b = here($c)) in
			seq
				r_scheduler_execute[$c]
				if $wasManaging and not asWriter($c) and not isManaging($c) then
					forall $o in SwingingBuffer with $o != $b do
						sb_receivedSequence($o) := sb_newestSequence($o)
				endif
			endseq
		endlet

	rule r_faulty($c in Scheduler) =
		switch fault
			case NONE: r_scheduler_execute[$c]
			case SLAVE_WITHOUT_LOCK: r_slaveWithoutLock[$c]
			case MASTER_WITHOUT_LOCK: r_masterWithoutLock[$c]
			case SWAP_FORGOTTEN: r_atIndexSection[$c, <<r_noSwap(SwingingBuffer)>>]
			case SWAPS_BACK: r_atIndexSection[$c, <<r_swapAnyway(SwingingBuffer)>>]
			case LOSS_NOT_COUNTED: r_atIndexSection[$c, <<r_swapUncounted(SwingingBuffer)>>]
			case RELEASE_FORGOTTEN: r_releaseForgotten[$c]
			case RELEASED_TOO_SOON: r_releasedTooSoon[$c]
			case DROP_NOT_COUNTED: r_dropNotCounted[$c]
			case WATCHDOG_IGNORED: r_watchdogIgnored[$c]
			case HUNG_UNWATCHED: r_hungUnwatched[$c]
			case WAITS_IN_VAIN: r_waitsInVain[$c]
			case NEW_TWICE: r_newTwice[$c]
			case NEW_AFTER_SKIP: r_newAfterSkip[$c]
			case MARKED_FOR_ALL: r_markedForAll[$c]
		endswitch
