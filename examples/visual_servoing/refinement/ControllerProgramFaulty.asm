/* ControllerProgram with a fault that it is there to exclude, chosen by `--bound fault=…`. */
asm ControllerProgramFaulty

import ../../../library/std/StandardLibrary
import ControllerProgram

signature:
	monitored fault: Fault

definitions:
	main rule r_Main =
		r_anyThread[]

default init s0:
	function seeded = fault
	function holder($c in Channel) = undef
	function pending($c in Channel) = false
	function content($c in Channel, $n in Position, $w in Word) = if $n = last($c) then NEWEST else OLD endif
	function offersPending = false
	function raised = false
	function place($t in Thread) = RESTING
	function at($t in Thread) =
		switch $t
			case CAMERA: IMAGE
			case SERVOING: SET_POINT
			otherwise MOTION
		endswitch
	function word($t in Thread) = 0
	function isRead($c in Channel) = true
	function fresh($c in Channel) = false
	function torn($t in Thread) = false
