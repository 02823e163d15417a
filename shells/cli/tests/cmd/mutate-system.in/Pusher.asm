asm Pusher
import StandardLibrary
signature:
	monitored marks: Boolean
	monitored stop: Boolean
	out arm: Boolean
	controlled halted: Boolean
definitions:
	main rule r_Main =
		par
			halted := halted or stop
			arm := isDef(marks) and marks and not stop and not halted
		endpar
default init s0:
	function arm = false
	function halted = false
