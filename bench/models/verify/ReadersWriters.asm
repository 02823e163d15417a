/* Readers and writers, with priority for writers: P. J. Courtois, F. Heymans and D. L. Parnas, Concurrent control with
   "readers" and "writers", Communications of the ACM 14, 1971, problem 2. Places are the lines of their program,
   counted from 0. A step is one move of one process: an operation on a semaphore or on a counter.
   Seeded fault: the first reader does not wait for WRITING (line 3 goes on to line 5). It violates inv_exclusion after
   12 steps. */
asm ReadersWriters

import ../../../library/std/StandardLibrary

signature:
	domain Reader subsetof Integer
	domain Writer subsetof Integer
	domain Line subsetof Integer
	domain Readers subsetof Integer
	domain Writers subsetof Integer
	// their mutex 1, mutex 2, mutex 3, r and w
	enum domain Semaphore = {COUNT_READERS | COUNT_WRITERS | QUEUE | READING | WRITING}
	enum domain Kind = {READER | WRITER}

	controlled reader: Reader -> Line
	controlled writer: Writer -> Line
	controlled free: Semaphore -> Boolean
	controlled readers: Readers
	controlled writers: Writers

definitions:
	domain Reader = {1 : 6}
	domain Writer = {1 : 3}
	domain Line = {0 : 11}
	domain Readers = {0 : 6}
	domain Writers = {0 : 3}

	rule r_Wait($line in Line, $s in Semaphore) =
		if free($s) then
			par
				free($s) := false
				$line := $line + 1
			endpar
		endif

	rule r_Signal($line in Line, $s in Semaphore, $next in Line) =
		par
			free($s) := true
			$line := $next
		endpar

	rule r_Read($r in Reader) =
		switch reader($r)
			case 0: r_Wait[reader($r), QUEUE]
			case 1: r_Wait[reader($r), READING]
			case 2: r_Wait[reader($r), COUNT_READERS]
			case 3:
				par
					readers := readers + 1
					reader($r) := if readers = 0 then 4 else 5 endif
				endpar
			case 4: r_Wait[reader($r), WRITING]
			case 5: r_Signal[reader($r), COUNT_READERS, 6]
			case 6: r_Signal[reader($r), READING, 7]
			case 7: r_Signal[reader($r), QUEUE, 8]
			// reads, until it has this semaphore
			case 8: r_Wait[reader($r), COUNT_READERS]
			case 9:
				par
					readers := readers - 1
					reader($r) := if readers = 1 then 10 else 11 endif
				endpar
			case 10: r_Signal[reader($r), WRITING, 11]
			case 11: r_Signal[reader($r), COUNT_READERS, 0]
		endswitch

	rule r_Write($w in Writer) =
		switch writer($w)
			case 0: r_Wait[writer($w), COUNT_WRITERS]
			case 1:
				par
					writers := writers + 1
					writer($w) := if writers = 0 then 2 else 3 endif
				endpar
			case 2: r_Wait[writer($w), READING]
			case 3: r_Signal[writer($w), COUNT_WRITERS, 4]
			case 4: r_Wait[writer($w), WRITING]
			// writes
			case 5: r_Signal[writer($w), WRITING, 6]
			case 6: r_Wait[writer($w), COUNT_WRITERS]
			case 7:
				par
					writers := writers - 1
					writer($w) := if writers = 1 then 8 else 9 endif
				endpar
			case 8: r_Signal[writer($w), READING, 9]
			case 9: r_Signal[writer($w), COUNT_WRITERS, 0]
		endswitch

	invariant inv_oneWriter over writer:
		(forall $v in Writer, $w in Writer with $v < $w implies not (writer($v) = 5 and writer($w) = 5))
	invariant inv_exclusion over reader, writer:
		(forall $r in Reader, $w in Writer with not (reader($r) = 8 and writer($w) = 5))

	main rule r_Main =
		choose $kind in Kind with true do
			switch $kind
				case READER:
					choose $r in Reader with true do r_Read[$r]
				case WRITER:
					choose $w in Writer with true do r_Write[$w]
			endswitch

default init s0:
	function reader($r in Reader) = 0
	function writer($w in Writer) = 0
	function free($s in Semaphore) = true
	function readers = 0
	function writers = 0
