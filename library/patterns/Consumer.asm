/* The input side of a data consumer: after the trigger (in ControlTask) it reads from its swinging
   buffer, by the machine for its kind and role, takes a message or loads a value, and then elaborates. */
module Consumer

import ../std/StandardLibrary
import Task
import Scheduler
import PatternMachines

export *

signature:

definitions:
	rule r_consumeFromSb($c in Scheduler) =
		if task_kind(scheduler_mainThread($c)) = SYNCHRONOUS then
			if syncPriority(scheduler_currentPhase($c)) = MASTER then
				r_sync_master_reading[$c]
			else
				r_sync_slave_action[$c]
			endif
		else
			if syncPriority(scheduler_currentPhase($c)) = MASTER then
				r_async_master_reading[$c]
			else
				r_async_slave_action[$c]
			endif
		endif

	// The message was taken on entering the phase; an empty queue leaves the last one in place.
	rule r_consumeMessage($c in Scheduler) =
		if tElapsed($c) then
			r_leavePhase[$c]
		endif

	// The value was taken on entering the phase; where nothing was ever written, none.
	rule r_consumeValue($c in Scheduler) =
		if tElapsed($c) then
			r_leavePhase[$c]
		endif
