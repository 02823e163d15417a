/* The twin of German.asm: the same states; 0 stands for undef, and clients have numbers from 1. */
#define N 4
#define INVALID 0
#define SHARED 1
#define EXCLUSIVE 2
#define INVALIDATE 3
byte copy[N];
byte request[N];
byte answer[N];
bool acknowledged[N];
bool toInvalidate[N];
bool sharer[N];
bool owned;
byte served;
byte serving;

#define DIRECTORY(c) \
	:: d_step { serving == 0 && request[c] != 0 -> served = c + 1; serving = request[c]; request[c] = 0; \
		toInvalidate[0] = sharer[0]; toInvalidate[1] = sharer[1]; toInvalidate[2] = sharer[2]; toInvalidate[3] = sharer[3] } \
	:: d_step { answer[c] == 0 && toInvalidate[c] && (serving == EXCLUSIVE || serving == SHARED && owned) -> \
		answer[c] = INVALIDATE; toInvalidate[c] = false } \
	:: d_step { acknowledged[c] && serving != 0 -> acknowledged[c] = false; sharer[c] = false; owned = false } \
	:: d_step { served == c + 1 && serving == SHARED && answer[c] == 0 && !owned -> \
		answer[c] = SHARED; sharer[c] = true; served = 0; serving = 0 } \
	:: d_step { served == c + 1 && serving == EXCLUSIVE && answer[c] == 0 && !owned && \
			!sharer[0] && !sharer[1] && !sharer[2] && !sharer[3] -> \
		answer[c] = EXCLUSIVE; sharer[c] = true; owned = true; served = 0; serving = 0 }

active [N] proctype Client() {
	do
	:: d_step { request[_pid] == 0 && copy[_pid] == INVALID -> request[_pid] = SHARED }
	:: d_step { request[_pid] == 0 && copy[_pid] != EXCLUSIVE -> request[_pid] = EXCLUSIVE }
	:: d_step { answer[_pid] == INVALIDATE && !acknowledged[_pid] ->
			answer[_pid] = 0; acknowledged[_pid] = true; copy[_pid] = INVALID }
	:: d_step { answer[_pid] == SHARED -> answer[_pid] = 0; copy[_pid] = SHARED }
	:: d_step { answer[_pid] == EXCLUSIVE -> answer[_pid] = 0; copy[_pid] = EXCLUSIVE }
	od
}

active proctype Directory() {
	do
	DIRECTORY(0) DIRECTORY(1) DIRECTORY(2) DIRECTORY(3)
	od
}

#define ALONE(a, b, c, d) (copy[a] == EXCLUSIVE && (copy[b] != INVALID || copy[c] != INVALID || copy[d] != INVALID))

active proctype Exclusive() {
	d_step { ALONE(0, 1, 2, 3) || ALONE(1, 0, 2, 3) || ALONE(2, 0, 1, 3) || ALONE(3, 0, 1, 2) -> assert(false) }
}
