/* The twin of Elevator.asm: the same states, a step of a lift or a push of a button is a d_step. Calls from the floors and
   wishes in the cabins are bits of numbers. */
#define TOP 2
byte floor[2];
bit down[2];
bool moving[2];
bool open[2];
byte calledUp;
byte calledDown;
byte wished[2];

#define HERE(set) ((set >> floor[_pid]) & 1)
#define ABOVE(set) ((set >> floor[_pid]) > 1)
#define BELOW(set) (set & ((1 << floor[_pid]) - 1))
#define ALL (calledUp | calledDown | wished[_pid])
#define ATTRACTED ((!down[_pid] && ABOVE(ALL)) || (down[_pid] && BELOW(ALL)))
#define ATTRACTED_BACK ((down[_pid] && ABOVE(ALL)) || (!down[_pid] && BELOW(ALL)))
#define CALLED_ON (down[_pid] && HERE(calledDown) || !down[_pid] && HERE(calledUp))
#define CALLED_BACK (down[_pid] && HERE(calledUp) || !down[_pid] && HERE(calledDown))
#define STOPS (HERE(wished[_pid]) || CALLED_ON)

active [2] proctype Lift() {
	do
	:: d_step { moving[_pid] && (STOPS || !ATTRACTED) -> moving[_pid] = false }
	:: d_step { moving[_pid] && !(STOPS || !ATTRACTED) -> floor[_pid] = (down[_pid] -> floor[_pid] - 1 : floor[_pid] + 1) }
	:: d_step { !moving[_pid] && open[_pid] -> open[_pid] = false }
	:: d_step { !moving[_pid] && !open[_pid] && STOPS ->
			open[_pid] = true;
			wished[_pid] = wished[_pid] & ~(1 << floor[_pid]);
			if
			:: down[_pid] -> calledDown = calledDown & ~(1 << floor[_pid])
			:: else -> calledUp = calledUp & ~(1 << floor[_pid])
			fi }
	:: d_step { !moving[_pid] && !open[_pid] && !STOPS && ATTRACTED -> moving[_pid] = true }
	:: d_step { !moving[_pid] && !open[_pid] && !STOPS && !ATTRACTED && (ATTRACTED_BACK || CALLED_BACK) ->
			down[_pid] = 1 - down[_pid] }
	od
}

#define PUSH(set, f) :: d_step { !(set & (1 << f)) -> set = set | (1 << f) }

active proctype People() {
	do
	PUSH(calledUp, 0) PUSH(calledUp, 1) PUSH(calledDown, 1) PUSH(calledDown, 2)
	PUSH(wished[0], 0) PUSH(wished[0], 1) PUSH(wished[0], 2)
	PUSH(wished[1], 0) PUSH(wished[1], 1) PUSH(wished[1], 2)
	od
}

active proctype Door() {
	d_step { open[0] && moving[0] || open[1] && moving[1] || (calledUp & (1 << TOP)) || (calledDown & 1) -> assert(false) }
}
