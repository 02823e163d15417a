/* What supervisor, aligner, force sensor and stage tell each other. */
module Assembling

import ../../library/std/StandardLibrary

export *

signature:
	/* what the supervisor orders */
	enum domain Work = {REST | ALIGN | LOWER}
	/* what an image shows: not all marks; how the part lies; that it lies right, and did in the images before */
	enum domain Marks = {HIDDEN | APART | TOGETHER}
	/* what the force sensor feels: nothing; that the part lies on the substrate; more than the part bears */
	enum domain Touch = {FREE | CONTACT | OVERLOAD}
	/* how far the stage is */
	enum domain Progress = {PAUSED | ALIGNING | ALIGNED | LOWERING | PLACED | RETRACTING | RETRACTED}
	/* what the axes do: nothing; x, y and turn follow a correction; z goes down; z goes up */
	enum domain Motion = {STAND | CORRECT | DOWN | UP}

definitions:
