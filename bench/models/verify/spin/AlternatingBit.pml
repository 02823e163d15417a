/* The twin of AlternatingBit.asm: the same states. One process makes all moves, each a d_step. NONE stands for undef. A channel
   that repeats its head takes all messages out and puts them back. */
#define CAPACITY 8
#define NONE 8
byte datum = NONE;
bit bitSent;
byte taken = NONE;
bit expected;
chan messages = [CAPACITY] of { bit, byte };
chan replies = [CAPACITY] of { bit };
hidden byte b;
hidden byte d;
hidden byte n;

#define FETCH(x) :: d_step { datum == NONE -> datum = x }

active proctype Moves() {
	do
	FETCH(0) FETCH(1) FETCH(2) FETCH(3) FETCH(4) FETCH(5) FETCH(6) FETCH(7)
	:: d_step { datum != NONE && nfull(messages) -> messages ! bitSent, datum }
	:: d_step { nempty(messages) -> messages ? b, d;
			if :: b == expected -> taken = d; expected = 1 - expected :: else fi; b = 0; d = 0 }
	:: d_step { nfull(replies) -> replies ! 1 - expected }
	:: d_step { nempty(replies) -> replies ? b;
			if :: datum != NONE && b == bitSent -> datum = NONE; bitSent = 1 - bitSent :: else fi; b = 0 }
	:: d_step { nempty(messages) -> messages ? _, _ }
	:: d_step { nempty(replies) -> replies ? _ }
	:: d_step { nempty(messages) && nfull(messages) -> n = len(messages); messages ? <b, d>; messages ! b, d;
			do :: n > 0 -> messages ? b, d; messages ! b, d; n-- :: else -> break od; b = 0; d = 0 }
	:: d_step { nempty(replies) && nfull(replies) -> n = len(replies); replies ? <b>; replies ! b;
			do :: n > 0 -> replies ? b; replies ! b; n-- :: else -> break od; b = 0 }
	od
}

active proctype Transferred() {
	d_step { bitSent != expected && datum != NONE && taken != datum -> assert(false) }
}
