/* Made from AssemblySystem.chart. The elements, the main rule, the initial state and what comes from its components' machines are written
   anew from there; all else is kept. */
asm AssemblySystem

import CTLLibrary
import LTLLibrary
import ../../library/std/StandardLibrary
import ../../library/patterns/ControlTask
import Assembling

signature:
	static microscope: Scheduler
	static microscope_task: Task
	static aligner: Scheduler
	static aligner_task: Task
	static force: Scheduler
	static force_task: Task
	static stage: Scheduler
	static stage_task: Task
	static piezo: Scheduler
	static piezo_task: Task
	static scales_reader: Scheduler
	static scales_reader_task: Task
	static supervisor: Scheduler
	static supervisor_task: Task
	static image: SwingingBuffer
	static image_lock: Semaphore
	static recipe: SharedValue
	static correction: SwingingBuffer
	static correction_lock: Semaphore
	static guidance: SharedValue
	static contact: SharedValue
	static scale: SwingingBuffer
	static scale_lock: Semaphore
	static axis_order: SwingingBuffer
	static axis_order_lock: Semaphore
	static state: SharedValue
	static microscope_grab: SchedulePhase
	static microscope_write: SchedulePhase
	static microscope_wait: SchedulePhase
	static aligner_receive: SchedulePhase
	static aligner_read_image: SchedulePhase
	static aligner_elaborate: SchedulePhase
	static aligner_write: SchedulePhase
	static aligner_guide: SchedulePhase
	static aligner_wait: SchedulePhase
	static force_elaborate: SchedulePhase
	static force_write: SchedulePhase
	static force_wait: SchedulePhase
	static stage_read_guidance: SchedulePhase
	static stage_read_correction: SchedulePhase
	static stage_read_contact: SchedulePhase
	static stage_read_scale: SchedulePhase
	static stage_elaborate: SchedulePhase
	static stage_write_axes: SchedulePhase
	static stage_write_state: SchedulePhase
	static stage_wait: SchedulePhase
	static piezo_read: SchedulePhase
	static piezo_elaborate: SchedulePhase
	static piezo_wait: SchedulePhase
	static scales_acquire: SchedulePhase
	static scales_write: SchedulePhase
	static scales_reader_wait: SchedulePhase
	static supervisor_read: SchedulePhase
	static supervisor_elaborate: SchedulePhase
	static supervisor_send: SchedulePhase
	static supervisor_wait: SchedulePhase
	// what the data of recipe say, by their numbers
	controlled recipe_value: Integer -> Work
	// what the data of guidance say, by their numbers
	controlled guidance_value: Integer -> Prod(Work, Marks)
	// what the data of contact say, by their numbers
	controlled contact_value: Integer -> Touch
	// what the data of state say, by their numbers
	controlled state_value: Integer -> Progress
	// Detector: all marks are in the image
	monitored marked: Boolean
	// Detector: the marks make a cross
	monitored crossed: Boolean
	domain AlignerImages subsetof Integer
	derived aligner_recipe: Work
	controlled aligner_guidance: Prod(Work, Marks)
	controlled aligner_work: Work
	controlled aligner_right: AlignerImages
	static aligner_enough: AlignerImages
	derived aligner_isRight: Boolean
	// Scales: z is up
	monitored isUp: Boolean
	// What the axes are led to do
	out motion: Motion
	domain StageCycles subsetof Integer
	derived stage_guidance: Prod(Work, Marks)
	derived stage_isNewGuidance: Boolean
	derived stage_contact: Touch
	derived stage_isNewContact: Boolean
	controlled stage_state: Progress
	controlled stage_unseen: StageCycles
	static stage_patience: StageCycles
	derived stage_isSeen: Boolean
	derived stage_isGuided: Boolean
	enum domain SupervisorEnding = {SUPERVISOR_DONE | SUPERVISOR_FAILED}
	derived supervisor_state: Progress
	controlled supervisor_recipe: Work
	controlled supervisor_ending: SupervisorEnding
	// what force computes for contact
	monitored force_contact: Touch

