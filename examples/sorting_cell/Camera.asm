/* Numbers the parcels that come under the line, and sends what is to be seen of each. */
asm Camera

import ../../library/std/StandardLibrary
import Parcels

signature:
	monitored seen: Boolean
	monitored printed: Digit
	monitored outline: Dent
	out labels: Prod(Parcel, Digit)
	out shapes: Prod(Parcel, Dent)
	out arrivals: Parcel
	controlled wasSeen: Boolean

definitions:
	/* another parcel: the picture of each is sent until the next one comes */
	rule r_number =
		let ($parcel = (arrivals + 1) mod 3) in
			par
				arrivals := $parcel
				labels := ($parcel, printed)
				shapes := ($parcel, outline)
			endpar
		endlet

	invariant inv_oneParcel over labels, shapes:
		isDef(labels) implies first(labels) = arrivals and first(shapes) = arrivals

	main rule r_Main =
		par
			wasSeen := seen
			if seen and not wasSeen then r_number[] endif
		endpar

default init s0:
	function wasSeen = false
	function arrivals = 2
