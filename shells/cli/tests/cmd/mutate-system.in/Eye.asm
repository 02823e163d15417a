asm Eye
import StandardLibrary
signature:
	monitored seen: Boolean
	out marks: Boolean
definitions:
	main rule r_Main = marks := seen
default init s0:
	function marks = false
