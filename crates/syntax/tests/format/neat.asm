/* A header,
   of two lines. */
asyncr asm messy // the name

import ../StandardLibrary
import Other (f, D, r_x)

// what others see
export f, D

signature: // declarations
	// domains
	enum domain Colour = {RED | GREEN, BLUE}
	abstract domain Node
	dynamic domain Small subsetof Integer

	// a function
	dynamic controlled f: Prod(Integer, Small) -> Powerset(Colour)
	monitored g: Boolean // an input

	/* inline */
	static h: Integer

definitions:
	domain Small = {-3 : 5, 2}
	function h = 1 + 2 * 3 ^ -2
	function k($x in Integer, $y in Small) =
		if $x > 3 then {1, 2} elseif g then [] else let ($z = 1) in {$z} endlet endif
	function veryLong =
		aFunctionWithALongName(1, 2) + anotherFunctionWithALongName(3, 4) * yetAnotherFunction(5) and someThing
		or (forall $x in Small, $y in Colour with f($x, $y) = {$y} and $x < -1)
	function choice =
		switch $x
			case 1: 2
			case 3:
				4
			otherwise 5
		endswitch
	function maps = {1 -> 2, 3 -> {->}}
	function picks = {$x in Small | not $x = 3 : $x} = {$x in Small : $x -> 1 |}
	function bags = <1, <-2>, <<r_x(Integer)>>>

	// before a rule
	macro rule r_x($a in Integer) = skip
	turbo rule r_t($a in Integer) in Integer =
		local u: Integer [u := 1]
		result := u
	rule r_y =
		par
			x := 1 // first

			// second
			y := 2
			if a then x := 1 endif
			if a then
				x := 1
			// in the branch
			else
				if b then skip endif
			// at its end
			endif
			forall $x in Small with $x > 1 do f($x, 1) := {}
			choose $x in Small do
				seq
					skip
					r_x[1]
				endseq
			ifnone
				$r[2]
			switch a
				case 1: skip
				case 2:
					seq
						x := 1
						y := 2
					endseq
				otherwise program(self)
			endswitch
			let ($v = 1, $w = $v) in x <- r_t($w) endlet
			extend Node with $n, $m do
				while true do
					iterate
						skip
					enditerate
		// the end of the block
		endpar
	// an invariant
	invariant inv_a over f(Small), Small, r_x: f(1, 2) != {}
	CTLSPEC ctlSpec_a: ag(g)
	INVAR g
	main rule r_Main = r_y[]
	// no more rules

default init s0:
	function h = 2 // two
	agent Node: r_x[1]
	// the end
