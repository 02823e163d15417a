/* The semaphore of the C++ runtime (cpp/include/groundstate/semaphore.hpp) with one permit and three users, who ask, wait,
   give up, and release in any order.

   A step is one thing that a processor does indivisibly: an atomic operation on the word that holds permits and line, or
   on the count of a user's calls; and the system's "sleep while the count is the one seen", which compares and falls asleep
   at once. What has to be shown is that the permit is neither lost nor doubled when a user gives up at the moment of the
   grant, and that nobody sleeps who has been granted it.

   With `countsFirst` false a user looks at the line before he takes the count: the fault that the invariants find. */
asm PermitLine

import ../std/StandardLibrary

export *

signature:
	enum domain User = {ANNA | BERT | CARL}
	enum domain Place = {OUTSIDE | COUNTING | LOOKING | DOZING | ASLEEP | LEAVING | INSIDE | CALLING | WAKING}
	domain Count subsetof Integer

	// Configuration
	controlled countsFirst: Boolean

	// The one word
	controlled permits: Integer
	controlled line: Seq(User)

	// What a user sleeps on, and what he saw of it; undef when it does not matter
	controlled calls: User -> Count
	controlled seen: User -> Count

	controlled place: User -> Place
	// whom a user that released has to call; undef when he has called him
	controlled called: User -> User

	derived inLine: User -> Boolean
	derived holds: User -> Boolean
	derived isCalled: User -> Boolean

definitions:
	// Two calls may come between the look at the count and the sleep, so this is the least; the program's has 32 bits.
	domain Count = {0 : 2}

	function inLine($u in User) =
		contains(line, $u)

	// He is inside, or was granted the permit and does not know it yet.
	function holds($u in User) =
		place($u) = INSIDE or (contains({COUNTING, LOOKING, DOZING, ASLEEP, LEAVING}, place($u)) and not inLine($u))

	function isCalled($u in User) =
		(exists $v in User with (place($v) = CALLING or place($v) = WAKING) and called($v) = $u)

	rule r_ask($u in User) =
		if permits > 0 then
			par
				permits := permits - 1
				place($u) := INSIDE
			endpar
		else
			par
				line := append(line, $u)
				if countsFirst then
					place($u) := COUNTING
				else
					place($u) := LOOKING
				endif
			endpar
		endif

	rule r_count($u in User) =
		par
			seen($u) := calls($u)
			if countsFirst then
				place($u) := LOOKING
			else
				place($u) := DOZING
			endif
		endpar

	// Still in line: his watchdog may have ended, or he is going to sleep.
	rule r_look($u in User) =
		if not inLine($u) then
			par
				place($u) := INSIDE
				seen($u) := undef
			endpar
		else
			choose $late in Boolean with true do
				if $late then
					par
						place($u) := LEAVING
						seen($u) := undef
					endpar
				else
					if countsFirst then
						place($u) := DOZING
					else
						place($u) := COUNTING
					endif
				endif
		endif

	rule r_doze($u in User) =
		par
			seen($u) := undef
			if calls($u) = seen($u) then
				place($u) := ASLEEP
			else
				if countsFirst then
					place($u) := COUNTING
				else
					place($u) := LOOKING
				endif
			endif
		endpar

	// Too late to give up if the permit has been handed over.
	rule r_leave($u in User) =
		if inLine($u) then
			par
				line := excluding(line, $u)
				place($u) := OUTSIDE
			endpar
		else
			place($u) := INSIDE
		endif

	rule r_release($u in User) =
		if isEmpty(line) then
			par
				permits := permits + 1
				place($u) := OUTSIDE
			endpar
		else
			par
				called($u) := first(line)
				line := tail(line)
				place($u) := CALLING
			endpar
		endif

	rule r_call($u in User) =
		par
			calls(called($u)) := (calls(called($u)) + 1) mod 3
			place($u) := WAKING
		endpar

	rule r_wake($u in User) =
		par
			if place(called($u)) = ASLEEP then
				place(called($u)) := COUNTING
			endif
			called($u) := undef
			place($u) := OUTSIDE
		endpar

	invariant inv_onePermit over permits, line, place: permits + size({$u in User | holds($u) : $u}) = 1
	invariant inv_lineOnlyWhenTaken over permits, line: permits > 0 implies isEmpty(line)
	// no lost wake-up: who sleeps on a permit that is his is about to be called
	invariant inv_noLostWakeUp over place, line:
		(forall $u in User with (place($u) = ASLEEP and not inLine($u)) implies isCalled($u))

	main rule r_Main =
		choose $user in User with place($user) != ASLEEP do
			switch place($user)
				case OUTSIDE: r_ask[$user]
				case COUNTING: r_count[$user]
				case LOOKING: r_look[$user]
				case DOZING: r_doze[$user]
				case LEAVING: r_leave[$user]
				case INSIDE: r_release[$user]
				case CALLING: r_call[$user]
				case WAKING: r_wake[$user]
			endswitch

default init s0:
	function countsFirst = true
	function permits = 1
	function line = []
	function calls($u in User) = 0
	function place($u in User) = OUTSIDE
