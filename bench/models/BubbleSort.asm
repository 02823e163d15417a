/* Bubble sort, one swap a step: any two neighbours in the wrong order change places until none are left.
   The twin of ../native/bubble_sort.cpp, step by step. */
asm BubbleSort

import ../../library/std/StandardLibrary

signature:
	domain Index subsetof Integer
	domain Place subsetof Integer

	controlled a: Index -> Integer
	controlled swaps: Integer

definitions:
	domain Index = {0 : 63}
	// the left one of two neighbours
	domain Place = {0 : 62}

	main rule r_Main =
		choose $i in Place with a($i) > a($i + 1) do
			par
				a($i) := a($i + 1)
				a($i + 1) := a($i)
				swaps := swaps + 1
			endpar

default init s0:
	function a($i in Index) = 63 - $i
	function swaps = 0
