/* German's cache protocol, as it is given by C.-T. Chou, P. K. Mannava and S. Park, A simple method for parameterized
   verification of cache coherence protocols, FMCAD 2004, without data. Clients ask for a line shared or exclusively;
   the directory serves one at a time, and invalidates the others' copies first. Three channels of one message lead from
   each client (requests), to it (grants and invalidations), and back (acknowledgements); an empty one is undef, and so
   is the client that is served when there is none.
   Seeded fault: r_GrantExclusive does not wait until nobody shares the line. This violates
   inv_exclusive after 8 steps. */
asm German

import ../../../library/std/StandardLibrary

signature:
	abstract domain Client
	enum domain Copy = {INVALID | SHARED | EXCLUSIVE}
	enum domain Request = {REQUEST_SHARED | REQUEST_EXCLUSIVE}
	enum domain Answer = {INVALIDATE | GRANT_SHARED | GRANT_EXCLUSIVE}
	enum domain Action = {
		ASK_SHARED | ASK_EXCLUSIVE | SERVE | INVALIDATE_COPY | ACKNOWLEDGE | HEAR | GIVE_SHARED | GIVE_EXCLUSIVE | TAKE}

	static c1: Client
	static c2: Client
	static c3: Client
	static c4: Client

	controlled copy: Client -> Copy
	controlled request: Client -> Request
	controlled answer: Client -> Answer
	controlled acknowledged: Client -> Boolean
	// the directory
	controlled toInvalidate: Client -> Boolean
	controlled sharer: Client -> Boolean
	controlled owned: Boolean
	controlled served: Client
	controlled serving: Request

definitions:
	rule r_Ask($c in Client, $request in Request) =
		if isUndef(request($c)) and copy($c) != EXCLUSIVE and ($request = REQUEST_EXCLUSIVE or copy($c) = INVALID) then
			request($c) := $request
		endif

	rule r_Serve($c in Client) =
		if isUndef(serving) and isDef(request($c)) then
			par
				served := $c
				serving := request($c)
				request($c) := undef
				forall $other in Client with true do toInvalidate($other) := sharer($other)
			endpar
		endif

	rule r_Invalidate($c in Client) =
		if isUndef(answer($c))
			and toInvalidate($c)
			and (serving = REQUEST_EXCLUSIVE or serving = REQUEST_SHARED and owned) then
			par
				answer($c) := INVALIDATE
				toInvalidate($c) := false
			endpar
		endif

	rule r_Acknowledge($c in Client) =
		if answer($c) = INVALIDATE and not acknowledged($c) then
			par
				answer($c) := undef
				acknowledged($c) := true
				copy($c) := INVALID
			endpar
		endif

	rule r_Hear($c in Client) =
		if acknowledged($c) and isDef(serving) then
			par
				acknowledged($c) := false
				sharer($c) := false
				owned := false
			endpar
		endif

	rule r_Grant($c in Client, $answer in Answer) =
		par
			answer($c) := $answer
			sharer($c) := true
			served := undef
			serving := undef
		endpar

	rule r_GrantShared($c in Client) =
		if served = $c and serving = REQUEST_SHARED and isUndef(answer($c)) and not owned then
			r_Grant[$c, GRANT_SHARED]
		endif

	rule r_GrantExclusive($c in Client) =
		if served = $c
			and serving = REQUEST_EXCLUSIVE
			and isUndef(answer($c))
			and not owned
			and (forall $other in Client with not sharer($other)) then
			par
				r_Grant[$c, GRANT_EXCLUSIVE]
				owned := true
			endpar
		endif

	rule r_Take($c in Client) =
		switch answer($c)
			case GRANT_SHARED:
				par
					answer($c) := undef
					copy($c) := SHARED
				endpar
			case GRANT_EXCLUSIVE:
				par
					answer($c) := undef
					copy($c) := EXCLUSIVE
				endpar
		endswitch

	invariant inv_exclusive over copy:
		(forall $a in Client, $b in Client with $a != $b and copy($a) = EXCLUSIVE implies copy($b) = INVALID)

	main rule r_Main =
		choose $action in Action, $c in Client with true do
			switch $action
				case ASK_SHARED: r_Ask[$c, REQUEST_SHARED]
				case ASK_EXCLUSIVE: r_Ask[$c, REQUEST_EXCLUSIVE]
				case SERVE: r_Serve[$c]
				case INVALIDATE_COPY: r_Invalidate[$c]
				case ACKNOWLEDGE: r_Acknowledge[$c]
				case HEAR: r_Hear[$c]
				case GIVE_SHARED: r_GrantShared[$c]
				case GIVE_EXCLUSIVE: r_GrantExclusive[$c]
				case TAKE: r_Take[$c]
			endswitch

default init s0:
	function copy($c in Client) = INVALID
	function acknowledged($c in Client) = false
	function toInvalidate($c in Client) = false
	function sharer($c in Client) = false
	function owned = false
