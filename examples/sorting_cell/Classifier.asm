/* Says whether a parcel is whole. */
asm Classifier

import ../../library/std/StandardLibrary
import Parcels

signature:
	monitored shapes: Prod(Parcel, Dent)
	out classes: Prod(Parcel, Shape)
	static allowed: Dent

definitions:
	function allowed = 3

	main rule r_Main =
		if isDef(shapes) then
			classes := (first(shapes), if second(shapes) <= allowed then WHOLE else DAMAGED endif)
		endif

default init s0:
