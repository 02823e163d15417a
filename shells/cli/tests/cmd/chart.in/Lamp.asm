asm Lamp
import StandardLibrary
signature:
	enum domain Light = {OFF | ON}
	controlled light: Light
	monitored pressed: Boolean
definitions:
	rule r_lamp =
		if pressed then
			switch light
				case OFF: light := ON
				case ON: light := OFF
			endswitch
		endif
	main rule r_Main = r_lamp[]

default init s0:
	function light = OFF
