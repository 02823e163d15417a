/* LatestValue with the fault that it is there to exclude: an exchange that falls apart into a load and a store. */
asm LatestValueFaulty

import ../std/StandardLibrary
import ../runtime/LatestValue

signature:

definitions:
	main rule r_Main =
		choose $side in Side with true do
			if $side = PRODUCER then
				r_produce[]
			else
				r_consume[]
			endif

default init s0:
	function atomic = false
	function between = 1
	function fresh = false
	function written = 0
	function held = 2
	function loaded = 1
	function content($a in Array, $w in Word) = 0
	function place($side in Side) = if $side = PRODUCER then FILLING else LOOKING endif
	function word($side in Side) = 0
	function datum = 1
	function seen($w in Word) = 0
	function newest = 0
	function due = 0
