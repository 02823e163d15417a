/* The semaphore as a lock and as a pool of two permits; in each step any of three tasks move, together. */
asm Lock

import ../std/StandardLibrary
import ../std/CTLLibrary
import ../std/LTLLibrary
import ../patterns/Task
import ../patterns/Semaphore
import LockUsers

signature:

definitions:
	main rule r_Main =
		par
			forall $t in Task with moves($t) do r_use[$t]
			forall $u in Task with true do r_observe[$u]
			r_sem_arbitrate[gate]
		endpar

default init s0:
	function sem_permits($s in Semaphore) = if isPool then 2 else 1 endif
	function sem_users($s in Semaphore) = [high, middle, low]
	function sem_state($s in Semaphore, $t in Task) = READY
	function sem_illegalPost($s in Semaphore) = false
	function semaq($s in Semaphore) = []
	function moved($t in Task) = false
	function waited($t in Task) = false
	function lingered($t in Task) = false
