/* What the parts of the press cell tell each other. */
module PressData

import ../../library/std/StandardLibrary

export *

signature:
	enum domain Position = {LOW | BETWEEN | HIGH}
	enum domain Command = {LOWER | RAISE | HOLD}

definitions:
