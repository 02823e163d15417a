/* A shared value with any values, whose writer and reader move one at a time or at once, against what is known beside it: the
   newest value, and whether it was read. The numbers of values grow for ever and matter only by whether they are equal, so what
   was read last becomes 2 in every step. */
asm Value

import ../std/StandardLibrary
import ../std/CTLLibrary
import ../patterns/SharedValue

signature:
	enum domain Moves = {WRITER_MOVES | READER_MOVES | BOTH_MOVE}
	domain Datum subsetof Integer

	static cell: SharedValue

	monitored datum: Datum

	// What nobody in the program knows
	controlled newest: Integer
	controlled isUnread: Boolean
	// what the last reading gave, and what it had to give
	controlled due: Integer
	controlled dueIsNew: Boolean
	// the last step wrote one value if the writer moved, and counted one as overwritten if it was unread
	controlled isCounted: Boolean

definitions:
	domain Datum = {7 : 9}

	// A value that is read in the very step in which it is written over counts as overwritten: its writer cannot know.
	rule r_observe($moves in Moves, $sequence in Integer) =
		let ($writes = $moves != READER_MOVES, $reads = $moves != WRITER_MOVES) in
			par
				isCounted :=
					sv_sequence(cell) - $sequence = (if $writes then 1 else 0 endif)
					and sv_overwritten(cell) = (if $writes and isUnread then 1 else 0 endif)
				if $reads then
					par
						dueIsNew := isUnread
						due := if isUnread then newest else due endif
					endpar
				endif
				if $writes then
					newest := sv_staged(cell)
				endif
				isUnread := if $writes then true else if $reads then false else isUnread endif endif
			endpar
		endlet

	// More than one value behind is like one behind.
	rule r_shift =
		let ($less = sv_receivedSequence(cell) - 2) in
			par
				sv_receivedSequence(cell) := 2
				sv_sequence(cell) := min(sv_sequence(cell) - $less, 4)
				sv_overwritten(cell) := 0
			endpar
		endlet

	invariant inv_sound over sv_sequence: sv_sound(cell)
	invariant inv_isNew over sv_sequence: sv_isNew(cell) = isUnread
	// each value is written once, and counted if it was never read
	invariant inv_counted over sv_overwritten: isCounted
	// a reading gives the newest value, and says truly whether it is new
	invariant inv_received over sv_received: sv_received(cell) = due
	invariant inv_fresh over sv_fresh: sv_fresh(cell) = dueIsNew

	CTLSPEC ctlSpec_comes: ag(ef(sv_fresh(cell)))

	main rule r_Main =
		choose $moves in Moves with true do
			let ($sequence = sv_sequence(cell)) in
				seq
					sv_staged(cell) := datum
					par
						if $moves != READER_MOVES then
							r_sv_write[cell]
						endif
						if $moves != WRITER_MOVES then
							r_sv_read[cell]
						endif
					endpar
					r_observe[$moves, $sequence]
					r_shift[]
				endseq
			endlet

default init s0:
	function sv_staged($v in SharedValue) = 0
	function sv_value($v in SharedValue) = 0
	function sv_sequence($v in SharedValue) = 2
	function sv_overwritten($v in SharedValue) = 0
	function sv_received($v in SharedValue) = 0
	function sv_receivedSequence($v in SharedValue) = 2
	function sv_fresh($v in SharedValue) = false
	function newest = 0
	function isUnread = false
	function due = 0
	function dueIsNew = false
	function isCounted = true