definitions:
	// what each task does when it is its turn
	rule r_controlTask = r_scheduler_execute[self]

	invariant inv_patterns over sem_state, indexRead: patternsSound

	invariant inv_deadlines over task_deadlinesMissed: (forall $t in Task with task_deadlinesMissed($t) = 0)

	domain AlignerImages = {0 : 5}

	function aligner_enough = 5

	function aligner_isRight = marked and crossed

	rule r_aligner_order =
		par
			aligner_work := aligner_recipe
			aligner_right := 0
			aligner_guidance := (aligner_recipe, if marked then APART else HIDDEN endif)
		endpar

	rule r_aligner_look =
		if aligner_isRight then
			par
				aligner_right := min(aligner_right + 1, aligner_enough)
				aligner_guidance :=
					(aligner_work, if aligner_right + 1 >= aligner_enough then TOGETHER else APART endif)
			endpar
		else
			par
				aligner_right := 0
				aligner_guidance := (aligner_work, if marked then APART else HIDDEN endif)
			endpar
		endif

	// a step of Aligner, the machine of aligner
	rule r_aligner_Main =
		if isDef(aligner_recipe) and aligner_recipe != aligner_work then
			r_aligner_order[]
		else
			r_aligner_look[]
		endif

	// what was read from recipe
	function aligner_recipe = recipe_value(sv_receivedSequence(recipe))

	// the end of aligner_elaborate
	rule r_end_aligner_elaborate =
		seq
			r_aligner_Main[]
			guidance_value(sv_sequence(guidance) + 1) := aligner_guidance
		endseq

	domain StageCycles = {0 : 50}

	function stage_patience = 50

	function stage_isSeen = stage_isNewGuidance and second(stage_guidance) != HIDDEN

	function stage_isGuided = isDef(stage_guidance) and (stage_isSeen or stage_unseen < stage_patience)

	rule r_stage_is($state in Progress, $motion in Motion) =
		par
			stage_state := $state
			motion := $motion
		endpar

	rule r_stage_retract =
		if isUp then r_stage_is[RETRACTED, STAND] else r_stage_is[RETRACTING, UP] endif

	rule r_stage_align =
		r_stage_is[
			if second(stage_guidance) = TOGETHER then ALIGNED else ALIGNING endif,
			if stage_isSeen then CORRECT else STAND endif]

	rule r_stage_lower =
		if stage_isNewContact and stage_contact = CONTACT then
			r_stage_is[PLACED, STAND]
		else
			r_stage_is[LOWERING, if stage_isNewContact and stage_contact = FREE then DOWN else STAND endif]
		endif

	rule r_stage_work =
		if not stage_isGuided then
			r_stage_is[PAUSED, STAND]
		else
			switch first(stage_guidance)
				case ALIGN: r_stage_align[]
				case LOWER: r_stage_lower[]
				otherwise r_stage_is[PAUSED, STAND]
			endswitch
		endif

	rule r_stage_count = stage_unseen := if stage_isSeen then 0 else min(stage_unseen + 1, stage_patience) endif

	// a step of Stage, the machine of stage
	rule r_stage_Main =
		par
			r_stage_count[]
			if stage_state = RETRACTED then
				r_stage_is[RETRACTED, STAND]
			else
				if stage_state = RETRACTING or stage_contact = OVERLOAD then
					r_stage_retract[]
				else
					if stage_state = PLACED then motion := STAND else r_stage_work[] endif
				endif
			endif
		endpar

	// what was read from guidance
	function stage_guidance = guidance_value(sv_receivedSequence(guidance))

	// it was not there in the elaboration before: guidance
	function stage_isNewGuidance = sv_fresh(guidance)

	// what was read from contact
	function stage_contact = contact_value(sv_receivedSequence(contact))

	// it was not there in the elaboration before: contact
	function stage_isNewContact = sv_fresh(contact)

	// the end of stage_elaborate
	rule r_end_stage_elaborate =
		seq
			r_stage_Main[]
			state_value(sv_sequence(state) + 1) := stage_state
		endseq

	rule r_supervisor_end($ending in SupervisorEnding) =
		par
			supervisor_ending := $ending
			supervisor_recipe := REST
		endpar

	rule r_supervisor_goOn =
		switch supervisor_recipe
			case REST: supervisor_recipe := ALIGN
			case ALIGN:
				if supervisor_state = ALIGNED then supervisor_recipe := LOWER endif
			case LOWER:
				if supervisor_state = PLACED then r_supervisor_end[SUPERVISOR_DONE] endif
		endswitch

	// a step of Supervisor, the machine of supervisor
	rule r_supervisor_Main =
		if isUndef(supervisor_ending) then
			if supervisor_state = RETRACTED then r_supervisor_end[SUPERVISOR_FAILED] else r_supervisor_goOn[] endif
		endif

	// what was read from state
	function supervisor_state = state_value(sv_receivedSequence(state))

	// the end of supervisor_elaborate
	rule r_end_supervisor_elaborate =
		seq
			r_supervisor_Main[]
			recipe_value(sv_sequence(recipe) + 1) := supervisor_recipe
		endseq

	// the end of force_elaborate
	rule r_end_force_elaborate =
		contact_value(sv_sequence(contact) + 1) := force_contact

	// what is computed when an elaboration ends
	rule r_endOfElaboration($p in SchedulePhase) =
		switch $p
			case aligner_elaborate: r_end_aligner_elaborate[]
			case stage_elaborate: r_end_stage_elaborate[]
			case supervisor_elaborate: r_end_supervisor_elaborate[]
			case force_elaborate: r_end_force_elaborate[]
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
		par
			forall $c in Scheduler with true do program($c)
			forall $s in Semaphore with true do r_sem_arbitrate[$s]
			clock := clock + 1
		endpar

