/* The twin of Szymanski.asm: the same states, a step of a process is a d_step. */
#define N 4
byte flag[N];
byte critical;

active [N] proctype Process() {
	byte seen;
	do
	:: d_step { flag[_pid] = 1; seen = 0 };
		do
		:: d_step { seen < N && flag[seen] < 3 -> seen++ }
		:: d_step { seen == N -> flag[_pid] = 3; seen = 0 }; break
		od;
		do
		:: d_step { seen < N && flag[seen] != 1 -> seen++ }
		:: d_step { seen == N -> flag[_pid] = 4; seen = 0 }; break
		:: d_step { seen < N && flag[seen] == 1 -> seen = 0 };
			d_step { flag[_pid] = 2; seen = 0 };
			do
			:: d_step { seen < N -> seen = (flag[seen] == 4 -> N : (seen + 1) % N) }
			:: d_step { seen == N -> flag[_pid] = 4; seen = 0 }; break
			od;
			break
		od;
		do
		:: d_step { seen < _pid && flag[seen] < 2 -> seen++ }
		:: d_step { seen == _pid -> seen = 0; critical++ };
			d_step { seen = _pid + 1; critical-- };
			break
		od;
		do
		:: d_step { seen < N && (flag[seen] < 2 || flag[seen] > 3) -> seen++ }
		:: d_step { seen == N -> flag[_pid] = 0; seen = 0 }; break
		od
	od
}

active proctype Exclusion() { d_step { critical > 1 -> assert(false) } }
