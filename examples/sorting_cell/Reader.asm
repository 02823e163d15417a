/* Reads where a parcel goes off its label. */
asm Reader

import ../../library/std/StandardLibrary
import Parcels

signature:
	monitored labels: Prod(Parcel, Digit)
	out codes: Prod(Parcel, Bin)
	static binOf: Digit -> Bin

definitions:
	function binOf($digit in Digit) =
		if $digit >= 1 and $digit <= 4 then
			LEFT
		else
			if $digit >= 5 and $digit <= 8 then
				RIGHT
			else
				END
			endif
		endif

	main rule r_Main =
		if isDef(labels) then codes := (first(labels), binOf(second(labels))) endif

default init s0:
