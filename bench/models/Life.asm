/* Conway's Game of Life on a torus of 32 × 32 cells. The twin of ../native/life.cpp, step by step. */
asm Life

import ../../library/std/StandardLibrary

signature:
	domain Coordinate subsetof Integer

	controlled alive: Prod(Coordinate, Coordinate) -> Boolean
	controlled generation: Integer

	static wrap: Integer -> Integer
	derived count: Prod(Integer, Integer) -> Integer
	derived neighbours: Prod(Coordinate, Coordinate) -> Integer

definitions:
	domain Coordinate = {0 : 31}

	function wrap($n in Integer) = ($n + 32) mod 32

	function count($x in Integer, $y in Integer) =
		if alive(wrap($x), wrap($y)) then 1 else 0 endif

	function neighbours($x in Coordinate, $y in Coordinate) =
		count($x - 1, $y - 1)
		+ count($x, $y - 1)
		+ count($x + 1, $y - 1)
		+ count($x - 1, $y)
		+ count($x + 1, $y)
		+ count($x - 1, $y + 1)
		+ count($x, $y + 1)
		+ count($x + 1, $y + 1)

	main rule r_Main =
		par
			forall $x in Coordinate, $y in Coordinate with true do
				let ($n = neighbours($x, $y)) in
					alive($x, $y) := $n = 3 or ($n = 2 and alive($x, $y))
				endlet
			generation := generation + 1
		endpar

default init s0:
	function generation = 0
	function alive($x in Coordinate, $y in Coordinate) =
		($x * 7 + $y * 13 + $x * $y * 3) mod 5 < 2
