/* A broadcast, without time: one producer writes each datum to two buffers, and each of two readers has its own. Any of the three tasks
   move in each step. The first reader is synchronous, the second one is not. One of both is the master of its buffer: which one, is asked
   for in the initial state. */
asm ReadersInterleaved

import ../std/StandardLibrary
import ../std/CTLLibrary
import ../std/LTLLibrary
import ../patterns/ControlTask
import BufferFaults
import Quotient
import SystemProperties
import SystemInterleaved
import FreshTold

signature:
	static producer: Scheduler
	static first_reader: Scheduler
	static second_reader: Scheduler
	static producer_task: Task
	static first_task: Task
	static second_task: Task
	static first_buffer: SwingingBuffer
	static second_buffer: SwingingBuffer
	static first_lock: Semaphore
	static second_lock: Semaphore
	static produce_first: SchedulePhase
	static produce_second: SchedulePhase
	static produce_wait: SchedulePhase
	static first_read: SchedulePhase
	static first_wait: SchedulePhase
	static second_read: SchedulePhase
	static second_wait: SchedulePhase

	// asked for in the initial state
	monitored firstIsMaster: Boolean

definitions:
	// the task's own rule, with the fault that is seeded, if any
	rule r_faultyTask = r_faulty[self]

	JUSTICE moved(producer_task)
	JUSTICE moved(first_task)
	JUSTICE moved(second_task)

	invariant inv_patterns over sem_state, indexRead: patternsSound

	// each reader gets something new, whatever the other one has read
	CTLSPEC ctlSpec_news: (forall $b in SwingingBuffer with ag(ef(sb_fresh($b))))
	CTLSPEC ctlSpec_firstAlone: ef(sb_fresh(first_buffer) and not sb_fresh(second_buffer))
	CTLSPEC ctlSpec_secondAlone: ef(sb_fresh(second_buffer) and not sb_fresh(first_buffer))

	main rule r_Main =
		seq
			r_move[]
			r_tellFresh[]
		endseq

default init s0:
	function clock = 0
	function task_kind($t in Task) = if $t = second_task then ASYNCHRONOUS else SYNCHRONOUS endif
	function task_period($t in Task) = 1
	function task_deadline($t in Task) = 1
	function task_timeForElaboration($t in Task) = 0
	function task_periodStart($t in Task) = 0
	function task_timeInWait($t in Task) = 0
	function task_cycles($t in Task) = 0
	function task_deadlinesMet($t in Task) = 0
	function task_deadlinesMissed($t in Task) = 0
	function task_totalWait($t in Task) = 0
	function task_longestWait($t in Task) = 0
	function task_skipped($t in Task) = 0

	function sem_permits($s in Semaphore) = 1
	function sem_users($s in Semaphore) =
		if $s = first_lock then [producer_task, first_task] else [producer_task, second_task] endif
	function sem_state($s in Semaphore, $t in Task) = READY
	function sem_illegalPost($s in Semaphore) = false
	function semaq($s in Semaphore) = []

	function dimension($b in SwingingBuffer) = 2
	function sem($b in SwingingBuffer) = if $b = first_buffer then first_lock else second_lock endif
	function sb_master($b in SwingingBuffer) =
		if $b = first_buffer then
			if firstIsMaster then first_read else produce_first endif
		else
			if firstIsMaster then produce_second else second_read endif
		endif
	function indexWrite($b in SwingingBuffer) = 0
	function indexRead($b in SwingingBuffer) = 1
	function indexUpdated($b in SwingingBuffer) = false
	function sb_pending($b in SwingingBuffer) = false
	function sb_sequence($b in SwingingBuffer, $n in ArrayIndex) = 0
	function sb_receivedSequence($b in SwingingBuffer) = 0
	function sb_fresh($b in SwingingBuffer) = false
	function sb_written($b in SwingingBuffer) = 0
	function sb_swaps($b in SwingingBuffer) = 0
	function sb_delivered($b in SwingingBuffer) = 0
	function sb_overwritten($b in SwingingBuffer) = 0
	function sb_unread($b in SwingingBuffer) = 0
	function sb_dropped($b in SwingingBuffer) = 0

	function scheduler_mainThread($c in Scheduler) =
		switch $c
			case producer: producer_task
			case first_reader: first_task
			otherwise second_task
		endswitch
	function scheduler_currentPhase($c in Scheduler) =
		switch $c
			case producer: produce_wait
			case first_reader: first_wait
			otherwise second_wait
		endswitch
	function scheduler_actionStart($c in Scheduler) = 0
	function action($p in SchedulePhase) =
		switch $p
			case produce_first: WRITING_ON_SB
			case produce_second: WRITING_ON_SB
			case first_read: READING_FROM_SB
			case second_read: READING_FROM_SB
			otherwise WAITING_TRIGGER
		endswitch
	function time($p in SchedulePhase) = 0
	function nextPhase($p in SchedulePhase) =
		switch $p
			case produce_first: produce_second
			case produce_second: produce_wait
			case produce_wait: produce_first
			case first_read: first_wait
			case first_wait: first_read
			case second_read: second_wait
			otherwise second_read
		endswitch
	function sharedMemory($p in SchedulePhase) =
		switch $p
			case produce_first: first_buffer
			case produce_second: second_buffer
			case first_read: first_buffer
			case second_read: second_buffer
			case second_wait: second_buffer
			otherwise undef
		endswitch
	function elaborationRule($p in SchedulePhase) = undef

	// who moves, what is observed, what is seeded
	function takesPart($t in Task) = true
	function moved($t in Task) = false
	function handedOver($b in SwingingBuffer) = 0
	function unaccounted($b in SwingingBuffer) = 0
	function before_read($b in SwingingBuffer) = indexRead($b)
	function before_written($b in SwingingBuffer) = 0
	function before_phase($c in Scheduler) = scheduler_currentPhase($c)
	function mustBeFresh($b in SwingingBuffer) = false
	function isUnread($b in SwingingBuffer) = false
	function wasPending($b in SwingingBuffer) = false
	function wasReading($b in SwingingBuffer) = false
	function wasAt($c in Scheduler) = scheduler_currentPhase($c)
	function fault = seeded

	agent Scheduler: r_faultyTask[]
