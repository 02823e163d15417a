/* What tracker and head tell each other. */
module Tracking

import ../../library/std/StandardLibrary

export *

signature:
	/* what the head does: it stands, or it follows where the object is or should be */
	enum domain Pursuit = {HOLDING | FOLLOWING}

definitions:
