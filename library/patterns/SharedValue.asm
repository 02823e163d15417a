/* A shared value: one cell, written by one task and read by another, without a lock.

   A step is atomic, so a value is never seen half written; on a target machine it must fit what the
   processor writes at once. A reading gives the last value written, however old; a value that is
   written over before it was read is gone, and counted. So it suits what only the newest matters of and
   what is small: a mode, a limit, a single measurement. Larger data belong into a swinging buffer,
   messages of which each one counts into a queue.

   Both sides may step at the same instant, so they share no location that both write: the writer has
   `sv_value`, `sv_sequence` and `sv_overwritten`, the reader the rest. A value written in the step in
   which it is read is read the next time. */
module SharedValue

import ../std/StandardLibrary

export *

signature:
	abstract domain SharedValue

	// Written by the writer alone
	controlled sv_staged: SharedValue -> Integer
	controlled sv_value: SharedValue -> Integer
	// 0: nothing was ever written
	controlled sv_sequence: SharedValue -> Integer
	controlled sv_overwritten: SharedValue -> Integer

	// Written by the reader alone
	controlled sv_received: SharedValue -> Integer
	controlled sv_receivedSequence: SharedValue -> Integer
	// the latest reading brought a value the reader had not seen before
	controlled sv_fresh: SharedValue -> Boolean

	derived sv_isNew: SharedValue -> Boolean
	derived sv_sound: SharedValue -> Boolean

definitions:
	// There is a value that was not read yet.
	function sv_isNew($v in SharedValue) =
		sv_sequence($v) != sv_receivedSequence($v)

	// What was read was written, and no more is lost than was written.
	function sv_sound($v in SharedValue) =
		sv_receivedSequence($v) <= sv_sequence($v) and sv_overwritten($v) <= sv_sequence($v)

	rule r_sv_write($v in SharedValue) =
		par
			sv_value($v) := sv_staged($v)
			sv_sequence($v) := sv_sequence($v) + 1
			if sv_isNew($v) then
				sv_overwritten($v) := sv_overwritten($v) + 1
			endif
		endpar

	rule r_sv_read($v in SharedValue) =
		par
			sv_fresh($v) := sv_isNew($v)
			if sv_isNew($v) then
				par
					sv_received($v) := sv_value($v)
					sv_receivedSequence($v) := sv_sequence($v)
				endpar
			endif
		endpar
