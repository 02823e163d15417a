/* How often a reader gets something new, as ../patterns/FreshReadings counts it, against the ticks counted here. What is read, a buffer, a
   queue or a value, and the longest time are asked for in the initial state; in each step something new comes or not. */
asm Fresh

import ../std/StandardLibrary
import ../std/CTLLibrary
import ../patterns/SwingingBuffer
import ../patterns/MessageQueue
import ../patterns/SharedValue
import ../patterns/FreshReadings

signature:
	enum domain Channel = {BUFFER | QUEUE | VALUE}
	domain Limit subsetof Integer

	static reading: FreshReading
	static buffer: SwingingBuffer
	static queue: MessageQueue
	static cell: SharedValue

	// asked for in the initial state
	monitored channel: Channel
	monitored limit: Limit

	monitored comes: Boolean

	// the last step brought something new; before it, ticks since something new came, undef before the first
	controlled came: Boolean
	controlled waited: Integer
	controlled since: Integer

definitions:
	domain Limit = {1 : 2}

	// Only by whether they are equal do the numbers of what is read matter; all channels that are not read move, too.
	rule r_read =
		par
			came := comes
			waited := since
			if comes then
				since := 0
			else
				if isDef(since) then
					since := since + 1
				endif
			endif
			if comes = isDef(reading_buffer(reading)) then
				sb_receivedSequence(buffer) := 1 - sb_receivedSequence(buffer)
			endif
			if comes = isDef(reading_queue(reading)) then
				mq_taken(queue) := 1 - mq_taken(queue)
			endif
			if comes = isDef(reading_value(reading)) then
				sv_receivedSequence(cell) := 1 - sv_receivedSequence(cell)
			endif
		endpar

	// Each begins with another number, so that none is taken for another.
	rule r_beginStatistics =
		par
			reading_longest(reading) := 1
			reading_starved(reading) := 10
		endpar

	// Far too long is like too long.
	rule r_stopWaiting =
		if isDef(since) then
			if since > 4 then
				par
					since := 4
					reading_since(reading) := reading_since(reading) - 1
				endpar
			endif
		endif

	invariant inv_since over reading_since: reading_since(reading) = since
	// the wait is watched while it lasts
	invariant inv_longest over reading_longest:
		reading_longest(reading) = (if isDef(waited) then max(waited + 1, 1) else 1 endif)
	// too long is counted once, when it becomes so
	invariant inv_starved over reading_starved:
		reading_starved(reading)
		= (if isDef(waited) then (if waited = reading_limit(reading) then 11 else 10 endif) else 10 endif)
	invariant inv_betweenSteps over reading_before: isUndef(reading_before(reading))

	CTLSPEC ctlSpec_starves: ef(reading_starved(reading) = 11)
	CTLSPEC ctlSpec_news: ag(ef(came))

	main rule r_Main =
		seq
			r_beginStatistics[]
			r_beforeReadings[]
			r_read[]
			r_countReadings[]
			r_stopWaiting[]
		endseq

default init s0:
	function reading_buffer($r in FreshReading) = if channel = BUFFER then buffer else undef endif
	function reading_queue($r in FreshReading) = if channel = QUEUE then queue else undef endif
	function reading_value($r in FreshReading) = if channel = VALUE then cell else undef endif
	function reading_limit($r in FreshReading) = limit
	function reading_longest($r in FreshReading) = 1
	function reading_starved($r in FreshReading) = 10
	function sb_receivedSequence($b in SwingingBuffer) = 0
	function mq_taken($q in MessageQueue) = 0
	function sv_receivedSequence($v in SharedValue) = 0
	function came = false
