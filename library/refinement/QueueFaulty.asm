/* QueueSteps with a fault that a refinement check must find, chosen by `--bound fault=…`: the receiver reads the slot behind the one whose
   turn it is; the sender does not look whether there is room; the receiver counts two messages where it took one, so one is lost. */
asm QueueFaulty

import ../std/StandardLibrary
import ../runtime/QueueSteps

signature:
	enum domain Seeded = {OTHER_SLOT | OVERRUNS | LOSES}
	monitored fault: Seeded
	controlled chosen: Seeded

definitions:
	rule r_faultyRead =
		par
			read(word(RECEIVER)) := content((taken + 1) mod 2, word(RECEIVER))
			word(RECEIVER) := 1 - word(RECEIVER)
			if word(RECEIVER) = 1 then
				place(RECEIVER) := PUBLISHING
			endif
		endpar

	rule r_faultyPublish =
		par
			taken := (taken + 2) mod 4
			place(RECEIVER) := RAISING
		endpar

	main rule r_Main =
		choose $side in Side with place($side) != ASLEEP do
			if chosen = OTHER_SLOT and $side = RECEIVER and place($side) = WORKING then
				r_faultyRead[]
			else
				if chosen = LOSES and $side = RECEIVER and place($side) = PUBLISHING then
					r_faultyPublish[]
				else
					if chosen = OVERRUNS and $side = SENDER and place($side) = OUTSIDE then
						r_begin[$side]
					else
						r_move[$side]
					endif
				endif
			endif

default init s0:
	function chosen = fault
	function seeded = NONE
	function sent = 0
	function taken = 0
	function content($s in Slot, $w in Word) = 0
	function calls($s in Side) = 0
	function announced($s in Side) = false
	function place($s in Side) = OUTSIDE
	function word($s in Side) = 0
	function read($w in Word) = 0
	function next = 0
	function due = 0
