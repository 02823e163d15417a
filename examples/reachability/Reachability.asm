/* A graph that grows, and the nodes that can be reached from its root. New nodes come from the reserve
   by `extend`; the closure is computed in one step, by iterating until nothing changes. */
asm Reachability

import ../../library/std/StandardLibrary

signature:
	dynamic abstract domain Node
	static root: Node

	enum domain Order = {GROW | CUT | CLOSE | REST}
	monitored order: Order

	controlled successors: Node -> Powerset(Node)
	controlled reached: Powerset(Node)
	controlled depth: Node -> Integer
	controlled nodes: Powerset(Node)
	controlled youngest: Node

	derived frontier: Powerset(Node)

definitions:
	function frontier =
		{$n in nodes | not contains(reached, $n) and (exists $m in reached with contains(successors($m), $n)) : $n}

	// A chain grows at its youngest node.
	rule r_grow =
		extend Node with $n do
			par
				nodes := including(nodes, $n)
				successors($n) := {}
				successors(youngest) := including(successors(youngest), $n)
				youngest := $n
			endpar

	// All edges out of the root are taken away.
	rule r_cut = successors(root) := {}

	rule r_close =
		seq
			par
				reached := {root}
				depth(root) := 0
			endpar
			iterate
				if notEmpty(frontier) then
					par
						reached := union(reached, frontier)
						forall $n in frontier with true do
							choose $m in reached with contains(successors($m), $n) do
								depth($n) := depth($m) + 1
					endpar
				endif
			enditerate
		endseq

	invariant inv_reached over reached: (forall $n in reached with contains(nodes, $n))
	invariant inv_root over reached: contains(reached, root)

	main rule r_Main =
		switch order
			case GROW: r_grow[]
			case CUT: r_cut[]
			case CLOSE: r_close[]
		endswitch

default init s0:
	function nodes = {root}
	function reached = {root}
	function depth($n in Node) = if $n = root then 0 else undef endif
	function successors($n in Node) = {}
	function youngest = root
