/* The six pattern machines for reading from and writing to a swinging buffer, one for each kind of
   task and role. Each is one rule, stepped once a tick while its phase is the current one; the
   entering arrow is the guard `outsidePatternMachine`, the exit arrow `r_leavePattern`.

                      master writing          master reading           slave (both directions)
     asynchronous     write, manage, release  manage, release + read   manage, read/write, release
     synchronous      the same, but the watchdog ends the waiting for the lock:
                      leave without swapping  read the old array       leave without the action  */
module PatternMachines

import ../std/StandardLibrary
import Task
import Semaphore
import SwingingBuffer
import Scheduler

export *

signature:
	derived givesUp: Scheduler -> Boolean

definitions:
	// The watchdog's arrow of a synchronous machine: still without the lock, and no time left.
	function givesUp($c in Scheduler) =
		if sb_ctrlState(scheduler_currentPhase($c)) = MANAGING_SB then
			if swingingBufferManaged($c) then false else watchdog($c) endif
		else
			false
		endif

	// The exit arrow. Undef and the move to the next phase belong to one step, see Scheduler.
	rule r_leavePattern($c in Scheduler) =
		par
			sb_ctrlState(scheduler_currentPhase($c)) := undef
			r_leavePhase[$c]
		endpar

	// The machine is left from outside, as by an emergency stop, in whatever state it is: its task keeps nothing. Who leaves it
	// sets the control state to undef, and says where the task goes on.
	rule r_abortPattern($c in Scheduler) =
		let ($b = sharedMemory(scheduler_currentPhase($c)), $t = scheduler_mainThread($c)) in
			par
				switch sb_ctrlState(scheduler_currentPhase($c))
					case WRITING: r_SwingingBuffer_cutOffWrite[$b]
					case READING: r_SwingingBuffer_endRead[$b]
				endswitch
				if sem_state(sem($b), $t) = EXECUTION then
					r_releaseSb[$c]
				else
					r_SwingingBuffer_giveUp[$b, $t]
				endif
			endpar
		endlet

	// The lock is busy, or just granted: try again. Only the busy one counts as waiting.
	rule r_retryManaging($c in Scheduler) =
		par
			r_manageSb[$c, scheduler_currentPhase($c)]
			if not lockGranted($c) then
				r_task_wait[scheduler_mainThread($c)]
			endif
		endpar

	rule r_finishWriting($c in Scheduler) =
		if tElapsed($c) then
			par
				r_SwingingBuffer_endWrite[sharedMemory(scheduler_currentPhase($c))]
				r_startManaging[$c, scheduler_currentPhase($c)]
			endpar
		endif

	rule r_finishReading($c in Scheduler) =
		if tElapsed($c) then
			par
				r_SwingingBuffer_endRead[sharedMemory(scheduler_currentPhase($c))]
				r_leavePattern[$c]
			endpar
		endif

	rule r_async_master_writing($c in Scheduler) =
		if outsidePatternMachine($c) then
			r_startWriting[$c, scheduler_currentPhase($c)]
		else
			switch sb_ctrlState(scheduler_currentPhase($c))
				case WRITING:
					r_finishWriting[$c]
				case MANAGING_SB:
					if swingingBufferManaged($c) then
						par
							r_releaseSb[$c]
							r_leavePattern[$c]
						endpar
					else
						r_retryManaging[$c]
					endif
			endswitch
		endif

	rule r_async_master_reading($c in Scheduler) =
		if outsidePatternMachine($c) then
			r_startManaging[$c, scheduler_currentPhase($c)]
		else
			switch sb_ctrlState(scheduler_currentPhase($c))
				case MANAGING_SB:
					if swingingBufferManaged($c) then
						par
							r_releaseSb[$c]
							r_startReading[$c, scheduler_currentPhase($c)]
						endpar
					else
						r_retryManaging[$c]
					endif
				case READING:
					r_finishReading[$c]
			endswitch
		endif

	// The datum stays in the array, pending: the next swap hands it over, unless the next writing
	// comes first, which is then counted as overwritten.
	rule r_sync_master_writing($c in Scheduler) =
		if givesUp($c) then
			par
				r_giveUpSb[$c]
				r_leavePattern[$c]
			endpar
		else
			r_async_master_writing[$c]
		endif

	// Reading the old array needs no lock: only this task moves the index.
	rule r_sync_master_reading($c in Scheduler) =
		if givesUp($c) then
			par
				r_giveUpSb[$c]
				r_startReading[$c, scheduler_currentPhase($c)]
			endpar
		else
			r_async_master_reading[$c]
		endif

	// A slave keeps the lock as long as it works on its array.
	rule r_startSlaveAction($c in Scheduler) =
		par
			r_manageSb[$c, scheduler_currentPhase($c)]
			if action(scheduler_currentPhase($c)) = WRITING_ON_SB then
				r_startWriting[$c, scheduler_currentPhase($c)]
			else
				r_startReading[$c, scheduler_currentPhase($c)]
			endif
		endpar

	rule r_finishSlaveAction($c in Scheduler) =
		if tElapsed($c) then
			par
				if sb_ctrlState(scheduler_currentPhase($c)) = WRITING then
					r_SwingingBuffer_endWrite[sharedMemory(scheduler_currentPhase($c))]
				else
					r_SwingingBuffer_endRead[sharedMemory(scheduler_currentPhase($c))]
				endif
				r_releaseSb[$c]
				r_leavePattern[$c]
			endpar
		endif

	rule r_async_slave_action($c in Scheduler) =
		if outsidePatternMachine($c) then
			r_startManaging[$c, scheduler_currentPhase($c)]
		else
			if sb_ctrlState(scheduler_currentPhase($c)) = MANAGING_SB then
				if swingingBufferManaged($c) then
					r_startSlaveAction[$c]
				else
					r_retryManaging[$c]
				endif
			else
				r_finishSlaveAction[$c]
			endif
		endif

	rule r_sync_slave_action($c in Scheduler) =
		if givesUp($c) then
			par
				r_giveUpSb[$c]
				if action(scheduler_currentPhase($c)) = WRITING_ON_SB then
					r_SwingingBuffer_skipWrite[sharedMemory(scheduler_currentPhase($c))]
				else
					r_SwingingBuffer_skipRead[sharedMemory(scheduler_currentPhase($c))]
				endif
				r_leavePattern[$c]
			endpar
		else
			r_async_slave_action[$c]
		endif
