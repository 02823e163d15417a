// A system whose data get too old: its check finds a run that shows it.

// The law may take so long that what the motor gets is too old.
export const LATE = `chart Late

import patterns/ControlTask

system late "Late"
	tick 0.5 ms
	sensor encoder
	actuator motor
	component sensing "Sensing" synchronous period 10 ms
		elaborate acquire 6 ms
		write position 0.5 ms
	endcomponent
	component control "Control" synchronous period 20 ms
		read position 0.5 ms
		elaborate law 5..12 ms
	endcomponent
	channel position from sensing to control swinging buffer 2
	encoder -> sensing
	control -> motor
	within 20 ms from encoder to motor
endsystem
`
