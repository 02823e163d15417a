asm Grow

import StandardLibrary

signature:
	dynamic abstract domain Node
	controlled last: Node
	controlled next: Node -> Node

definitions:
	main rule r_Main = extend Node with $n do par next($n) := last last := $n endpar
