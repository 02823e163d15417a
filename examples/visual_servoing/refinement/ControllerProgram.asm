/* The program that is generated from the complete controller's chart, as a whole: three of its threads, the camera's, visual servoing's and
   the robot controller's, with the channels between them.

   A step is one thing that another thread may see: a word of an array that is written or read, a member of a buffer, a call of a lock, a
   look at the signal that wakes visual servoing. The lock itself is taken, slept for and handed over at once: how it does that in atomic
   operations is library/runtime/SwingSteps.asm. Which thread moves next is chosen freely, so what holds here holds for all speeds, all
   periods and all lengths of elaborations. The order of a thread's steps is that of `camera_cycle`, `visual_servoing_cycle` and `robot_cycle`
   in the generated header, and of `read`, `write` and `hand_over` in cpp/include/groundstate/locked_buffer.hpp.

   What the other three threads do is left out: nobody else comes to the arrays of the encoders and of the motors while the robot controller
   is at them. The camera and the robot controller may give up waiting for a lock; visual servoing does not, since it is given far longer
   than anybody holds one. Of a datum only counts which one it is: the newest that was handed over, one that is being written, or an old
   one. The arrays of a buffer are told apart by the way round the ring, from the one that is written.

   `seeded` is a fault that the refinement, or an invariant, finds. */
asm ControllerProgram

import ../../../library/std/StandardLibrary
import ../../../library/std/CTLLibrary

export *

signature:
	enum domain Thread = {CAMERA | SERVOING | ROBOT}
	enum domain Channel = {IMAGE | MOTION | SET_POINT | ENCODERS | MOTORS}
	enum domain Place = {
		RESTING | CHECKING | DOZING | ELABORATING | ACQUIRING | ASLEEP | INSIDE | COPYING | MARKING | RELEASING |
		TAKING | RAISING}
	enum domain Datum = {OLD | FRESH | NEWEST}
	enum domain Fault = {
		NONE | SLAVE_WITHOUT_LOCK | RELEASED_EARLY | OTHER_ARRAY | KEPT_PENDING | UNFINISHED | RAISED_FIRST}
	domain Position subsetof Integer
	domain Word subsetof Integer

	// What a task is to a lock, and to a buffer, in the words of the pattern library
	enum domain TaskCSState = {READY | WAITING | EXECUTION}
	enum domain PatternState = {WRITING | READING | MANAGING_SB}

	// Configuration
	controlled seeded: Fault
	static dimension: Channel -> Integer
	static last: Channel -> Position
	static isMaster: Prod(Thread, Channel) -> Boolean
	static isWriter: Prod(Thread, Channel) -> Boolean
	static partner: Prod(Thread, Channel) -> Thread
	// the channels whose arrays an elaboration uses where they are
	static readInPlace: Thread -> Powerset(Channel)
	static writtenInPlace: Thread -> Channel
	// what comes after a lock in a thread's cycle: where it goes on, and at which channel
	static afterLock: Prod(Thread, Channel) -> Place
	static following: Prod(Thread, Channel) -> Channel

	// The program's: the locks, the buffers' members, the arrays, the signal
	controlled holder: Channel -> Thread
	controlled pending: Channel -> Boolean
	controlled content: Prod(Channel, Position, Word) -> Datum
	// the number that was offered to visual servoing is that of the datum that is pending, not of the one in the array that is read
	controlled offersPending: Boolean
	// the signal was raised since its count was taken
	controlled raised: Boolean

	// A thread's: how far it is, at which channel, at which word
	controlled place: Thread -> Place
	controlled at: Thread -> Channel
	controlled word: Thread -> Word
	// the datum in the array that is read has been read before, and what the last reading said of that
	controlled isRead: Channel -> Boolean
	controlled fresh: Channel -> Boolean
	// a word that was read was not of the newest datum handed over
	controlled torn: Thread -> Boolean

	derived available: Boolean
	derived canMove: Thread -> Boolean
	derived withoutLock: Prod(Thread, Channel) -> Boolean

	// What it comes to in the model of the controller
	derived lock: Prod(Thread, Channel) -> TaskCSState
	derived access: Prod(Thread, Channel) -> PatternState
	derived isPending: Channel -> Boolean

