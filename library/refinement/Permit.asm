/* A semaphore with one permit and three users, as its callers see it: who asks is let in or waits, who waits gives up or is let in by
   the one who leaves. A step is one call, or the end of one.

   library/runtime/PermitLine refines it: there the same happens in atomic operations. */
asm Permit

import ../std/StandardLibrary

signature:
	enum domain User = {ANNA | BERT | CARL}
	enum domain Stand = {OUT | WAITING | IN}

	controlled stand: User -> Stand

	derived isFree: Boolean

definitions:
	function isFree =
		(forall $u in User with stand($u) != IN)

	rule r_ask($u in User) =
		if isFree then
			stand($u) := IN
		else
			stand($u) := WAITING
		endif

	// He hands the permit to somebody who waits. Who that is the caller cannot know.
	rule r_leave($u in User) =
		par
			stand($u) := OUT
			choose $next in User with stand($next) = WAITING do
				stand($next) := IN
		endpar

	invariant inv_onePermit over stand:
		(forall $u in User, $v in User with (stand($u) = IN and stand($v) = IN) implies $u = $v)

	main rule r_Main =
		choose $user in User with true do
			switch stand($user)
				case OUT: r_ask[$user]
				case WAITING: stand($user) := OUT
				case IN: r_leave[$user]
			endswitch

default init s0:
	function stand($u in User) = OUT
