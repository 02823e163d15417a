/* Counts the words of a text in a map. Each step handles one word, in lower case. */
asm WordCount

import ../../library/std/StandardLibrary

signature:
	controlled words: Seq(String)
	controlled counts: Map(String, Integer)
	controlled longest: String
	derived occurrences: String -> Integer
	derived finished: Boolean

definitions:
	function occurrences($w in String) =
		if isDef(at(counts, $w)) then at(counts, $w) else 0 endif

	function finished = isEmpty(words)

	rule r_count($w in String) =
		par
			counts := assign(counts, $w, occurrences($w) + 1)
			if size($w) > size(longest) then longest := $w endif
		endpar

	main rule r_Main =
		if not finished then
			let ($w = toLower(first(words))) in
				par
					r_count[$w]
					words := tail(words)
				endpar
			endlet
		endif

default init s0:
	function words = split("The cat and the dog and THE bird", " ")
	function counts = {->}
	function longest = ""
