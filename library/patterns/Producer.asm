/* The output side of a data producer: after the trigger and the elaboration (both in ControlTask) it
   writes to its swinging buffer, by the machine for its kind and role, sends a message, or stores a value. */
module Producer

import ../std/StandardLibrary
import Task
import MessageQueue
import SharedValue
import Scheduler
import PatternMachines

export *

signature:

definitions:
	rule r_produceOnSb($c in Scheduler) =
		if task_kind(scheduler_mainThread($c)) = SYNCHRONOUS then
			if syncPriority(scheduler_currentPhase($c)) = MASTER then
				r_sync_master_writing[$c]
			else
				r_sync_slave_action[$c]
			endif
		else
			if syncPriority(scheduler_currentPhase($c)) = MASTER then
				r_async_master_writing[$c]
			else
				r_async_slave_action[$c]
			endif
		endif

	// Waits for room in the queue, unless a deadline forbids it: the message is then refused.
	rule r_produceMessage($c in Scheduler) =
		if mq_isFull(messageQueue(scheduler_currentPhase($c))) and thereIsTime(scheduler_mainThread($c)) then
			r_task_wait[scheduler_mainThread($c)]
		else
			par
				r_mq_send[messageQueue(scheduler_currentPhase($c))]
				r_leavePhase[$c]
			endpar
		endif

	// The value is there for the reader when the time of the phase is over.
	rule r_produceValue($c in Scheduler) =
		if tElapsed($c) then
			par
				r_sv_write[sharedValue(scheduler_currentPhase($c))]
				r_leavePhase[$c]
			endpar
		endif
