/* What visual servoing and the robot controller show on the operator's panel. */
module Guiding

import ../../library/std/StandardLibrary

export *

signature:
	/* no target yet; the discs are looked for in the whole image; all are seen; all are seen, and where they should be; some are not
	   seen and stand where the others say; they were given up and are looked for again */
	enum domain ServoMode = {WITHOUT_TARGET | SEARCHING | TRACKING | CONVERGED | COVERED | LOST}
	/* the camera stands; it moves as the set-points say; it comes to rest for want of them */
	enum domain ArmMode = {STANDING | FOLLOWING | STOPPING}

definitions:
