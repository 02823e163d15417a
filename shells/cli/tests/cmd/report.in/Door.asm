asm Door
import StandardLibrary
signature:
	enum domain Wing = {LEFT | RIGHT}
	enum domain Place = {OPEN | MOVING | CLOSED}
	controlled place: Wing -> Place
	controlled locked: Boolean
	controlled moves: Integer
	controlled wishes: Seq(Integer)
definitions:
	main rule r_Main =
		par
			forall $wing in Wing do
				switch place($wing)
					case CLOSED: if $wing = LEFT or moves > 4 then place($wing) := MOVING endif
					case MOVING: place($wing) := OPEN
					case OPEN: place($wing) := CLOSED
				endswitch
			moves := moves + 1
			locked := place(LEFT) = OPEN
		endpar
default init s0:
	function place($wing in Wing) = CLOSED
	function locked = true
	function moves = 0
	function wishes = []
