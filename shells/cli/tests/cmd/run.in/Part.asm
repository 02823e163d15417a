module Part

import StandardLibrary
export *

signature:
	controlled x: Integer

definitions:
	rule r_part = x := 1
