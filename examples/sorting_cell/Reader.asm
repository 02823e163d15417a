/* Reads where a parcel goes off its label. */
asm Reader

import ../../library/std/StandardLibrary
import ../../library/std/LTLLibrary
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

	/* each label is read at once: 1 to 4 go to the left, 5 to 8 to the right, the others to the end of the belt */
	LTLSPEC ltlSpec_left:
		(forall $p in Parcel, $d in {1 : 4} with g(y(labels = ($p, $d)) implies codes = ($p, LEFT)))
	LTLSPEC ltlSpec_right:
		(forall $p in Parcel, $d in {5 : 8} with g(y(labels = ($p, $d)) implies codes = ($p, RIGHT)))
	LTLSPEC ltlSpec_end:
		(forall $p in Parcel, $d in {0, 9} with g(y(labels = ($p, $d)) implies codes = ($p, END)))

	main rule r_Main =
		if isDef(labels) then codes := (first(labels), binOf(second(labels))) endif

default init s0:
