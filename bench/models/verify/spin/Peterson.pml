/* The twin of Peterson.asm: the same states, a step of a process is a d_step. */
#define N 4
byte level[N];
byte last[N];
byte critical;

active [N] proctype Process() {
	byte next;
	byte seen;
	do
	:: d_step { next = 1 };
		do
		:: d_step { next < N -> level[_pid] = next };
			d_step { last[next] = _pid; seen = 0 };
			do
			:: d_step { last[next] != _pid || seen == N -> next++ }; break
			:: d_step { seen < N && (seen == _pid || level[seen] < next) -> seen++ }
			od
		:: d_step { next == N -> critical++ };
			d_step { level[_pid] = 0; critical-- };
			break
		od
	od
}

active proctype Exclusion() { d_step { critical > 1 -> assert(false) } }
