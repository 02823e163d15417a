/* SwingSteps with a fault that it is there to exclude, chosen by `--bound fault=…`. */
asm SwingStepsFaulty

import ../std/StandardLibrary
import ../runtime/SwingSteps

signature:
	monitored fault: Fault

definitions:
	main rule r_Main =
		choose $side in Side with true do
			r_move[$side]

default init s0:
	function readerIsMaster = readerLeads
	function seeded = fault
	function holder = undef
	function marked = false
	function indexRead = 1
	function indexWrite = 0
	function pending = false
	function content($a in Array, $w in Word) = 0
	function place($s in Side) = BEGINNING
	function word($s in Side) = 0
	function held = 1
	function datum = 1
	function seen($w in Word) = 0
	function staged = 0
	function newest = 0
	function due = 0
