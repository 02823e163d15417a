module Shared

import StandardLibrary

export *

signature:
	controlled opened: Boolean

definitions:
