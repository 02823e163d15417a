/**
 * The position of an axis, as its users see it: a number that follows the movement, between two end stops. It has more values than can
 * be gone through.
 */
asm Position

import StandardLibrary

signature:
	domain Movement subsetof Integer
	// In ticks of the encoder, since the last step.
	monitored moved: Movement
	controlled position: Integer

definitions:
	domain Movement = {-100 : 100}

	main rule r_Main =
		if position + moved <= 1000000000 and position + moved >= -1000000000 then
			position := position + moved
		endif

default init s0:
	function position = 32768
