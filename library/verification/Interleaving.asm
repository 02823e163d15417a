/* Who moves, and what the environment says to those who do, for PairInterleaved and its seeded faults; and what is promised
   of runs in which each of the two tasks moves again and again. */
module Interleaving

import ../std/StandardLibrary
import ../std/CTLLibrary
import ../std/LTLLibrary
import ../patterns/ControlTask
import BufferPair

export *

signature:
	enum domain Moves = {PRODUCER_MOVES | CONSUMER_MOVES | BOTH_MOVE}

	monitored periodEnds: Task -> Boolean
	monitored patienceEnds: Task -> Boolean

	controlled moved: Scheduler -> Boolean

	static isMoving: Prod(Moves, Scheduler) -> Boolean

definitions:
	function isMoving($moves in Moves, $c in Scheduler) =
		switch $moves
			case PRODUCER_MOVES: $c = producer
			case CONSUMER_MOVES: $c = consumer
			otherwise true
		endswitch

	// Patience matters to those who are at the lock only, and the period to the others.
	rule r_setClocks($moves in Moves) =
		forall $c in Scheduler with isMoving($moves, $c) and task_kind(owner($c)) = SYNCHRONOUS do
			if isWaiting($c) then
				task_deadline(owner($c)) := if patienceEnds(owner($c)) then 0 else 1 endif
			else
				if action(nextPhase(scheduler_currentPhase($c))) = WAITING_TRIGGER
					or action(scheduler_currentPhase($c)) = WAITING_TRIGGER then
					task_period(owner($c)) := if periodEnds(owner($c)) then 0 else 1 endif
				endif
			endif

	// Nothing of the environment is kept, nor how long somebody waited.
	rule r_forget($moves in Moves) =
		par
			r_renumber[]
			r_beginStatistics[]
			forall $t in Task with true do
				par
					task_period($t) := 1
					task_deadline($t) := 1
					task_timeInWait($t) := 0
					task_deadlinesMissed($t) := 0
				endpar
			forall $c in Scheduler with true do
				moved($c) := isMoving($moves, $c)
		endpar

	JUSTICE moved(producer)
	JUSTICE moved(consumer)

	// no deadlock: neither is ever cut off from its lock, its cycle, or new data
	CTLSPEC ctlSpec_producerGoesOn: ag(ef(scheduler_currentPhase(producer) = produce_elaborate))
	CTLSPEC ctlSpec_consumerGoesOn: ag(ef(scheduler_currentPhase(consumer) = consume_elaborate))
	CTLSPEC ctlSpec_newDataCanCome: ag(ef(scheduler_currentPhase(consumer) = consume_elaborate and sb_fresh(buffer)))
	// nobody starves and no wake-up is lost: who asks gets in, or has given up
	LTLSPEC ltlSpec_producerServed: g(isWaiting(producer) implies f(not isWaiting(producer)))
	LTLSPEC ltlSpec_consumerServed: g(isWaiting(consumer) implies f(not isWaiting(consumer)))
	// the lock is left again
	LTLSPEC ltlSpec_producerLeaves: g(isInside(producer) implies f(not isInside(producer)))
	LTLSPEC ltlSpec_consumerLeaves: g(isInside(consumer) implies f(not isInside(consumer)))