default init s0:
	function clock = 0
	function task_kind($t in Task) =
		switch $t
			case aligner_task: ASYNCHRONOUS
			case supervisor_task: ASYNCHRONOUS
			otherwise SYNCHRONOUS
		endswitch
	function task_period($t in Task) =
		switch $t
			case microscope_task: 200
			case force_task: 10
			case stage_task: 20
			case piezo_task: 5
			case scales_reader_task: 10
			otherwise undef
		endswitch
	function task_timeForElaboration($t in Task) =
		switch $t
			case microscope_task: 82
			case aligner_task: undef
			case stage_task: 14
			case supervisor_task: undef
			otherwise 3
		endswitch
	function task_periodStart($t in Task) =
		switch $t
			case microscope_task: -200
			case force_task: -10
			case stage_task: -20
			case piezo_task: -5
			case scales_reader_task: -10
			otherwise 0
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
			case image_lock: [microscope_task, aligner_task]
			case correction_lock: [stage_task, aligner_task]
			case scale_lock: [scales_reader_task, stage_task]
			otherwise [piezo_task, stage_task]
		endswitch
	function sem_state($s in Semaphore, $t in Task) = READY
	function sem_illegalPost($s in Semaphore) = false
	function semaq($s in Semaphore) = []
	function dimension($b in SwingingBuffer) =
		switch $b
			case correction: 3
			otherwise 2
		endswitch
	function sem($b in SwingingBuffer) =
		switch $b
			case image: image_lock
			case correction: correction_lock
			case scale: scale_lock
			otherwise axis_order_lock
		endswitch
	function sb_master($b in SwingingBuffer) =
		switch $b
			case image: aligner_read_image
			case correction: aligner_write
			case scale: stage_read_scale
			otherwise stage_write_axes
		endswitch
	function indexWrite($b in SwingingBuffer) = 0
	function indexRead($b in SwingingBuffer) =
		switch $b
			case correction: 2
			otherwise 1
		endswitch
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
	function sv_sequence($v in SharedValue) = 0
	function sv_overwritten($v in SharedValue) = 0
	function sv_receivedSequence($v in SharedValue) = 0
	function sv_fresh($v in SharedValue) = false
	function scheduler_mainThread($c in Scheduler) =
		switch $c
			case microscope: microscope_task
			case aligner: aligner_task
			case force: force_task
			case stage: stage_task
			case piezo: piezo_task
			case scales_reader: scales_reader_task
			otherwise supervisor_task
		endswitch
	function scheduler_currentPhase($c in Scheduler) =
		switch $c
			case microscope: microscope_wait
			case aligner: aligner_wait
			case force: force_wait
			case stage: stage_wait
			case piezo: piezo_wait
			case scales_reader: scales_reader_wait
			otherwise supervisor_wait
		endswitch
	function scheduler_actionStart($c in Scheduler) = 0
	function action($p in SchedulePhase) =
		switch $p
			case microscope_grab: ELABORATING
			case microscope_write: WRITING_ON_SB
			case aligner_receive: LOADING
			case aligner_read_image: READING_FROM_SB
			case aligner_elaborate: ELABORATING
			case aligner_write: WRITING_ON_SB
			case aligner_guide: STORING
			case force_elaborate: ELABORATING
			case force_write: STORING
			case stage_read_guidance: LOADING
			case stage_read_correction: READING_FROM_SB
			case stage_read_contact: LOADING
			case stage_read_scale: READING_FROM_SB
			case stage_elaborate: ELABORATING
			case stage_write_axes: WRITING_ON_SB
			case stage_write_state: STORING
			case piezo_read: READING_FROM_SB
			case piezo_elaborate: ELABORATING
			case scales_acquire: ELABORATING
			case scales_write: WRITING_ON_SB
			case supervisor_read: LOADING
			case supervisor_elaborate: ELABORATING
			case supervisor_send: STORING
			otherwise WAITING_TRIGGER
		endswitch
	function time($p in SchedulePhase) =
		switch $p
			case microscope_grab: 80
			case aligner_elaborate: 90
			case force_elaborate: 2
			case stage_elaborate: 3
			case supervisor_elaborate: 50
			otherwise 1
		endswitch
	function nextPhase($p in SchedulePhase) =
		switch $p
			case microscope_grab: microscope_write
			case microscope_write: microscope_wait
			case microscope_wait: microscope_grab
			case aligner_receive: aligner_read_image
			case aligner_read_image: aligner_elaborate
			case aligner_elaborate: aligner_write
			case aligner_write: aligner_guide
			case aligner_guide: aligner_wait
			case aligner_wait: aligner_receive
			case force_elaborate: force_write
			case force_write: force_wait
			case force_wait: force_elaborate
			case stage_read_guidance: stage_read_correction
			case stage_read_correction: stage_read_contact
			case stage_read_contact: stage_read_scale
			case stage_read_scale: stage_elaborate
			case stage_elaborate: stage_write_axes
			case stage_write_axes: stage_write_state
			case stage_write_state: stage_wait
			case stage_wait: stage_read_guidance
			case piezo_read: piezo_elaborate
			case piezo_elaborate: piezo_wait
			case piezo_wait: piezo_read
			case scales_acquire: scales_write
			case scales_write: scales_reader_wait
			case scales_reader_wait: scales_acquire
			case supervisor_read: supervisor_elaborate
			case supervisor_elaborate: supervisor_send
			case supervisor_send: supervisor_wait
			otherwise supervisor_read
		endswitch
	function sharedMemory($p in SchedulePhase) =
		switch $p
			case microscope_write: image
			case aligner_read_image: image
			case aligner_write: correction
			case aligner_wait: image
			case stage_read_correction: correction
			case stage_read_scale: scale
			case stage_write_axes: axis_order
			case piezo_read: axis_order
			case scales_write: scale
			otherwise undef
		endswitch
	function sharedValue($p in SchedulePhase) =
		switch $p
			case aligner_receive: recipe
			case aligner_guide: guidance
			case force_write: contact
			case stage_read_guidance: guidance
			case stage_read_contact: contact
			case stage_write_state: state
			case supervisor_read: state
			case supervisor_send: recipe
			case supervisor_wait: state
			otherwise undef
		endswitch
	function elaborationRule($p in SchedulePhase) = undef
	function aligner_work = REST
	function aligner_right = 0
	function aligner_guidance = (REST, HIDDEN)
	function stage_state = PAUSED
	function motion = STAND
	function stage_unseen = stage_patience
	function supervisor_recipe = REST
	agent Scheduler: r_computingTask[]
