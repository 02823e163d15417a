/* The twin of GoBackN.asm: the same states. One process makes all moves, each a d_step. */
#define WINDOW 4
#define NUMBERS 5
#define ITEMS 10
#define CAPACITY 5
byte first;
byte sent;
byte expected;
bool right = true;
chan data = [CAPACITY] of { byte, bit };
chan acknowledgements = [CAPACITY] of { byte };
hidden byte number;
hidden byte datum;

active proctype Moves() {
	do
	:: d_step { sent < WINDOW && nfull(data) ->
			data ! ((first + sent) % ITEMS) % NUMBERS, ((first + sent) % ITEMS) % 2; sent++ }
	:: d_step { sent > 0 -> sent = 0 }
	:: d_step { nempty(data) && nfull(acknowledgements) -> data ? number, datum;
			if
			:: number == expected % NUMBERS -> right = (datum == expected % 2); expected = (expected + 1) % ITEMS
			:: else
			fi;
			acknowledgements ! expected % NUMBERS; number = 0; datum = 0 }
	:: d_step { nempty(acknowledgements) -> acknowledgements ? number; number = (number + ITEMS - first) % NUMBERS;
			first = (first + number) % ITEMS; sent = (sent > number -> sent - number : 0); number = 0 }
	:: d_step { nempty(data) -> data ? _, _ }
	:: d_step { nempty(acknowledgements) -> acknowledgements ? _ }
	od
}

active proctype Window() {
	d_step { !right || (expected + ITEMS - first) % ITEMS > WINDOW -> assert(false) }
}
