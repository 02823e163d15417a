asm Old
import StandardLibrary
signature:
	controlled y: Integer
	controlled x: Integer // caffè, là
definitions:
	main rule r_Main = x := x + 1
default init s0:
	function x = 0
