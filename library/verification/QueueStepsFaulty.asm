/* QueueSteps with a fault that it is there to exclude, chosen by `--bound fault=…`. */
asm QueueStepsFaulty

import ../std/StandardLibrary
import ../runtime/QueueSteps

signature:
	monitored fault: Fault

definitions:
	main rule r_Main =
		choose $side in Side with place($side) != ASLEEP do
			r_move[$side]

default init s0:
	function seeded = fault
	function sent = 0
	function taken = 0
	function content($slot in Slot, $w in Word) = 0
	function calls($s in Side) = 0
	function announced($s in Side) = false
	function place($s in Side) = OUTSIDE
	function word($s in Side) = 0
	function read($w in Word) = 0
	function next = 0
	function due = 0
