/* Three tasks who ask for a semaphore, lose patience, and leave, whenever they like: moving one at a time or several at once.
   With one permit it is a lock, with two a pool. */
module LockUsers

import ../std/StandardLibrary
import ../std/CTLLibrary
import ../std/LTLLibrary
import ../patterns/Task
import ../patterns/Semaphore

export *

signature:
	static high: Task
	static middle: Task
	static low: Task
	static gate: Semaphore

	monitored isPool: Boolean
	monitored moves: Task -> Boolean
	monitored wants: Task -> Boolean
	monitored impatient: Task -> Boolean

	// who took part in the last step
	controlled moved: Task -> Boolean
	// who was in line before the last step, and who has been inside for a step
	controlled waited: Task -> Boolean
	controlled lingered: Task -> Boolean

	derived inside: Powerset(Task)

definitions:
	function inside =
		{$t in Task | sem_state(gate, $t) = EXECUTION : $t}

	rule r_use($t in Task) =
		switch sem_state(gate, $t)
			case READY:
				if wants($t) then
					r_sem_wait[gate, $t]
				endif
			case WAITING:
				if impatient($t) then
					r_sem_giveUp[gate, $t]
				else
					r_sem_wait[gate, $t]
				endif
			case EXECUTION:
				// Inside, asking again and giving up mean nothing.
				par
					lingered($t) := not lingered($t)
					if lingered($t) then
						r_sem_post[gate, $t]
					else
						par
							r_sem_wait[gate, $t]
							r_sem_giveUp[gate, $t]
						endpar
					endif
				endpar
		endswitch

	rule r_observe($t in Task) =
		par
			moved($t) := moves($t)
			waited($t) := sem_state(gate, $t) = WAITING
		endpar

	invariant inv_permits over sem_state: size(inside) <= sem_permits(gate) and sem_sound(gate)

	// who has been inside for a step is still inside
	invariant inv_lingers over lingered: (forall $t in Task with lingered($t) implies sem_state(gate, $t) = EXECUTION)
	// the arbiter remembers those in line, each once, and nobody else
	invariant inv_line over semaq:
		(forall $t in Task with contains(semaq(gate), $t) iff waited($t))
		and length(semaq(gate)) = size({$u in Task | waited($u) : $u})

	JUSTICE moved(high)
	JUSTICE moved(middle)
	JUSTICE moved(low)

	CTLSPEC ctlSpec_canEnter: (forall $t in Task with ag(ef(sem_state(gate, $t) = EXECUTION)))
	// who leaves is outside, and does not ask again in the same step
	CTLSPEC ctlSpec_leaves:
		(forall $t in Task with ag(sem_state(gate, $t) = EXECUTION implies ax(sem_state(gate, $t) != WAITING)))
	// nobody starves, not even the least urgent, and no wake-up is lost
	LTLSPEC ltlSpec_served:
		(forall $t in Task with g(sem_state(gate, $t) = WAITING implies f(sem_state(gate, $t) != WAITING)))
	// whoever stands in line for a lock is not passed by one who asks later, however urgent
	LTLSPEC ltlSpec_arrivalOrder:
		g(
			(
				sem_permits(gate) = 1
				and contains(semaq(gate), low)
				and sem_state(gate, low) = WAITING
				and sem_state(gate, high) = READY)
			implies v(
				sem_state(gate, low) != WAITING,
				sem_state(gate, high) != EXECUTION or sem_state(gate, low) != WAITING))
