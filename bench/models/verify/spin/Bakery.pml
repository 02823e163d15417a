/* The twin of Bakery.asm: the same states, a step of a process is a d_step. */
#define N 3
#define TICKETS 8
bool choosing[N];
byte ticket[N];
byte critical;

active [N] proctype Process() {
	byte seen;
	byte greatest;
	do
	:: d_step { choosing[_pid] = true };
		do
		:: d_step { seen < N -> greatest = (greatest < ticket[seen] -> ticket[seen] : greatest); seen++ }
		:: d_step { seen == N && greatest == TICKETS -> greatest = 0; seen = 0 }
		:: d_step { seen == N && greatest < TICKETS -> ticket[_pid] = greatest + 1; greatest = 0; seen = 0 };
			d_step { choosing[_pid] = false };
			break
		od;
		do
		:: d_step { seen == N -> seen = 0; critical++ };
			d_step { ticket[_pid] = 0; critical-- };
			break
		:: d_step { seen < N && !choosing[seen] };
			d_step {
				ticket[seen] == 0 || ticket[_pid] < ticket[seen] || (ticket[_pid] == ticket[seen] && _pid <= seen) ->
				seen++
			}
		od
	od
}

active proctype Exclusion() { d_step { critical > 1 -> assert(false) } }
