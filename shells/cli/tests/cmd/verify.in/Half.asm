asm Half
import StandardLibrary
import CTLLibrary
signature:
	enum domain Light = {RED | GREEN}
	controlled light: Light
	controlled last: Boolean
definitions:
	CTLSPEC ag(last or light = RED)
	main rule r_Main =
		if light = RED then
			light := GREEN
		else
			light := RED
		endif
default init s0:
	function light = GREEN
