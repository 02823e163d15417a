/* The ages of data in a system of tasks, to the tick, with finitely many states: times are told from the present tick on, and what is
   older than any way allows is as old as the oldest. Where nobody will read a datum any more, its time is forgotten. */
module AgesInTicks

import ../std/StandardLibrary
import ../patterns/ControlTask
import ../patterns/DataAges
import Quotient
import SystemProperties
import SystemInTicks

export *

signature:
	// a tick more than any way allows: what came before is too old, however old it is
	controlled tooOld: Integer
	// a way begins in its cycles
	derived isSource: Scheduler -> Boolean
	derived since: Integer -> Integer

definitions:
	function isSource($c in Scheduler) =
		(exists $h in AgeHop with hop_writer($h) = $c and isUndef(hop_before($h)))
		or (exists $w in AgeWay with way_end($w) = $c and isUndef(way_hop($w)))

	function since($tick in Integer) =
		if isDef($tick) then max($tick - clock, -tooOld) else undef endif

	rule r_shiftBuffer($h in AgeHop, $b in SwingingBuffer) =
		let ($first = indexWrite($b), $arrays = dimension($b)) in
			forall $n in {0 : $arrays - 1} with true do
				let ($m = ($n + $first) mod $arrays) in
					hop_slot($h, $n) := if isAlive($b, $m) then since(hop_slot($h, $m)) else undef endif
				endlet
		endlet

	rule r_shiftQueue($h in AgeHop, $q in MessageQueue) =
		let ($taken = mq_taken($q), $length = mq_length($q)) in
			forall $n in {0 : mq_capacity($q) - 1} with true do
				hop_slot($h, $n) :=
					if $n < $length then since(hop_slot($h, ($taken + $n) mod mq_capacity($q))) else undef endif
		endlet

	rule r_shiftHop($h in AgeHop) =
		par
			hop_taken($h) := since(hop_taken($h))
			hop_received($h) := since(hop_received($h))
			if isDef(hop_buffer($h)) then
				r_shiftBuffer[$h, hop_buffer($h)]
			else
				if isDef(hop_queue($h)) then
					r_shiftQueue[$h, hop_queue($h)]
				else
					hop_slot($h, 0) := if sv_isNew(hop_value($h)) then since(hop_slot($h, 0)) else undef endif
				endif
			endif
		endpar

	rule r_forgetAges =
		par
			forall $c in Scheduler with true do
				cycleStart($c) := if isSource($c) then since(cycleStart($c)) else undef endif
			forall $h in AgeHop with true do r_shiftHop[$h]
			forall $w in AgeWay with true do
				par
					way_taken($w) := since(way_taken($w))
					way_oldest($w) := 0
					// one is too many; how many more does not matter
					way_tooOld($w) := min(way_tooOld($w), 1)
				endpar
		endpar

	// A tick of the system, as in SystemInTicks, and what it does to the ages.
	rule r_agedTick($main in Rule) =
		seq
			r_setTimes[]
			$main[]
			r_ages[]
			r_observe[]
			r_resetTimes[]
			par
				r_forget[]
				r_forgetAges[]
			endpar
			r_stopEndless[]
			r_remember[]
			r_rememberAges[]
		endseq
