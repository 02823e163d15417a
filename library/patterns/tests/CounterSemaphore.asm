/* Misuse: a semaphore as a counter that each task tests and decrements by itself. Two tasks that step
   at once both see one permit and both write zero: equal updates, no clash, and both are inside. */
asm CounterSemaphore

import ../../std/StandardLibrary

signature:
	abstract domain Task
	static first_task: Task
	static second_task: Task

	controlled permits: Integer
	controlled inSection: Task -> Boolean
	monitored wants: Task -> Boolean

definitions:
	rule r_testAndTake($t in Task) =
		if wants($t) and not inSection($t) and permits > 0 then
			par
				permits := permits - 1
				inSection($t) := true
			endpar
		endif

	invariant inv_mutualExclusion over inSection: not (inSection(first_task) and inSection(second_task))

	main rule r_Main =
		forall $t in Task with true do r_testAndTake[$t]

default init s0:
	function permits = 1
	function inSection($t in Task) = false
