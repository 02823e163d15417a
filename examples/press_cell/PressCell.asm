/* Made from PressCell.chart. The elements, the main rule, the initial state and what comes from its components' machines are written
   anew from there; all else is kept. */
asm PressCell

import StandardLibrary
import CTLLibrary
import LTLLibrary
import ../../library/std/StandardLibrary
import ../../library/patterns/ControlTask
import PressData
import ../../library/patterns/DataAges

signature:
	static gauge: Scheduler
	static gauge_task: Task
	static controller: Scheduler
	static controller_task: Task
	static drive: Scheduler
	static drive_task: Task
	static position: SwingingBuffer
	static position_lock: Semaphore
	static command: SwingingBuffer
	static command_lock: Semaphore
	static gauge_sense: SchedulePhase
	static gauge_write_position: SchedulePhase
	static gauge_wait: SchedulePhase
	static controller_read_position: SchedulePhase
	static controller_decide: SchedulePhase
	static controller_write_command: SchedulePhase
	static controller_wait: SchedulePhase
	static drive_read_command: SchedulePhase
	static drive_move: SchedulePhase
	static drive_wait: SchedulePhase
	static bound1_hop1: AgeHop
	static bound1_hop2: AgeHop
	static bound1_way1: AgeWay
	// what the data of position say, by their numbers
	controlled position_value: Integer -> Position
	// what the data of command say, by their numbers
	controlled command_value: Integer -> Command
	// Height
	monitored height: Position
	controlled gauge_position: Position
	// Start button
	monitored start: Boolean
	// Light curtain
	monitored curtain: Boolean
	// Acknowledge button
	monitored acknowledge: Boolean
	// Lamp
	out lamp: Boolean
	derived controller_position: Position
	derived controller_isNewPosition: Boolean
	controlled controller_command: Command
	controlled controller_done: Boolean
	enum domain ControllerModeState = {CONTROLLER_IDLE | CONTROLLER_LOWERING | CONTROLLER_RAISING | CONTROLLER_STOPPED}
	controlled controller_mode: ControllerModeState
	controlled controller_workingLeft: ControllerModeState

definitions:
	// what each task does when it is its turn
	rule r_controlTask = r_scheduler_execute[self]

	invariant inv_patterns over sem_state, indexRead: patternsSound

	invariant inv_deadlines over task_deadlinesMissed: (forall $t in Task with task_deadlinesMissed($t) = 0)

	invariant inv_age1_height_to_motor over way_tooOld: way_tooOld(bound1_way1) = 0

	// a step of Gauge, the machine of gauge
	rule r_gauge_Main = gauge_position := height

	// the end of gauge_sense
	rule r_end_gauge_sense =
		seq
			r_gauge_Main[]
			position_value(sb_written(position) + 1) := gauge_position
		endseq

	rule r_controller_press =
		par
			// Idle
			if controller_mode = CONTROLLER_IDLE then
				if start and not curtain then
					par
						controller_done := false
						lamp := true
						controller_mode := CONTROLLER_LOWERING
					endpar
				endif
			endif
			// Lowering
			if controller_mode = CONTROLLER_LOWERING then
				if curtain then
					par
						lamp := false
						controller_workingLeft := CONTROLLER_LOWERING
						controller_mode := CONTROLLER_STOPPED
					endpar
				else
					if controller_isNewPosition and controller_position = LOW then
						controller_mode := CONTROLLER_RAISING
					endif
				endif
			endif
			// Raising
			if controller_mode = CONTROLLER_RAISING then
				if curtain then
					par
						lamp := false
						controller_workingLeft := CONTROLLER_RAISING
						controller_mode := CONTROLLER_STOPPED
					endpar
				else
					if controller_isNewPosition and controller_position = HIGH then
						par
							controller_done := true
							lamp := false
							controller_workingLeft := CONTROLLER_RAISING
							controller_mode := CONTROLLER_IDLE
						endpar
					endif
				endif
			endif
			// Stopped
			if controller_mode = CONTROLLER_STOPPED then
				if acknowledge and not curtain then
					if controller_workingLeft = CONTROLLER_RAISING then
						par
							lamp := true
							controller_mode := CONTROLLER_RAISING
						endpar
					else
						par
							lamp := true
							controller_mode := CONTROLLER_LOWERING
						endpar
					endif
				endif
			endif
		endpar

	rule r_controller_drive =
		if curtain or controller_mode = CONTROLLER_IDLE or controller_mode = CONTROLLER_STOPPED then
			controller_command := HOLD
		else
			if controller_mode = CONTROLLER_LOWERING then
				controller_command := LOWER
			else
				controller_command := RAISE
			endif
		endif

	// a step of Press, the machine of controller
	rule r_controller_Main =
		par
			r_controller_press[]
			r_controller_drive[]
		endpar

	// what was read from position
	function controller_position = position_value(sb_receivedSequence(position))

	// it was not there in the elaboration before: position
	function controller_isNewPosition = sb_fresh(position)

	// the end of controller_decide
	rule r_end_controller_decide =
		seq
			r_controller_Main[]
			command_value(sb_written(command) + 1) := controller_command
		endseq

	// what is computed when an elaboration ends
	rule r_endOfElaboration($p in SchedulePhase) =
		switch $p
			case gauge_sense: r_end_gauge_sense[]
			case controller_decide: r_end_controller_decide[]
		endswitch

	// what each task does when it is its turn
	rule r_computingTask =
		par
			r_scheduler_execute[self]
			if action(scheduler_currentPhase(self)) = ELABORATING then
				if tElapsed(self) then r_endOfElaboration[scheduler_currentPhase(self)] endif
			endif
		endpar

	main rule r_Main =
		seq
			par
				forall $c in Scheduler with true do program($c)
				forall $s in Semaphore with true do r_sem_arbitrate[$s]
				clock := clock + 1
			endpar
			r_ages[]
		endseq

