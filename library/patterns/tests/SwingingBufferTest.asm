/* A swinging buffer under direct command, without scheduler and without lock: the scenario is
   responsible for the order of the commands, and a wrong order has to be caught by an invariant. */
asm SwingingBufferTest

import ../../std/StandardLibrary
import ../Task
import ../Semaphore
import ../SwingingBuffer

signature:
	enum domain Command = {NOTHING | WRITE | END_WRITE | SWAP | READ | END_READ | BLIND_SWAP}

	static buffer: SwingingBuffer

	monitored producerDoes: Command
	monitored consumerDoes: Command

definitions:
	// Misuse: swaps whether or not there is a new datum.
	rule r_blindSwap =
		par
			indexRead(buffer) := indexWrite(buffer)
			indexWrite(buffer) := (indexWrite(buffer) + 1) mod dimension(buffer)
		endpar

	rule r_do($command in Command) =
		switch $command
			case WRITE: r_SwingingBuffer_write[buffer]
			case END_WRITE: r_SwingingBuffer_endWrite[buffer]
			case SWAP: r_SwingingBuffer_updateIndexes[buffer]
			case READ: r_SwingingBuffer_read[buffer]
			case END_READ: r_SwingingBuffer_endRead[buffer]
			case BLIND_SWAP: r_blindSwap[]
		endswitch

	invariant inv_disjoint over sb_writingArray, sb_readingArray: sb_disjoint(buffer)
	invariant inv_newest over sb_sequence: sb_newest(buffer)
	invariant inv_accounted over sb_written: sb_accounted(buffer)

	main rule r_Main =
		par
			sb_staged(buffer) := 10 * (sb_written(buffer) + 2)
			r_do[producerDoes]
			r_do[consumerDoes]
		endpar

default init s0:
	function dimension($b in SwingingBuffer) = 4
	function indexWrite($b in SwingingBuffer) = 0
	function indexRead($b in SwingingBuffer) = 3
	function indexUpdated($b in SwingingBuffer) = false
	function sb_pending($b in SwingingBuffer) = false
	function sb_sequence($b in SwingingBuffer, $n in ArrayIndex) = 0
	function sb_staged($b in SwingingBuffer) = 10
	function sb_receivedSequence($b in SwingingBuffer) = 0
	function sb_fresh($b in SwingingBuffer) = false
	function sb_written($b in SwingingBuffer) = 0
	function sb_swaps($b in SwingingBuffer) = 0
	function sb_delivered($b in SwingingBuffer) = 0
	function sb_overwritten($b in SwingingBuffer) = 0
	function sb_unread($b in SwingingBuffer) = 0
	function sb_dropped($b in SwingingBuffer) = 0
