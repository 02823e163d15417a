/* What planner, robot and gripper tell each other. */
module Placing

import ../../library/std/StandardLibrary

export *

signature:
	/* moves are numbered as they are sent; numbers are counted around, since there is one move at a time */
	domain Number subsetof Integer
	/* above the part, down to it, the jaw closed, up; above its place, down, the jaw open, up; open again if nothing was gripped */
	enum domain Move = {OVER | DOWN | CLOSE | UP | CARRY | LOWER | OPEN | RISE | REOPEN}
	/* what the jaw's sensor feels: neither end; the open end; the closed end; a part between the fingers */
	enum domain Feel = {BETWEEN | WIDE | SHUT | AROUND}
	/* how far the gripper is */
	enum domain Jaw = {BUSY | OPENED | EMPTY | HOLDING}

definitions:
	domain Number = {0 : 3}
