/* Counts the words of a text in a map. Each step handles one word, in lower case. */
asm WordCount

import ../../library/std/StandardLibrary
import ../../library/std/CTLLibrary

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

	// no word is counted more often than it may have come, and none is longer than the longest
	invariant inv_counts over counts: (forall $w in keys(counts) with at(counts, $w) + length(words) <= 8)
	invariant inv_longest over longest: (forall $w in keys(counts) with size($w) <= size(longest))
	// of words that are equally long the first one is kept
	CTLSPEC ctlSpec_first: ag(longest = "" or longest = "the" or longest = "bird")
	// at the end each word of the text is counted as often as it occurs, and the longest is found
	CTLSPEC ctlSpec_ends:
		af(
			finished
			and occurrences("the") = 3
			and occurrences("and") = 2
			and occurrences("cat") = 1
			and occurrences("dog") = 1
			and occurrences("bird") = 1
			and longest = "bird")

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
