/**
 * A wrong sibling of WrappedEncoder: where the counter goes round upwards, the turn is forgotten. The first run that shows it has 328 steps
 * at full speed: a short search does not find it, and no proof goes through.
 */
asm WrappedEncoderFaulty

import StandardLibrary

signature:
	domain Movement subsetof Integer
	monitored moved: Movement
	// What the encoder's counter shows, 0 to 65535.
	controlled raw: Integer
	controlled turns: Integer

definitions:
	domain Movement = {-100 : 100}

	rule r_Count($sum in Integer) =
		if $sum > 65535 then
			raw := $sum - 65536
		else
			if $sum < 0 then
				par
					raw := $sum + 65536
					turns := turns - 1
				endpar
			else
				raw := $sum
			endif
		endif

	main rule r_Main =
		let ($place = 65536 * turns + raw + moved) in
			if $place <= 1000000000 and $place >= -1000000000 then
				r_Count[raw + moved]
			endif
		endlet

default init s0:
	function raw = 32768
	function turns = 0
