/* How often a reader gets something new. It stands beside the machines of ControlTask and changes nothing of theirs: an
   application runs `r_beforeReadings` before each step and `r_countReadings` after it, in sequence.

   A reading brings something new if the datum that it takes was not taken before. The time that counts goes from one such
   reading to the next, and is watched while it runs, so a reader that never gets anything again is found. It does not run
   before the first one. */
module FreshReadings

import ../std/StandardLibrary
import SwingingBuffer
import MessageQueue
import SharedValue

export *

signature:
	abstract domain FreshReading

	// Configuration: what is read, one of them, and the longest time until something new comes
	controlled reading_buffer: FreshReading -> SwingingBuffer
	controlled reading_queue: FreshReading -> MessageQueue
	controlled reading_value: FreshReading -> SharedValue
	controlled reading_limit: FreshReading -> Integer

	// ticks since something new came; undef before the first
	controlled reading_since: FreshReading -> Integer

	// As it was before the step; undef between two steps
	controlled reading_before: FreshReading -> Integer

	// What came of it: the longest time, and how often it was too long
	controlled reading_longest: FreshReading -> Integer
	controlled reading_starved: FreshReading -> Integer

	derived reading_number: FreshReading -> Integer
	derived isNewRead: FreshReading -> Boolean

definitions:
	function reading_number($r in FreshReading) =
		if isDef(reading_buffer($r)) then
			sb_receivedSequence(reading_buffer($r))
		else
			if isDef(reading_queue($r)) then
				mq_taken(reading_queue($r))
			else
				sv_receivedSequence(reading_value($r))
			endif
		endif

	function isNewRead($r in FreshReading) =
		reading_number($r) != reading_before($r)

	rule r_beforeReadings =
		forall $r in FreshReading with true do
			reading_before($r) := reading_number($r)

	// Too long is counted once, when it becomes so.
	rule r_wait($r in FreshReading) =
		let ($since = reading_since($r) + 1) in
			par
				reading_longest($r) := max(reading_longest($r), $since)
				if $since = reading_limit($r) + 1 then
					reading_starved($r) := reading_starved($r) + 1
				endif
				reading_since($r) := if isNewRead($r) then 0 else $since endif
			endpar
		endlet

	// What a step of the tasks adds.
	rule r_countReadings =
		forall $r in FreshReading with true do
			par
				if isDef(reading_since($r)) then
					r_wait[$r]
				else
					if isNewRead($r) then reading_since($r) := 0 endif
				endif
				reading_before($r) := undef
			endpar
