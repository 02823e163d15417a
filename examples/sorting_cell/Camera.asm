/* Numbers the parcels that come under the line, and sends what is to be seen of each. */
asm Camera

import ../../library/std/StandardLibrary
import ../../library/std/LTLLibrary
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
		let ($parcel = (arrivals + 1) mod 6) in
			par
				arrivals := $parcel
				labels := ($parcel, printed)
				shapes := ($parcel, outline)
			endpar
		endlet

	invariant inv_oneParcel over labels, shapes:
		isDef(labels) implies first(labels) = arrivals and first(shapes) = arrivals

	/* a parcel that comes has the next number, and is sent as it is seen then; nothing else gets a number */
	LTLSPEC ltlSpec_numbers:
		(forall $p in Parcel with g(y(arrivals = $p and seen and not y(seen)) implies arrivals = ($p + 1) mod 6))
	LTLSPEC ltlSpec_keeps:
		(forall $p in Parcel with g(y(arrivals = $p and not (seen and not y(seen))) implies arrivals = $p))
	LTLSPEC ltlSpec_label:
		(forall $d in Digit with g(y(printed = $d and seen and not y(seen)) implies labels = (arrivals, $d)))
	LTLSPEC ltlSpec_shape:
		(forall $d in Dent with g(y(outline = $d and seen and not y(seen)) implies shapes = (arrivals, $d)))
	/* the first parcel has the number 0 */
	LTLSPEC ltlSpec_begins: arrivals = 5

	main rule r_Main =
		par
			wasSeen := seen
			if seen and not wasSeen then r_number[] endif
		endpar

default init s0:
	function wasSeen = false
	function arrivals = 5
