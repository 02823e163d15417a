/* The twin of ReadersWriters.asm: the same states, a step of a process is a d_step. */
#define READERS 6
#define WRITERS 3
bool countReaders = true;
bool countWriters = true;
bool queue = true;
bool reading = true;
bool writing = true;
byte readers;
byte writers;
/* How many are inside follows from where the processes are: it makes no states. */
byte readersInside;
byte writersInside;

#define P(s) s -> s = false
#define V(s) s = true

active [READERS] proctype Reader() {
	do
	:: d_step { P(queue) };
		d_step { P(reading) };
		d_step { P(countReaders) };
		if
		:: d_step { readers == 0 -> readers++ };
			d_step { P(writing) }
		:: d_step { readers > 0 -> readers++ }
		fi;
		d_step { V(countReaders) };
		d_step { V(reading) };
		d_step { V(queue); readersInside++ };
		d_step { P(countReaders); readersInside-- };
		if
		:: d_step { readers == 1 -> readers-- };
			d_step { V(writing) }
		:: d_step { readers > 1 -> readers-- }
		fi;
		d_step { V(countReaders) }
	od
}

active [WRITERS] proctype Writer() {
	do
	:: d_step { P(countWriters) };
		if
		:: d_step { writers == 0 -> writers++ };
			d_step { P(reading) }
		:: d_step { writers > 0 -> writers++ }
		fi;
		d_step { V(countWriters) };
		d_step { P(writing); writersInside++ };
		d_step { V(writing); writersInside-- };
		d_step { P(countWriters) };
		if
		:: d_step { writers == 1 -> writers-- };
			d_step { V(reading) }
		:: d_step { writers > 1 -> writers-- }
		fi;
		d_step { V(countWriters) }
	od
}

active proctype Exclusion() {
	d_step { writersInside > 1 || (writersInside > 0 && readersInside > 0) -> assert(false) }
}
