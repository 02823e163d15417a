asm Counter
import StandardLibrary
signature:
	domain Small subsetof Integer
	controlled count: Small
	monitored up: Boolean
definitions:
	domain Small = { 0 : 2 }
	invariant inv_low over count: count < 2
	main rule r_Main = if up then choose $d in { 1, 2 } with count + $d <= 2 do count := count + $d endif
default init s0:
	function count = 0
