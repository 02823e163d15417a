/* A control task, ready to use: trigger, elaboration, producer and consumer in one machine. An
   application imports this module, gives the configuration in its init section, and steps

     main rule r_Main =
       par
         forall $c in Scheduler with true do program($c)     // or r_scheduler_execute[$c]
         forall $s in Semaphore with true do r_sem_arbitrate[$s]
         clock := clock + 1
       endpar
*/
module ControlTask

import ../std/StandardLibrary
import Task
import Semaphore
import SwingingBuffer
import MessageQueue
import SharedValue
import Scheduler
import PatternMachines
import Producer
import Consumer

export *

signature:
	derived patternsSound: Boolean

definitions:
	// What every application of the patterns has to keep, in every state.
	function patternsSound =
		(forall $s in Semaphore with sem_sound($s))
		and (forall $b in SwingingBuffer with sb_disjoint($b) and sb_newest($b) and sb_accounted($b))
		and (forall $q in MessageQueue with mq_sound($q))
		and (forall $v in SharedValue with sv_sound($v))

	rule r_scheduler_execute($c in Scheduler) =
		switch action(scheduler_currentPhase($c))
			case WAITING_TRIGGER:
				r_waitTrigger[$c]
			case ELABORATING:
				if tElapsed($c) then
					r_leavePhase[$c]
				endif
			case WRITING_ON_SB:
				r_produceOnSb[$c]
			case READING_FROM_SB:
				r_consumeFromSb[$c]
			case SENDING:
				r_produceMessage[$c]
			case RECEIVING:
				r_consumeMessage[$c]
			case STORING:
				r_produceValue[$c]
			case LOADING:
				r_consumeValue[$c]
		endswitch
