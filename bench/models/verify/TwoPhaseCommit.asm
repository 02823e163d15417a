/* Two-phase commit: J. Gray and L. Lamport, Consensus on transaction commit, ACM Transactions on Database Systems 31,
   2006. Managers of resources prepare or abort on their own; the coordinator commits when all have prepared, or aborts.
   Messages are a set of what was ever sent, each with its sender, so they may be late and come again. For 8 managers
   TLC and Stateright find 1 745 408 states.
   Seeded fault: r_Commit asks for one prepared manager (`exists`). It violates inv_consistent after 5 steps. */
asm TwoPhaseCommit

import ../../../library/std/StandardLibrary

signature:
	// 0 is the coordinator
	domain Process subsetof Integer
	domain Manager subsetof Integer
	enum domain Kind = {PREPARED | COMMIT | ABORT}
	enum domain Progress = {WORKING | READY | COMMITTED | ABORTED}
	enum domain Action = {COMMITS | ABORTS | HEARS | PREPARES | GIVES_UP | OBEYS_COMMIT | OBEYS_ABORT}

	controlled progress: Process -> Progress
	controlled prepared: Powerset(Manager)
	controlled messages: Powerset(Prod(Kind, Process))

definitions:
	domain Process = {0 : 8}
	domain Manager = {1 : 8}

	rule r_Send($kind in Kind, $from in Process) =
		messages := including(messages, ($kind, $from))

	rule r_Commit =
		if progress(0) = WORKING and (forall $m in Manager with contains(prepared, $m)) then
			par
				progress(0) := COMMITTED
				r_Send[COMMIT, 0]
			endpar
		endif

	rule r_Abort =
		if progress(0) = WORKING then
			par
				progress(0) := ABORTED
				r_Send[ABORT, 0]
			endpar
		endif

	rule r_Hear($m in Manager) =
		if progress(0) = WORKING and contains(messages, (PREPARED, $m)) then
			prepared := including(prepared, $m)
		endif

	rule r_Prepare($m in Manager) =
		if progress($m) = WORKING then
			par
				progress($m) := READY
				r_Send[PREPARED, $m]
			endpar
		endif

	rule r_GiveUp($m in Manager) =
		if progress($m) = WORKING then
			progress($m) := ABORTED
		endif

	rule r_Obey($m in Manager, $kind in Kind, $progress in Progress) =
		if contains(messages, ($kind, 0)) then
			progress($m) := $progress
		endif

	invariant inv_consistent over progress:
		(forall $a in Manager, $b in Manager with not (progress($a) = COMMITTED and progress($b) = ABORTED))

	main rule r_Main =
		choose $action in Action with true do
			switch $action
				case COMMITS: r_Commit[]
				case ABORTS: r_Abort[]
				otherwise
					choose $m in Manager with true do
						switch $action
							case HEARS: r_Hear[$m]
							case PREPARES: r_Prepare[$m]
							case GIVES_UP: r_GiveUp[$m]
							case OBEYS_COMMIT: r_Obey[$m, COMMIT, COMMITTED]
							case OBEYS_ABORT: r_Obey[$m, ABORT, ABORTED]
						endswitch
			endswitch

default init s0:
	function progress($p in Process) = WORKING
	function prepared = {}
	function messages = {}
