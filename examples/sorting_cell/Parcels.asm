/* What is known of parcels in the cell: the data of the channels and sensors. */
module Parcels

import ../../library/std/StandardLibrary

export *

signature:
	/* parcels are numbered as they come; a number is used again when nobody says anything more about its last parcel */
	domain Parcel subsetof Integer
	/* how far the belt has come, in places: it is counted around */
	domain Way subsetof Integer
	/* the digit that is printed on a parcel; 0: it cannot be read */
	domain Digit subsetof Integer
	/* how far the outline of a parcel is from that of a whole one, in millimetres */
	domain Dent subsetof Integer
	/* where a parcel goes: to a bin beside the belt, or on to its end */
	enum domain Bin = {LEFT | RIGHT | END}
	enum domain Shape = {WHOLE | DAMAGED}

definitions:
	domain Parcel = {0 : 5}
	domain Way = {0 : 3}
	domain Digit = {0 : 9}
	domain Dent = {0 : 9}
