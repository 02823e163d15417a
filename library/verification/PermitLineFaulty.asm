/* PermitLine with the fault that it is there to exclude: users who look at the line before they take the count. */
asm PermitLineFaulty

import ../std/StandardLibrary
import ../runtime/PermitLine

signature:

definitions:
	main rule r_Main =
		choose $user in User with place($user) != ASLEEP do
			switch place($user)
				case OUTSIDE: r_ask[$user]
				case COUNTING: r_count[$user]
				case LOOKING: r_look[$user]
				case DOZING: r_doze[$user]
				case LEAVING: r_leave[$user]
				case INSIDE: r_release[$user]
				case CALLING: r_call[$user]
				case WAKING: r_wake[$user]
			endswitch

default init s0:
	function countsFirst = false
	function permits = 1
	function line = []
	function calls($u in User) = 0
	function place($u in User) = OUTSIDE
