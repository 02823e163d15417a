asm Lamp
import StandardLibrary
signature:
	monitored seen: Boolean
	out light: Boolean
definitions:
	main rule r_Main = light := seen
default init s0:
	function light = false
