/* Made from SortingCell.chart. The elements, the main rule, the initial state and what comes from its components' machines are written
   anew from there; all else is kept. */
asm SortingCell

import StandardLibrary
import CTLLibrary
import LTLLibrary
import ../../library/std/StandardLibrary
import ../../library/patterns/ControlTask
import Parcels
import ../../library/patterns/VaryingTimes
import ../../library/patterns/DataAges

signature:
	static camera: Scheduler
	static camera_task: Task
	static reader: Scheduler
	static reader_task: Task
	static classifier: Scheduler
	static classifier_task: Task
	static encoder: Scheduler
	static encoder_task: Task
	static sequencer: Scheduler
	static sequencer_task: Task
	static leftPusher: Scheduler
	static leftPusher_task: Task
	static rightPusher: Scheduler
	static rightPusher_task: Task
	static labels: SwingingBuffer
	static labels_lock: Semaphore
	static shapes: SwingingBuffer
	static shapes_lock: Semaphore
	static arrivals: SwingingBuffer
	static arrivals_lock: Semaphore
	static codes: SwingingBuffer
	static codes_lock: Semaphore
	static classes: SwingingBuffer
	static classes_lock: Semaphore
	static way: SwingingBuffer
	static way_lock: Semaphore
	static leftOrders: SwingingBuffer
	static leftOrders_lock: Semaphore
	static rightOrders: SwingingBuffer
	static rightOrders_lock: Semaphore
	static camera_scan: SchedulePhase
	static camera_write_labels: SchedulePhase
	static camera_write_shapes: SchedulePhase
	static camera_write_arrivals: SchedulePhase
	static camera_wait: SchedulePhase
	static reader_read_labels: SchedulePhase
	static reader_decode: SchedulePhase
	static reader_write_codes: SchedulePhase
	static reader_wait: SchedulePhase
	static classifier_read_shapes: SchedulePhase
	static classifier_classify: SchedulePhase
	static classifier_write_classes: SchedulePhase
	static classifier_wait: SchedulePhase
	static encoder_count: SchedulePhase
	static encoder_write_way: SchedulePhase
	static encoder_wait: SchedulePhase
	static sequencer_read_arrivals: SchedulePhase
	static sequencer_read_codes: SchedulePhase
	static sequencer_read_classes: SchedulePhase
	static sequencer_read_way: SchedulePhase
	static sequencer_decide: SchedulePhase
	static sequencer_write_leftOrders: SchedulePhase
	static sequencer_write_rightOrders: SchedulePhase
	static sequencer_wait: SchedulePhase
	static leftPusher_read_leftOrders: SchedulePhase
	static leftPusher_push: SchedulePhase
	static leftPusher_wait: SchedulePhase
	static rightPusher_read_rightOrders: SchedulePhase
	static rightPusher_push: SchedulePhase
	static rightPusher_wait: SchedulePhase
	// what the data of labels say, by their numbers
	controlled labels_value: Integer -> Prod(Parcel, Digit)
	// what the data of shapes say, by their numbers
	controlled shapes_value: Integer -> Prod(Parcel, Dent)
	// what the data of arrivals say, by their numbers
	controlled arrivals_value: Integer -> Parcel
	// what the data of codes say, by their numbers
	controlled codes_value: Integer -> Prod(Parcel, Bin)
	// what the data of classes say, by their numbers
	controlled classes_value: Integer -> Prod(Parcel, Shape)
	// what the data of way say, by their numbers
	controlled way_value: Integer -> Way
	// what the data of leftOrders say, by their numbers
	controlled leftOrders_value: Integer -> Boolean
	// what the data of rightOrders say, by their numbers
	controlled rightOrders_value: Integer -> Boolean
	// Line: something under it
	monitored seen: Boolean
	// Line: digit on the label
	monitored printed: Digit
	// Line: outline
	monitored outline: Dent
	controlled camera_labels: Prod(Parcel, Digit)
	controlled camera_shapes: Prod(Parcel, Dent)
	controlled camera_arrivals: Parcel
	controlled camera_wasSeen: Boolean
	derived reader_labels: Prod(Parcel, Digit)
	controlled reader_codes: Prod(Parcel, Bin)
	static reader_binOf: Digit -> Bin
	derived classifier_shapes: Prod(Parcel, Dent)
	controlled classifier_classes: Prod(Parcel, Shape)
	static classifier_allowed: Dent
	// Eye on the belt
	monitored mark: Boolean
	controlled encoder_way: Way
	controlled encoder_wasMark: Boolean
	// Emergency stop
	monitored stop: Boolean
	enum domain SequencerMode = {SEQUENCER_RUNNING | SEQUENCER_STOPPED}
	derived sequencer_arrivals: Parcel
	derived sequencer_codes: Prod(Parcel, Bin)
	derived sequencer_classes: Prod(Parcel, Shape)
	derived sequencer_way: Way
	controlled sequencer_leftOrders: Boolean
	controlled sequencer_rightOrders: Boolean
	controlled sequencer_mode: SequencerMode
	controlled sequencer_arrived: Parcel
	controlled sequencer_come: Way
	controlled sequencer_entering: Parcel
	controlled sequencer_code: Bin
	controlled sequencer_shape: Shape
	controlled sequencer_following: Parcel
	controlled sequencer_pushedLeft: Parcel
	controlled sequencer_pushedRight: Parcel
	derived sequencer_moved: Boolean
	derived sequencer_bin: Bin
	derived sequencer_isLost: Boolean
	derived sequencer_isOther: Prod(Parcel, Bin) -> Boolean
	derived sequencer_isDamaged: Parcel -> Boolean
	// Left arm
	out leftArm: Boolean
	domain LeftPusherCycles subsetof Integer
	derived leftPusher_leftOrders: Boolean
	derived leftPusher_isNewLeftOrders: Boolean
	controlled leftPusher_isHalted: Boolean
	controlled leftPusher_remaining: LeftPusherCycles
	static leftPusher_stroke: LeftPusherCycles
	derived leftPusher_ordered: Boolean
	// Right arm
	out rightArm: Boolean
	domain RightPusherCycles subsetof Integer
	derived rightPusher_rightOrders: Boolean
	derived rightPusher_isNewRightOrders: Boolean
	controlled rightPusher_isHalted: Boolean
	controlled rightPusher_remaining: RightPusherCycles
	static rightPusher_stroke: RightPusherCycles
	derived rightPusher_ordered: Boolean

	static bound1_hop1: AgeHop

	static bound1_hop2: AgeHop

	static bound1_hop3: AgeHop

	static bound1_hop4: AgeHop

	static bound1_hop5: AgeHop

	static bound2_hop1: AgeHop

	static bound2_hop2: AgeHop

	static bound2_hop3: AgeHop

	static bound2_hop4: AgeHop

	static bound2_hop5: AgeHop

	static bound2_hop6: AgeHop

	static bound2_hop7: AgeHop

	static bound2_hop8: AgeHop

	static bound3_hop1: AgeHop

	static bound3_hop2: AgeHop

	static bound3_hop3: AgeHop

	static bound3_hop4: AgeHop

	static bound3_hop5: AgeHop

	static bound3_hop6: AgeHop

	static bound3_hop7: AgeHop

	static bound3_hop8: AgeHop

	static bound1_way1: AgeWay

	static bound1_way2: AgeWay

	static bound1_way3: AgeWay

	static bound2_way1: AgeWay

	static bound2_way2: AgeWay

	static bound2_way3: AgeWay

	static bound3_way1: AgeWay

	static bound3_way2: AgeWay

	static bound3_way3: AgeWay

definitions:
	// what each task does when it is its turn
	rule r_controlTask = r_scheduler_execute[self]

	// the same where times vary
	rule r_varyingTask = r_scheduler_executeVarying[self]

	invariant inv_patterns over sem_state, indexRead: patternsSound

	invariant inv_deadlines over task_deadlinesMissed: (forall $t in Task with task_deadlinesMissed($t) = 0)

	rule r_camera_number =
		let ($parcel = (camera_arrivals + 1) mod 6) in
			par
				camera_arrivals := $parcel
				camera_labels := ($parcel, printed)
				camera_shapes := ($parcel, outline)
			endpar
		endlet

	// a step of Camera, the machine of camera
	rule r_camera_Main =
		par
			camera_wasSeen := seen
			if seen and not camera_wasSeen then r_camera_number[] endif
		endpar

	// the end of camera_scan
	rule r_end_camera_scan =
		seq
			r_camera_Main[]
			par
				labels_value(sb_written(labels) + 1) := camera_labels
				shapes_value(sb_written(shapes) + 1) := camera_shapes
				arrivals_value(sb_written(arrivals) + 1) := camera_arrivals
			endpar
		endseq

	function reader_binOf($digit in Digit) =
		if $digit >= 1 and $digit <= 4 then
			LEFT
		else
			if $digit >= 5 and $digit <= 8 then
				RIGHT
			else
				END
			endif
		endif

	// a step of Reader, the machine of reader
	rule r_reader_Main =
		if isDef(reader_labels) then reader_codes := (first(reader_labels), reader_binOf(second(reader_labels))) endif

	// what was read from labels
	function reader_labels = labels_value(sb_receivedSequence(labels))

	// the end of reader_decode
	rule r_end_reader_decode =
		seq
			r_reader_Main[]
			codes_value(sb_written(codes) + 1) := reader_codes
		endseq

	function classifier_allowed = 3

	// a step of Classifier, the machine of classifier
	rule r_classifier_Main =
		if isDef(classifier_shapes) then
			classifier_classes :=
				(
					first(classifier_shapes),
					if second(classifier_shapes) <= classifier_allowed then WHOLE else DAMAGED endif)
		endif

	// what was read from shapes
	function classifier_shapes = shapes_value(sb_receivedSequence(shapes))

	// the end of classifier_classify
	rule r_end_classifier_classify =
		seq
			r_classifier_Main[]
			classes_value(sb_written(classes) + 1) := classifier_classes
		endseq

	// a step of Encoder, the machine of encoder
	rule r_encoder_Main =
		par
			encoder_wasMark := mark
			if mark and not encoder_wasMark then encoder_way := (encoder_way + 1) mod 4 endif
		endpar

	// the end of encoder_count
	rule r_end_encoder_count =
		seq
			r_encoder_Main[]
			way_value(sb_written(way) + 1) := encoder_way
		endseq

	function sequencer_moved = isDef(sequencer_way) and sequencer_way != sequencer_come

	function sequencer_bin = if sequencer_code = undef or sequencer_shape != WHOLE then END else sequencer_code endif

	function sequencer_isLost =
		(isDef(sequencer_way) and sequencer_way != sequencer_come and sequencer_way != (sequencer_come + 1) mod 4)
		or (
			isDef(sequencer_arrivals)
			and sequencer_arrivals != sequencer_arrived
			and (
				sequencer_arrivals != (sequencer_arrived + 1) mod 6
				or (isDef(sequencer_entering) and not sequencer_moved)))

	function sequencer_isOther($p in Parcel, $bin in Bin) =
		isDef(sequencer_codes) and first(sequencer_codes) = $p and second(sequencer_codes) != $bin

	function sequencer_isDamaged($p in Parcel) =
		isDef(sequencer_classes) and first(sequencer_classes) = $p and second(sequencer_classes) = DAMAGED

	rule r_sequencer_halt =
		par
			sequencer_mode := SEQUENCER_STOPPED
			sequencer_leftOrders := false
			sequencer_rightOrders := false
			sequencer_pushedLeft := undef
			sequencer_pushedRight := undef
		endpar

	rule r_sequencer_move =
		par
			sequencer_come := sequencer_way
			sequencer_leftOrders := isDef(sequencer_entering) and sequencer_bin = LEFT
			sequencer_pushedLeft :=
				if isDef(sequencer_entering) and sequencer_bin = LEFT then sequencer_entering else undef endif
			sequencer_following :=
				if isDef(sequencer_entering) and sequencer_bin = RIGHT then sequencer_entering else undef endif
			sequencer_rightOrders := isDef(sequencer_following)
			sequencer_pushedRight := sequencer_following
		endpar

	rule r_sequencer_rest =
		par
			sequencer_leftOrders := false
			sequencer_rightOrders := false
			sequencer_pushedLeft := undef
			sequencer_pushedRight := undef
		endpar

	rule r_sequencer_look =
		if isDef(sequencer_arrivals) and sequencer_arrivals != sequencer_arrived then
			par
				sequencer_arrived := sequencer_arrivals
				sequencer_entering := sequencer_arrivals
				sequencer_code := undef
				sequencer_shape := undef
			endpar
		else
			if sequencer_moved then
				sequencer_entering := undef
			else
				if isDef(sequencer_entering) then
					par
						if isDef(sequencer_codes) and first(sequencer_codes) = sequencer_entering then
							sequencer_code := second(sequencer_codes)
						endif
						if isDef(sequencer_classes) and first(sequencer_classes) = sequencer_entering then
							sequencer_shape := second(sequencer_classes)
						endif
					endpar
				endif
			endif
		endif

	rule r_sequencer_follow =
		if sequencer_mode = SEQUENCER_RUNNING then
			if stop or sequencer_isLost then
				r_sequencer_halt[]
			else
				par
					if sequencer_moved then r_sequencer_move[] else r_sequencer_rest[] endif
					r_sequencer_look[]
				endpar
			endif
		endif

	// a step of Sequencer, the machine of sequencer
	rule r_sequencer_Main = r_sequencer_follow[]

	// what was read from arrivals
	function sequencer_arrivals = arrivals_value(sb_receivedSequence(arrivals))

	// what was read from codes
	function sequencer_codes = codes_value(sb_receivedSequence(codes))

	// what was read from classes
	function sequencer_classes = classes_value(sb_receivedSequence(classes))

	// what was read from way
	function sequencer_way = way_value(sb_receivedSequence(way))

	// the end of sequencer_decide
	rule r_end_sequencer_decide =
		seq
			r_sequencer_Main[]
			par
				leftOrders_value(sb_written(leftOrders) + 1) := sequencer_leftOrders
				rightOrders_value(sb_written(rightOrders) + 1) := sequencer_rightOrders
			endpar
		endseq

	domain LeftPusherCycles = {0 : 5}

	function leftPusher_stroke = 5

	function leftPusher_ordered = leftPusher_isNewLeftOrders and leftPusher_leftOrders

	// a step of LeftPusher, the machine of leftPusher
	rule r_leftPusher_Main =
		if leftPusher_isHalted or stop then
			par
				leftPusher_isHalted := true
				leftPusher_remaining := 0
				leftArm := false
			endpar
		else
			if leftPusher_isNewLeftOrders and leftPusher_leftOrders then
				par
					leftPusher_remaining := leftPusher_stroke - 1
					leftArm := true
				endpar
			else
				if leftPusher_remaining > 0 then
					leftPusher_remaining := leftPusher_remaining - 1
				else
					leftArm := false
				endif
			endif
		endif

	// what was read from leftOrders
	function leftPusher_leftOrders = leftOrders_value(sb_receivedSequence(leftOrders))

	// it was not there in the elaboration before: leftOrders
	function leftPusher_isNewLeftOrders = sb_fresh(leftOrders)

	// the end of leftPusher_push
	rule r_end_leftPusher_push =
		r_leftPusher_Main[]

	domain RightPusherCycles = {0 : 5}

	function rightPusher_stroke = 5

	function rightPusher_ordered = rightPusher_isNewRightOrders and rightPusher_rightOrders

	// a step of RightPusher, the machine of rightPusher
	rule r_rightPusher_Main =
		if rightPusher_isHalted or stop then
			par
				rightPusher_isHalted := true
				rightPusher_remaining := 0
				rightArm := false
			endpar
		else
			if rightPusher_isNewRightOrders and rightPusher_rightOrders then
				par
					rightPusher_remaining := rightPusher_stroke - 1
					rightArm := true
				endpar
			else
				if rightPusher_remaining > 0 then
					rightPusher_remaining := rightPusher_remaining - 1
				else
					rightArm := false
				endif
			endif
		endif

	// what was read from rightOrders
	function rightPusher_rightOrders = rightOrders_value(sb_receivedSequence(rightOrders))

	// it was not there in the elaboration before: rightOrders
	function rightPusher_isNewRightOrders = sb_fresh(rightOrders)

	// the end of rightPusher_push
	rule r_end_rightPusher_push =
		r_rightPusher_Main[]

	// what is computed when an elaboration ends
	rule r_endOfElaboration($p in SchedulePhase) =
		switch $p
			case camera_scan: r_end_camera_scan[]
			case reader_decode: r_end_reader_decode[]
			case classifier_classify: r_end_classifier_classify[]
			case encoder_count: r_end_encoder_count[]
			case sequencer_decide: r_end_sequencer_decide[]
			case leftPusher_push: r_end_leftPusher_push[]
			case rightPusher_push: r_end_rightPusher_push[]
		endswitch

	// what each task does when it is its turn
	rule r_computingTask =
		par
			r_scheduler_executeVarying[self]
			if action(scheduler_currentPhase(self)) = ELABORATING then
				if tElapsed(self) then
					r_endOfElaboration[scheduler_currentPhase(self)]
				else
					if mayEnd(self) then
						if endsNow(self) then r_endOfElaboration[scheduler_currentPhase(self)] endif
					endif
				endif
			endif
		endpar

	invariant inv_age1_camera_to_sequencer over way_tooOld:
		way_tooOld(bound1_way1) = 0 and way_tooOld(bound1_way2) = 0 and way_tooOld(bound1_way3) = 0

	invariant inv_age2_printed_to_leftArm over way_tooOld:
		way_tooOld(bound2_way1) = 0 and way_tooOld(bound2_way2) = 0 and way_tooOld(bound2_way3) = 0

	invariant inv_age3_printed_to_rightArm over way_tooOld:
		way_tooOld(bound3_way1) = 0 and way_tooOld(bound3_way2) = 0 and way_tooOld(bound3_way3) = 0

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
	function task_kind($t in Task) =
		switch $t
			case reader_task: ASYNCHRONOUS
			case classifier_task: ASYNCHRONOUS
			otherwise SYNCHRONOUS
		endswitch
	function task_period($t in Task) =
		switch $t
			case camera_task: 50
			case encoder_task: 10
			case sequencer_task: 100
			case leftPusher_task: 20
			case rightPusher_task: 20
			otherwise undef
		endswitch
	function task_timeForElaboration($t in Task) =
		switch $t
			case camera_task: 26
			case encoder_task: 4
			case sequencer_task: 36
			case leftPusher_task: 7
			case rightPusher_task: 7
			otherwise undef
		endswitch
	function task_periodStart($t in Task) =
		switch $t
			case camera_task: -50
			case reader_task: 0
			case classifier_task: 0
			case encoder_task: -10
			case sequencer_task: -100
			otherwise -20
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
			case labels_lock: [camera_task, reader_task]
			case shapes_lock: [camera_task, classifier_task]
			case arrivals_lock: [camera_task, sequencer_task]
			case codes_lock: [sequencer_task, reader_task]
			case classes_lock: [sequencer_task, classifier_task]
			case way_lock: [encoder_task, sequencer_task]
			case leftOrders_lock: [leftPusher_task, sequencer_task]
			otherwise [rightPusher_task, sequencer_task]
		endswitch
	function sem_state($s in Semaphore, $t in Task) = READY
	function sem_illegalPost($s in Semaphore) = false
	function semaq($s in Semaphore) = []
	function dimension($b in SwingingBuffer) =
		switch $b
			case codes: 3
			case classes: 3
			otherwise 2
		endswitch
	function sem($b in SwingingBuffer) =
		switch $b
			case labels: labels_lock
			case shapes: shapes_lock
			case arrivals: arrivals_lock
			case codes: codes_lock
			case classes: classes_lock
			case way: way_lock
			case leftOrders: leftOrders_lock
			otherwise rightOrders_lock
		endswitch
	function sb_master($b in SwingingBuffer) =
		switch $b
			case labels: reader_read_labels
			case shapes: classifier_read_shapes
			case arrivals: sequencer_read_arrivals
			case codes: reader_write_codes
			case classes: classifier_write_classes
			case way: sequencer_read_way
			case leftOrders: sequencer_write_leftOrders
			otherwise sequencer_write_rightOrders
		endswitch
	function indexWrite($b in SwingingBuffer) = 0
	function indexRead($b in SwingingBuffer) =
		switch $b
			case codes: 2
			case classes: 2
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
	function scheduler_mainThread($c in Scheduler) =
		switch $c
			case camera: camera_task
			case reader: reader_task
			case classifier: classifier_task
			case encoder: encoder_task
			case sequencer: sequencer_task
			case leftPusher: leftPusher_task
			otherwise rightPusher_task
		endswitch
	function scheduler_currentPhase($c in Scheduler) =
		switch $c
			case camera: camera_wait
			case reader: reader_wait
			case classifier: classifier_wait
			case encoder: encoder_wait
			case sequencer: sequencer_wait
			case leftPusher: leftPusher_wait
			otherwise rightPusher_wait
		endswitch
	function scheduler_actionStart($c in Scheduler) = 0
	function action($p in SchedulePhase) =
		switch $p
			case camera_scan: ELABORATING
			case camera_write_labels: WRITING_ON_SB
			case camera_write_shapes: WRITING_ON_SB
			case camera_write_arrivals: WRITING_ON_SB
			case camera_wait: WAITING_TRIGGER
			case reader_decode: ELABORATING
			case reader_write_codes: WRITING_ON_SB
			case reader_wait: WAITING_TRIGGER
			case classifier_classify: ELABORATING
			case classifier_write_classes: WRITING_ON_SB
			case classifier_wait: WAITING_TRIGGER
			case encoder_count: ELABORATING
			case encoder_write_way: WRITING_ON_SB
			case encoder_wait: WAITING_TRIGGER
			case sequencer_decide: ELABORATING
			case sequencer_write_leftOrders: WRITING_ON_SB
			case sequencer_write_rightOrders: WRITING_ON_SB
			case sequencer_wait: WAITING_TRIGGER
			case leftPusher_push: ELABORATING
			case leftPusher_wait: WAITING_TRIGGER
			case rightPusher_push: ELABORATING
			case rightPusher_wait: WAITING_TRIGGER
			otherwise READING_FROM_SB
		endswitch
	function time($p in SchedulePhase) =
		switch $p
			case camera_scan: 20
			case reader_decode: 90
			case classifier_classify: 200
			case encoder_count: 2
			case sequencer_decide: 20
			case leftPusher_push: 5
			case rightPusher_push: 5
			otherwise 1
		endswitch
	function timeAtLeast($p in SchedulePhase) =
		switch $p
			case reader_decode: 30
			case classifier_classify: 80
			otherwise undef
		endswitch
	function nextPhase($p in SchedulePhase) =
		switch $p
			case camera_scan: camera_write_labels
			case camera_write_labels: camera_write_shapes
			case camera_write_shapes: camera_write_arrivals
			case camera_write_arrivals: camera_wait
			case camera_wait: camera_scan
			case reader_read_labels: reader_decode
			case reader_decode: reader_write_codes
			case reader_write_codes: reader_wait
			case reader_wait: reader_read_labels
			case classifier_read_shapes: classifier_classify
			case classifier_classify: classifier_write_classes
			case classifier_write_classes: classifier_wait
			case classifier_wait: classifier_read_shapes
			case encoder_count: encoder_write_way
			case encoder_write_way: encoder_wait
			case encoder_wait: encoder_count
			case sequencer_read_arrivals: sequencer_read_codes
			case sequencer_read_codes: sequencer_read_classes
			case sequencer_read_classes: sequencer_read_way
			case sequencer_read_way: sequencer_decide
			case sequencer_decide: sequencer_write_leftOrders
			case sequencer_write_leftOrders: sequencer_write_rightOrders
			case sequencer_write_rightOrders: sequencer_wait
			case sequencer_wait: sequencer_read_arrivals
			case leftPusher_read_leftOrders: leftPusher_push
			case leftPusher_push: leftPusher_wait
			case leftPusher_wait: leftPusher_read_leftOrders
			case rightPusher_read_rightOrders: rightPusher_push
			case rightPusher_push: rightPusher_wait
			otherwise rightPusher_read_rightOrders
		endswitch
	function sharedMemory($p in SchedulePhase) =
		switch $p
			case camera_write_labels: labels
			case camera_write_shapes: shapes
			case camera_write_arrivals: arrivals
			case reader_read_labels: labels
			case reader_write_codes: codes
			case reader_wait: labels
			case classifier_read_shapes: shapes
			case classifier_write_classes: classes
			case classifier_wait: shapes
			case encoder_write_way: way
			case sequencer_read_arrivals: arrivals
			case sequencer_read_codes: codes
			case sequencer_read_classes: classes
			case sequencer_read_way: way
			case sequencer_write_leftOrders: leftOrders
			case sequencer_write_rightOrders: rightOrders
			case leftPusher_read_leftOrders: leftOrders
			case rightPusher_read_rightOrders: rightOrders
			otherwise undef
		endswitch
	function elaborationRule($p in SchedulePhase) = undef
	function hop_before($h in AgeHop) =
		switch $h
			case bound1_hop2: bound1_hop1
			case bound1_hop4: bound1_hop3
			case bound2_hop2: bound2_hop1
			case bound2_hop3: bound2_hop2
			case bound2_hop5: bound2_hop4
			case bound2_hop6: bound2_hop5
			case bound2_hop8: bound2_hop7
			case bound3_hop2: bound3_hop1
			case bound3_hop3: bound3_hop2
			case bound3_hop5: bound3_hop4
			case bound3_hop6: bound3_hop5
			case bound3_hop8: bound3_hop7
			otherwise undef
		endswitch
	function hop_writer($h in AgeHop) =
		switch $h
			case bound1_hop2: reader
			case bound1_hop4: classifier
			case bound2_hop2: reader
			case bound2_hop3: sequencer
			case bound2_hop5: classifier
			case bound2_hop6: sequencer
			case bound2_hop8: sequencer
			case bound3_hop2: reader
			case bound3_hop3: sequencer
			case bound3_hop5: classifier
			case bound3_hop6: sequencer
			case bound3_hop8: sequencer
			otherwise camera
		endswitch
	function hop_decided($h in AgeHop) =
		switch $h
			case bound1_hop2: reader_decode
			case bound1_hop4: classifier_classify
			case bound2_hop2: reader_decode
			case bound2_hop3: sequencer_decide
			case bound2_hop5: classifier_classify
			case bound2_hop6: sequencer_decide
			case bound2_hop8: sequencer_decide
			case bound3_hop2: reader_decode
			case bound3_hop3: sequencer_decide
			case bound3_hop5: classifier_classify
			case bound3_hop6: sequencer_decide
			case bound3_hop8: sequencer_decide
			otherwise camera_scan
		endswitch
	function hop_buffer($h in AgeHop) =
		switch $h
			case bound1_hop1: labels
			case bound1_hop2: codes
			case bound1_hop3: shapes
			case bound1_hop4: classes
			case bound1_hop5: arrivals
			case bound2_hop1: labels
			case bound2_hop2: codes
			case bound2_hop3: leftOrders
			case bound2_hop4: shapes
			case bound2_hop5: classes
			case bound2_hop6: leftOrders
			case bound2_hop7: arrivals
			case bound2_hop8: leftOrders
			case bound3_hop1: labels
			case bound3_hop2: codes
			case bound3_hop4: shapes
			case bound3_hop5: classes
			case bound3_hop7: arrivals
			otherwise rightOrders
		endswitch
	function hop_queue($h in AgeHop) = undef
	function hop_value($h in AgeHop) = undef
	function way_hop($w in AgeWay) =
		switch $w
			case bound1_way1: bound1_hop2
			case bound1_way2: bound1_hop4
			case bound1_way3: bound1_hop5
			case bound2_way1: bound2_hop3
			case bound2_way2: bound2_hop6
			case bound2_way3: bound2_hop8
			case bound3_way1: bound3_hop3
			case bound3_way2: bound3_hop6
			otherwise bound3_hop8
		endswitch
	function way_end($w in AgeWay) =
		switch $w
			case bound1_way1: sequencer
			case bound1_way2: sequencer
			case bound1_way3: sequencer
			case bound2_way1: leftPusher
			case bound2_way2: leftPusher
			case bound2_way3: leftPusher
			otherwise rightPusher
		endswitch
	function way_decided($w in AgeWay) =
		switch $w
			case bound1_way1: sequencer_decide
			case bound1_way2: sequencer_decide
			case bound1_way3: sequencer_decide
			case bound2_way1: leftPusher_push
			case bound2_way2: leftPusher_push
			case bound2_way3: leftPusher_push
			otherwise rightPusher_push
		endswitch
	function way_limit($w in AgeWay) =
		switch $w
			case bound1_way1: 600
			case bound1_way2: 600
			case bound1_way3: 600
			otherwise 700
		endswitch
	function phaseBefore($c in Scheduler) =
		switch $c
			case camera: camera_wait
			case reader: reader_wait
			case classifier: classifier_wait
			case encoder: encoder_wait
			case sequencer: sequencer_wait
			case leftPusher: leftPusher_wait
			otherwise rightPusher_wait
		endswitch
	function hop_written($h in AgeHop) = 0
	function hop_read($h in AgeHop) = 0
	function way_oldest($w in AgeWay) = 0
	function way_tooOld($w in AgeWay) = 0
	function camera_wasSeen = false
	function camera_arrivals = 5
	function encoder_way = 0
	function encoder_wasMark = false
	function sequencer_mode = SEQUENCER_RUNNING
	function sequencer_arrived = 5
	function sequencer_come = 0
	function sequencer_leftOrders = false
	function sequencer_rightOrders = false
	function leftPusher_isHalted = false
	function leftPusher_remaining = 0
	function leftArm = false
	function rightPusher_isHalted = false
	function rightPusher_remaining = 0
	function rightArm = false
	agent Scheduler: r_computingTask[]
