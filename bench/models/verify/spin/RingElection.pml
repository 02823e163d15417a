/* The twin of RingElection.asm: the same states, a step of a process is a d_step. */
#define N 11
#define CAPACITY 11
#define ASLEEP 0
#define CANDIDATE 1
#define LOST 2
#define ELECTED 3
byte place[N];
byte number[N] = { 3, 0, 6, 1, 9, 4, 10, 7, 2, 8, 5 };
chan queue[N] = [CAPACITY] of { byte };
hidden byte n;

#define FOLLOWING ((_pid + 1) % N)

active [N] proctype Process() {
end:	do
	:: d_step { place[_pid] == ASLEEP -> place[_pid] = CANDIDATE; queue[FOLLOWING] ! number[_pid] }
	:: d_step { nempty(queue[_pid]) -> queue[_pid] ? n;
			if
			:: n == number[_pid] -> place[_pid] = ELECTED; assert(n == N - 1)
			:: n > number[_pid] -> place[_pid] = LOST; queue[FOLLOWING] ! n
			:: n < number[_pid] && place[_pid] == ASLEEP -> place[_pid] = CANDIDATE; queue[FOLLOWING] ! number[_pid]
			:: else
			fi;
			n = 0 }
	od
}
