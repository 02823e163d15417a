/* A chain of tasks over four swinging buffers: camera, visual servoing, robot controller, motor; an encoder feeds the robot
   controller too. Synchronous tasks skip a buffer that they have waited for too long. Elaborations and waits take no time, and data are 0 or 1. A step is one move of one
   task, chosen. */
asm ChainL

import ../../../library/std/StandardLibrary

signature:
	enum domain Task = {CAMERA | SERVOING | CONTROLLER | MOTOR | ENCODER}
	enum domain Lock = {FREE | PRODUCING | CONSUMING}
	// buffers from camera to servoing, from servoing to the controller, from the controller to the motor, from the
	// encoder to the controller
	domain Buffer subsetof Integer
	domain Array subsetof Integer
	domain Place subsetof Integer
	domain Count subsetof Integer
	domain Datum subsetof Integer

	controlled place: Task -> Place
	controlled count: Task -> Count
	controlled datum: Task -> Datum
	controlled lock: Buffer -> Lock
	// the array that the producer writes
	controlled written: Buffer -> Array
	controlled buffer: Prod(Buffer, Array) -> Datum

	static elaboration: Integer
	static patience: Integer
	static data: Integer

definitions:
	domain Buffer = {0 : 3}
	domain Array = {0 : 1}
	domain Place = {0 : 10}
	domain Count = {0 : 0}
	domain Datum = {0 : 1}

	function elaboration = 0
	function patience = 0
	function data = 2

	rule r_Acquire($t in Task, $b in Buffer, $as in Lock) =
		par
			lock($b) := $as
			count($t) := 0
			place($t) := place($t) + 1
		endpar

	// an asynchronous task waits as long as it must
	rule r_AcquireAtLast($t in Task, $b in Buffer, $as in Lock) =
		if lock($b) = FREE then
			r_Acquire[$t, $b, $as]
		endif

	rule r_AcquireInTime($t in Task, $b in Buffer, $as in Lock, $next in Place) =
		if lock($b) = FREE then
			r_Acquire[$t, $b, $as]
		else
			if count($t) < patience then
				count($t) := count($t) + 1
			else
				par
					count($t) := 0
					place($t) := $next
				endpar
			endif
		endif

	rule r_Read($t in Task, $b in Buffer, $more in Integer) =
		par
			datum($t) := ($more + buffer($b, 1 - written($b))) mod data
			place($t) := place($t) + 1
		endpar

	rule r_Write($t in Task, $b in Buffer) =
		par
			buffer($b, written($b)) := datum($t)
			place($t) := place($t) + 1
		endpar

	rule r_Swap($t in Task, $b in Buffer) =
		par
			written($b) := 1 - written($b)
			place($t) := place($t) + 1
		endpar

	rule r_Release($t in Task, $b in Buffer, $next in Place) =
		par
			lock($b) := FREE
			place($t) := $next
		endpar

	rule r_Elaborate($t in Task, $next in Place, $more in Integer) =
		if count($t) < elaboration then
			count($t) := count($t) + 1
		else
			par
				count($t) := 0
				datum($t) := (datum($t) + $more) mod data
				place($t) := $next
			endpar
		endif

	rule r_Camera =
		switch place(CAMERA)
			case 0: r_Elaborate[CAMERA, 1, 1]
			case 1: r_Write[CAMERA, 0]
			case 2: r_AcquireAtLast[CAMERA, 0, PRODUCING]
			case 3: r_Swap[CAMERA, 0]
			case 4: r_Release[CAMERA, 0, 0]
		endswitch

	rule r_Servoing =
		switch place(SERVOING)
			case 0: r_AcquireAtLast[SERVOING, 0, CONSUMING]
			case 1: r_Read[SERVOING, 0, 0]
			case 2: r_Release[SERVOING, 0, 3]
			case 3: r_Elaborate[SERVOING, 4, 0]
			case 4: r_Write[SERVOING, 1]
			case 5: r_AcquireAtLast[SERVOING, 1, PRODUCING]
			case 6: r_Swap[SERVOING, 1]
			case 7: r_Release[SERVOING, 1, 0]
		endswitch

	rule r_Controller =
		switch place(CONTROLLER)
			case 0: r_AcquireInTime[CONTROLLER, 1, CONSUMING, 3]
			case 1: r_Read[CONTROLLER, 1, 0]
			case 2: r_Release[CONTROLLER, 1, 3]
			case 3: r_AcquireInTime[CONTROLLER, 3, CONSUMING, 6]
			case 4: r_Read[CONTROLLER, 3, datum(CONTROLLER)]
			case 5: r_Release[CONTROLLER, 3, 6]
			case 6: r_Elaborate[CONTROLLER, 7, 0]
			case 7: r_Write[CONTROLLER, 2]
			case 8: r_AcquireInTime[CONTROLLER, 2, PRODUCING, 0]
			case 9: r_Swap[CONTROLLER, 2]
			case 10: r_Release[CONTROLLER, 2, 0]
		endswitch

	rule r_Motor =
		switch place(MOTOR)
			case 0: r_AcquireInTime[MOTOR, 2, CONSUMING, 3]
			case 1: r_Read[MOTOR, 2, 0]
			case 2: r_Release[MOTOR, 2, 3]
			case 3: r_Elaborate[MOTOR, 0, 0]
		endswitch

	rule r_Encoder =
		switch place(ENCODER)
			case 0: r_Elaborate[ENCODER, 1, 1]
			case 1: r_Write[ENCODER, 3]
			case 2: r_AcquireInTime[ENCODER, 3, PRODUCING, 0]
			case 3: r_Swap[ENCODER, 3]
			case 4: r_Release[ENCODER, 3, 0]
		endswitch

	// who is in the index section of a buffer holds its lock
	invariant inv_camera over place: place(CAMERA) >= 3 implies lock(0) = PRODUCING
	invariant inv_servoingReads over place: place(SERVOING) = 1 or place(SERVOING) = 2 implies lock(0) = CONSUMING
	invariant inv_servoingWrites over place: place(SERVOING) >= 6 implies lock(1) = PRODUCING
	invariant inv_controllerReads over place: place(CONTROLLER) = 1 or place(CONTROLLER) = 2 implies lock(1) = CONSUMING
	invariant inv_controllerFeedback over place:
		place(CONTROLLER) = 4 or place(CONTROLLER) = 5 implies lock(3) = CONSUMING
	invariant inv_controllerWrites over place: place(CONTROLLER) >= 9 implies lock(2) = PRODUCING
	invariant inv_motor over place: place(MOTOR) = 1 or place(MOTOR) = 2 implies lock(2) = CONSUMING
	invariant inv_encoder over place: place(ENCODER) >= 3 implies lock(3) = PRODUCING

	main rule r_Main =
		choose $t in Task with true do
			switch $t
				case CAMERA: r_Camera[]
				case SERVOING: r_Servoing[]
				case CONTROLLER: r_Controller[]
				case MOTOR: r_Motor[]
				case ENCODER: r_Encoder[]
			endswitch

default init s0:
	function place($t in Task) = 0
	function count($t in Task) = 0
	function datum($t in Task) = 0
	function lock($b in Buffer) = FREE
	function written($b in Buffer) = 0
	function buffer($b in Buffer, $a in Array) = 0
