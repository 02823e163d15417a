/* Says whether the camera follows set-points, comes to rest because they are too old, or stands: one step in each period of the robot
   controller. */
asm Arm

import ../../library/std/StandardLibrary
import ../../library/std/CTLLibrary
import ../../library/std/LTLLibrary
import Guiding

signature:
	/* there is a set-point whose image is not too old, and it is known where the arm is */
	monitored isGuided: Boolean
	/* the camera is not moved any more */
	monitored isStill: Boolean
	out arm: ArmMode

definitions:
	/* it follows just the set-points that are not too old; without them it comes to rest, and stands only when it has */
	LTLSPEC ltlSpec_guided: g(arm = FOLLOWING iff y(isGuided))
	LTLSPEC ltlSpec_stops: g(arm = STOPPING iff y(not isGuided and (arm = FOLLOWING or arm = STOPPING and not isStill)))
	LTLSPEC ltlSpec_rests: g(arm = STANDING and y(arm != STANDING) implies y(arm = STOPPING and isStill))
	LTLSPEC ltlSpec_ends: g(y(arm = STOPPING and isStill and not isGuided) implies arm = STANDING)
	LTLSPEC ltlSpec_stands: g(y(arm = STANDING and not isGuided) implies arm = STANDING)
	CTLSPEC ctlSpec_again: ag(ef(arm = FOLLOWING) and ef(arm = STANDING))

	main rule r_Main =
		if isGuided then
			arm := FOLLOWING
		else
			arm := if arm = FOLLOWING or arm = STOPPING and not isStill then STOPPING else STANDING endif
		endif

default init s0:
	function arm = STANDING
