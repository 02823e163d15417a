asm Light

import StandardLibrary

signature:
	enum domain Colour = { RED | GREEN | BLUE }
	domain Small subsetof Integer
	monitored passed: Boolean
	monitored level: Small
	controlled light: Colour
	controlled count: Integer
	derived big: Boolean

definitions:
	domain Small = { 1 : 5 }
	function big = count > 7

	rule r_next =
		switch light
			case RED: light := GREEN
			case GREEN: light := BLUE
			case BLUE: light := RED
		endswitch

	invariant inv_small over count: count < 20

	main rule r_Main =
		par
			if passed then r_next[] endif
			choose $n in Small with $n <= level do count := count + $n
		endpar

default init s0:
	function light = RED
	function count = 0
