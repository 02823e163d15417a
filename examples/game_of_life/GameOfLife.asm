/* Conway's Game of Life on a torus: every cell steps at once, which is what `forall` means. */
asm GameOfLife

import ../../library/std/StandardLibrary

signature:
	domain Coordinate subsetof Integer

	static side: Integer
	static offsets: Seq(Prod(Integer, Integer))

	controlled alive: Prod(Coordinate, Coordinate) -> Boolean
	controlled generation: Integer

	static wrap: Integer -> Integer
	derived neighbours: Prod(Coordinate, Coordinate) -> Integer
	derived population: Integer

definitions:
	domain Coordinate = {0 : 11}

	function side = 12
	function offsets = [(-1, -1), (-1, 0), (-1, 1), (0, -1), (0, 1), (1, -1), (1, 0), (1, 1)]
	function wrap($n in Integer) = ($n + side) mod side

	function neighbours($x in Coordinate, $y in Coordinate) =
		length([$d in offsets | alive(wrap($x + first($d)), wrap($y + second($d))) : $d])

	function population =
		size({$x in Coordinate, $y in Coordinate | alive($x, $y) : ($x, $y)})

	invariant inv_wrap over wrap: (forall $x in Coordinate with wrap($x) = $x)

	main rule r_Main =
		par
			forall $x in Coordinate, $y in Coordinate with true do
				let ($n = neighbours($x, $y)) in
					if alive($x, $y) then
						if $n < 2 or $n > 3 then alive($x, $y) := false endif
					else
						if $n = 3 then alive($x, $y) := true endif
					endif
				endlet
			generation := generation + 1
		endpar

// a glider in the corner, a blinker below it
default init s0:
	function generation = 0
	function alive($x in Coordinate, $y in Coordinate) =
		contains({(1, 0), (2, 1), (0, 2), (1, 2), (2, 2), (7, 8), (8, 8), (9, 8)}, ($x, $y))