default init s0:
	function clock = 0
	function task_kind($t in Task) = SYNCHRONOUS
	function task_period($t in Task) =
		switch $t
			case controller_task: 20
			otherwise 10
		endswitch
	function task_timeForElaboration($t in Task) =
		switch $t
			case controller_task: 10
			otherwise 4
		endswitch
	function task_periodStart($t in Task) =
		switch $t
			case controller_task: -20
			otherwise -10
		endswitch
	function task_timeInWait($t in Task) = 0
	function task_cycles($t in Task) = 0
	function task_deadlinesMet($t in Task) = 0
	function task_deadlinesMissed($t in Task) = 0
	function task_totalWait($t in Task) = 0
	function task_longestWait($t in Task) = 0
	function task_skipped($t in Task) = 0
	function sem_permits($s in Semaphore) = 1
	function sem_users($s in Semaphore) =
		switch $s
			case position_lock: [gauge_task, controller_task]
			otherwise [drive_task, controller_task]
		endswitch
	function sem_state($s in Semaphore, $t in Task) = READY
	function sem_illegalPost($s in Semaphore) = false
	function semaq($s in Semaphore) = []
	function dimension($b in SwingingBuffer) = 2
	function sem($b in SwingingBuffer) =
		switch $b
			case position: position_lock
			otherwise command_lock
		endswitch
	function sb_master($b in SwingingBuffer) =
		switch $b
			case position: controller_read_position
			otherwise controller_write_command
		endswitch
	function indexWrite($b in SwingingBuffer) = 0
	function indexRead($b in SwingingBuffer) = 1
	function indexUpdated($b in SwingingBuffer) = false
	function sb_pending($b in SwingingBuffer) = false
	function sb_fresh($b in SwingingBuffer) = false
	function sb_sequence($b in SwingingBuffer, $n in ArrayIndex) = 0
	function sb_receivedSequence($b in SwingingBuffer) = 0
	function sb_written($b in SwingingBuffer) = 0
	function sb_swaps($b in SwingingBuffer) = 0
	function sb_delivered($b in SwingingBuffer) = 0
	function sb_overwritten($b in SwingingBuffer) = 0
	function sb_unread($b in SwingingBuffer) = 0
	function sb_dropped($b in SwingingBuffer) = 0
	function scheduler_mainThread($c in Scheduler) =
		switch $c
			case gauge: gauge_task
			case controller: controller_task
			otherwise drive_task
		endswitch
	function scheduler_currentPhase($c in Scheduler) =
		switch $c
			case gauge: gauge_wait
			case controller: controller_wait
			otherwise drive_wait
		endswitch
	function scheduler_actionStart($c in Scheduler) = 0
	function action($p in SchedulePhase) =
		switch $p
			case gauge_sense: ELABORATING
			case gauge_write_position: WRITING_ON_SB
			case controller_read_position: READING_FROM_SB
			case controller_decide: ELABORATING
			case controller_write_command: WRITING_ON_SB
			case drive_read_command: READING_FROM_SB
			case drive_move: ELABORATING
			otherwise WAITING_TRIGGER
		endswitch
	function time($p in SchedulePhase) =
		switch $p
			case gauge_sense: 2
			case controller_decide: 4
			case drive_move: 2
			otherwise 1
		endswitch
	function nextPhase($p in SchedulePhase) =
		switch $p
			case gauge_sense: gauge_write_position
			case gauge_write_position: gauge_wait
			case gauge_wait: gauge_sense
			case controller_read_position: controller_decide
			case controller_decide: controller_write_command
			case controller_write_command: controller_wait
			case controller_wait: controller_read_position
			case drive_read_command: drive_move
			case drive_move: drive_wait
			otherwise drive_read_command
		endswitch
	function sharedMemory($p in SchedulePhase) =
		switch $p
			case gauge_write_position: position
			case controller_read_position: position
			case controller_write_command: command
			case drive_read_command: command
			otherwise undef
		endswitch
	function elaborationRule($p in SchedulePhase) = undef
	function hop_before($h in AgeHop) =
		switch $h
			case bound1_hop2: bound1_hop1
			otherwise undef
		endswitch
	function hop_writer($h in AgeHop) =
		switch $h
			case bound1_hop1: gauge
			otherwise controller
		endswitch
	function hop_decided($h in AgeHop) =
		switch $h
			case bound1_hop1: gauge_sense
			otherwise controller_decide
		endswitch
	function hop_buffer($h in AgeHop) =
		switch $h
			case bound1_hop1: position
			otherwise command
		endswitch
	function hop_queue($h in AgeHop) = undef
	function hop_value($h in AgeHop) = undef
	function way_hop($w in AgeWay) = bound1_hop2
	function way_end($w in AgeWay) = drive
	function way_decided($w in AgeWay) = drive_move
	function way_limit($w in AgeWay) = 36
	function phaseBefore($c in Scheduler) =
		switch $c
			case gauge: gauge_wait
			case controller: controller_wait
			otherwise drive_wait
		endswitch
	function hop_written($h in AgeHop) = 0
	function hop_read($h in AgeHop) = 0
	function way_oldest($w in AgeWay) = 0
	function way_tooOld($w in AgeWay) = 0
	function gauge_position = BETWEEN
	function controller_mode = CONTROLLER_IDLE
	function lamp = false
	function controller_command = HOLD
	function controller_done = true
	agent Scheduler: r_computingTask[]
