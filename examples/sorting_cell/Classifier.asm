/* Says whether a parcel is whole. */
asm Classifier

import ../../library/std/StandardLibrary
import ../../library/std/LTLLibrary
import Parcels

signature:
	monitored shapes: Prod(Parcel, Dent)
	out classes: Prod(Parcel, Shape)
	static allowed: Dent

definitions:
	function allowed = 3

	/* up to 3 mm a parcel is whole, from 4 mm on it is damaged */
	LTLSPEC ltlSpec_whole:
		(forall $p in Parcel, $d in {0 : 3} with g(y(shapes = ($p, $d)) implies classes = ($p, WHOLE)))
	LTLSPEC ltlSpec_damaged:
		(forall $p in Parcel, $d in {4 : 9} with g(y(shapes = ($p, $d)) implies classes = ($p, DAMAGED)))

	main rule r_Main =
		if isDef(shapes) then
			classes := (first(shapes), if second(shapes) <= allowed then WHOLE else DAMAGED endif)
		endif

default init s0:
