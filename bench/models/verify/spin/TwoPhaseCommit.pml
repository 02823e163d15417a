/* The twin of TwoPhaseCommit.asm: the same states; sets are bits of a number. The coordinator's progress is 0 while it works,
   1 when it has committed, 2 when it has aborted. */
#define N 8
#define ALL 255
#define WORKING 0
#define READY 1
#define COMMITTED 2
#define ABORTED 3
byte progress[N];
byte decided;
byte prepared;
byte sent;
bool commit;
bool abort;
/* How many of the managers have committed and aborted follows from `progress`: it makes no states. */
byte committed;
byte aborted;

#define HEARS(m) :: d_step { decided == 0 && (sent & (1 << m)) && !(prepared & (1 << m)) -> prepared = prepared | (1 << m) }

active [N] proctype Manager() {
end:	do
	:: d_step { progress[_pid] == WORKING -> progress[_pid] = READY; sent = sent | (1 << _pid) }
	:: d_step { progress[_pid] == WORKING -> progress[_pid] = ABORTED; aborted++ }
	:: d_step { commit && progress[_pid] != COMMITTED ->
			if :: progress[_pid] == ABORTED -> aborted-- :: else fi; progress[_pid] = COMMITTED; committed++ }
	:: d_step { abort && progress[_pid] != ABORTED ->
			if :: progress[_pid] == COMMITTED -> committed-- :: else fi; progress[_pid] = ABORTED; aborted++ }
	od
}

active proctype Coordinator() {
end:	do
	:: d_step { decided == 0 && prepared == ALL -> decided = 1; commit = true }
	:: d_step { decided == 0 -> decided = 2; abort = true }
	HEARS(0) HEARS(1) HEARS(2) HEARS(3) HEARS(4) HEARS(5) HEARS(6) HEARS(7)
	od
}

active proctype Consistent() { end: d_step { committed > 0 && aborted > 0 -> assert(false) } }
