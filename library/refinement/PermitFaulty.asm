/* PermitLine with a fault that a refinement check must find, chosen by `--bound fault=…`: who finds no permit goes in all the same; who
   gives up does not look whether he was granted the permit meanwhile, so it is lost; who hands the permit over also gives one back. */
asm PermitFaulty

import ../std/StandardLibrary
import ../runtime/PermitLine

signature:
	enum domain Fault = {GOES_IN | LOSES | DOUBLES}
	monitored fault: Fault
	controlled seeded: Fault

definitions:
	rule r_faultyLeave($u in User) =
		par
			line := excluding(line, $u)
			place($u) := OUTSIDE
		endpar

	rule r_faultyRelease($u in User) =
		par
			permits := permits + 1
			called($u) := first(line)
			line := tail(line)
			place($u) := CALLING
		endpar

	main rule r_Main =
		choose $user in User with place($user) != ASLEEP do
			switch place($user)
				case OUTSIDE:
					if seeded = GOES_IN and permits = 0 then
						place($user) := INSIDE
					else
						r_ask[$user]
					endif
				case COUNTING: r_count[$user]
				case LOOKING: r_look[$user]
				case DOZING: r_doze[$user]
				case LEAVING:
					if seeded = LOSES then
						r_faultyLeave[$user]
					else
						r_leave[$user]
					endif
				case INSIDE:
					if seeded = DOUBLES and not isEmpty(line) then
						r_faultyRelease[$user]
					else
						r_release[$user]
					endif
				case CALLING: r_call[$user]
				case WAKING: r_wake[$user]
			endswitch

default init s0:
	function seeded = fault
	function countsFirst = true
	function permits = 1
	function line = []
	function calls($u in User) = 0
	function place($u in User) = OUTSIDE