definitions:
	domain Position = {0 : 2}
	domain Word = {0 : 1}

	function dimension($c in Channel) =
		if $c = SET_POINT then 3 else 2 endif

	// The array that is read is the one before the one that is written.
	function last($c in Channel) =
		dimension($c) - 1

	// The asynchronous thread, or the slower one.
	function isMaster($t in Thread, $c in Channel) =
		$t = SERVOING or $c = ENCODERS or $c = MOTORS

	function isWriter($t in Thread, $c in Channel) =
		switch $t
			case CAMERA: true
			case SERVOING: $c = SET_POINT
			otherwise $c = MOTION or $c = MOTORS
		endswitch

	function partner($t in Thread, $c in Channel) =
		if $t = SERVOING then
			if $c = IMAGE then CAMERA else ROBOT endif
		else
			SERVOING
		endif

	function readInPlace($t in Thread) =
		switch $t
			case SERVOING: {IMAGE, MOTION}
			otherwise {ENCODERS}
		endswitch

	function writtenInPlace($t in Thread) =
		if $t = SERVOING then SET_POINT else MOTORS endif

	// A slave's access has ended then, and so has a master's writing; a master reads.
	function afterLock($t in Thread, $c in Channel) =
		switch $t
			case CAMERA: RAISING
			case SERVOING: if $c = SET_POINT then RESTING else TAKING endif
			otherwise
				switch $c
					case SET_POINT: ACQUIRING
					case ENCODERS: TAKING
					case MOTORS: ACQUIRING
					otherwise RESTING
				endswitch
		endswitch

	function following($t in Thread, $c in Channel) =
		if $t = ROBOT and $c = SET_POINT then
			ENCODERS
		else
			if $c = MOTORS then MOTION else $c endif
		endif

	// What visual servoing asks: the number offered is not the one that it received.
	function available =
		offersPending or not isRead(IMAGE)

	function canMove($t in Thread) =
		switch place($t)
			case DOZING: raised
			case ASLEEP: $t != SERVOING
			otherwise true
		endswitch

	function withoutLock($t in Thread, $c in Channel) =
		seeded = SLAVE_WITHOUT_LOCK and not isMaster($t, $c)

	// The camera's period ends; visual servoing takes the signal's count; the robot controller's period ends.
	rule r_begin($t in Thread) =
		switch $t
			case CAMERA:
				place(CAMERA) := ELABORATING
			case SERVOING:
				par
					raised := false
					place(SERVOING) := CHECKING
				endpar
			case ROBOT:
				par
					at(ROBOT) := SET_POINT
					place(ROBOT) := ACQUIRING
				endpar
		endswitch

	rule r_check =
		if available then
			par
				at(SERVOING) := IMAGE
				place(SERVOING) := ACQUIRING
			endpar
		else
			if raised then
				place(SERVOING) := RESTING
			else
				place(SERVOING) := DOZING
			endif
		endif

	// One word of each array that the elaboration reads where it is, and one of the array that it writes. Then that holds a datum that was
	// not handed over. The camera has an array of its own.
	rule r_elaborate($t in Thread) =
		if $t = CAMERA then
			par
				at(CAMERA) := IMAGE
				place(CAMERA) := ACQUIRING
			endpar
		else
			let ($own = writtenInPlace($t)) in
				par
					torn($t) :=
						(exist $c in readInPlace($t) with
							content($c, (if seeded = OTHER_ARRAY then 0 else last($c) endif), word($t)) != NEWEST)
					content($own, 0, word($t)) := FRESH
					if word($t) = 1 or seeded = UNFINISHED then
						par
							word($t) := 0
							pending($own) := true
							at($t) := $own
							place($t) := ACQUIRING
						endpar
					else
						word($t) := 1
					endif
				endpar
			endlet
		endif

	rule r_acquire($t in Thread, $c in Channel) =
		if isUndef(holder($c)) or withoutLock($t, $c) then
			par
				if not withoutLock($t, $c) then
					holder($c) := $t
				endif
				place($t) := INSIDE
			endpar
		else
			place($t) := ASLEEP
		endif

	// The watchdog has ended: nothing new is read, or what was to be written is lost.
	rule r_giveUp($t in Thread, $c in Channel) =
		par
			if not isWriter($t, $c) then
				fresh($c) := false
			endif
			at($t) := following($t, $c)
			place($t) := if $t = CAMERA then RESTING else afterLock($t, $c) endif
		endpar

	// The index section: the array that was written is the one that is read, and the next one in the ring will be written.
	rule r_swap($c in Channel) =
		par
			forall $n in Position, $w in Word with $n < dimension($c) do
				if $n = last($c) then
					content($c, $n, $w) := if content($c, 0, $w) = FRESH then NEWEST else content($c, 0, $w) endif
				else
					content($c, $n, $w) := OLD
				endif
			if seeded != KEPT_PENDING then
				pending($c) := false
			endif
			isRead($c) := false
			if $c = IMAGE then
				offersPending := false
			endif
		endpar

	// What a reading gives, and whether that is new.
	rule r_look($c in Channel) =
		par
			fresh($c) := not isRead($c)
			isRead($c) := true
		endpar

	rule r_goIn($t in Thread, $c in Channel) =
		if isMaster($t, $c) then
			par
				if pending($c) then
					r_swap[$c]
				endif
				place($t) := RELEASING
			endpar
		else
			par
				if isWriter($t, $c) then
					par
						pending($c) := false
						if $c = IMAGE and pending($c) then
							offersPending := false
						endif
					endpar
				else
					r_look[$c]
				endif
				if seeded = RELEASED_EARLY then
					r_handOn[$t, $c]
				endif
				place($t) := COPYING
			endpar
		endif

	// A slave copies word by word, inside.
	rule r_copy($t in Thread, $c in Channel) =
		par
			if isWriter($t, $c) then
				content($c, 0, word($t)) := FRESH
			else
				torn($t) := content($c, last($c), word($t)) != NEWEST
			endif
			word($t) := 1 - word($t)
			if word($t) = 1 then
				if isWriter($t, $c) then
					par
						if $c = IMAGE and seeded = RAISED_FIRST then
							raised := true
						endif
						place($t) := MARKING
					endpar
				else
					place($t) := RELEASING
				endif
			endif
		endpar

	rule r_mark($t in Thread, $c in Channel) =
		par
			pending($c) := true
			if $c = IMAGE then
				offersPending := true
			endif
			place($t) := RELEASING
		endpar

	// The lock goes to who sleeps, or to nobody.
	rule r_handOn($t in Thread, $c in Channel) =
		let ($other = partner($t, $c)) in
			if place($other) = ASLEEP and at($other) = $c then
				par
					holder($c) := $other
					place($other) := INSIDE
				endpar
			else
				holder($c) := undef
			endif
		endlet

	rule r_release($t in Thread, $c in Channel) =
		par
			if holder($c) = $t then
				r_handOn[$t, $c]
			endif
			at($t) := following($t, $c)
			place($t) := afterLock($t, $c)
		endpar

	// A master reads after the lock: nobody else moves the index.
	rule r_take($t in Thread, $c in Channel) =
		par
			r_look[$c]
			at($t) := if $c = IMAGE then MOTION else $c endif
			place($t) := if $c = IMAGE then ACQUIRING else ELABORATING endif
		endpar

	rule r_raise =
		par
			if seeded != RAISED_FIRST then
				raised := true
			endif
			place(CAMERA) := RESTING
		endpar

	rule r_step($t in Thread) =
		switch place($t)
			case RESTING: r_begin[$t]
			case CHECKING: r_check[]
			case DOZING: place($t) := RESTING
			case ELABORATING: r_elaborate[$t]
			case ACQUIRING: r_acquire[$t, at($t)]
			case ASLEEP: r_giveUp[$t, at($t)]
			case INSIDE: r_goIn[$t, at($t)]
			case COPYING: r_copy[$t, at($t)]
			case MARKING: r_mark[$t, at($t)]
			case RELEASING: r_release[$t, at($t)]
			case TAKING: r_take[$t, at($t)]
			case RAISING: r_raise[]
		endswitch

	rule r_anyThread =
		choose $t in Thread with canMove($t) do
			r_step[$t]

	// In the model a task asks for a lock in the step that leaves what it did before, and is inside from the step in which it swaps or begins
	// its access. The robot controller asks for the encoders' lock as it leaves that of the set-point, and leaves the motors' as it asks for
	// visual servoing's.
	function lock($t in Thread, $c in Channel) =
		if at($t) = $c then
			switch place($t)
				case ACQUIRING: if $c = ENCODERS then WAITING else READY endif
				case ASLEEP: WAITING
				case INSIDE: WAITING
				case COPYING: EXECUTION
				case MARKING: EXECUTION
				case RELEASING: EXECUTION
				otherwise READY
			endswitch
		else
			if $c = MOTORS and at($t) = MOTION and place($t) = ACQUIRING then EXECUTION else READY endif
		endif

	// A reading lasts in the model until the next access begins, or the elaboration.
	function access($t in Thread, $c in Channel) =
		if lock($t, $c) = WAITING then
			MANAGING_SB
		else
			if isMaster($t, $c) then
				if lock($t, $c) = EXECUTION then
					MANAGING_SB
				else
					switch $c
						case IMAGE:
							if (place($t) = TAKING and at($t) = IMAGE)
								or (place($t) = ACQUIRING and at($t) = MOTION) then
								READING
							else
								undef
							endif
						case SET_POINT: if place($t) = ACQUIRING and at($t) = SET_POINT then WRITING else undef endif
						case MOTORS: if place($t) = ACQUIRING and at($t) = MOTORS then WRITING else undef endif
						otherwise
							if at($t) = $c and (place($t) = TAKING or (place($t) = ELABORATING and word($t) = 0)) then
								READING
							else
								undef
							endif
					endswitch
				endif
			else
				if lock($t, $c) = EXECUTION then
					if isWriter($t, $c) then WRITING else READING endif
				else
					undef
				endif
			endif
		endif

	// A slave's writing is pending in the model from its beginning.
	function isPending($c in Channel) =
		pending($c)
		or (exist $t in Thread with
			at($t) = $c and isWriter($t, $c) and not isMaster($t, $c) and contains({COPYING, MARKING}, place($t)))

	// what an elaboration, or a copy, reads is the newest datum handed over, and whole
	invariant inv_whole over torn: (forall $t in Thread with not torn($t))
	// the array that is read holds the newest datum
	invariant inv_newest over content:
		(forall $c in Channel, $w in Word with content($c, last($c), $w) = NEWEST)
	// who works as a slave has the lock, and who sleeps will be woken
	invariant inv_inside over holder:
		(forall $t in Thread with contains({COPYING, MARKING}, place($t)) implies holder(at($t)) = $t)
	invariant inv_woken over holder:
		(forall $t in Thread with place($t) = ASLEEP implies holder(at($t)) = partner($t, at($t)))
	// visual servoing does not sleep over an image: the camera is about to raise the signal, if it is not raised
	invariant inv_noLostWakeUp over raised:
		place(SERVOING) = DOZING and available
		implies (raised or (at(CAMERA) = IMAGE and contains({MARKING, RELEASING, RAISING}, place(CAMERA))))

	// no thread is ever cut off from the end of its cycle
	CTLSPEC ctlSpec_camera: ag(ef(place(CAMERA) = RAISING))
	CTLSPEC ctlSpec_servoing: ag(ef(at(SERVOING) = SET_POINT and place(SERVOING) = RELEASING))
	CTLSPEC ctlSpec_robot: ag(ef(at(ROBOT) = MOTION and place(ROBOT) = RELEASING))

	main rule r_Main =
		r_anyThread[]

default init s0:
	function seeded = NONE
	function holder($c in Channel) = undef
	function pending($c in Channel) = false
	function content($c in Channel, $n in Position, $w in Word) = if $n = last($c) then NEWEST else OLD endif
	function offersPending = false
	function raised = false
	function place($t in Thread) = RESTING
	function at($t in Thread) =
		switch $t
			case CAMERA: IMAGE
			case SERVOING: SET_POINT
			otherwise MOTION
		endswitch
	function word($t in Thread) = 0
	function isRead($c in Channel) = true
	function fresh($c in Channel) = false
	function torn($t in Thread) = false
