// Timers, each with a time unit of its own.
//
// It is built in: an import whose path ends in `TimeLibrary` finds this text, and the standard library with it. The
// environment gives the time, once in each unit; a timer has expired when its duration has passed since its start.
module TimeLibrary

import StandardLibrary

export *

signature:
	abstract domain Timer
	enum domain TimerUnit = {NANOSEC | MILLISEC | SEC | MIN | HOUR}

	// The present time, by the environment.
	monitored mCurrTimeNanosecs: Integer
	monitored mCurrTimeMillisecs: Integer
	monitored mCurrTimeSecs: Integer
	monitored mCurrTimeMins: Integer
	monitored mCurrTimeHours: Integer

	// When the timer was started last, how long it runs, and the unit of both.
	controlled start: Timer -> Integer
	controlled duration: Timer -> Integer
	controlled timerUnit: Timer -> TimerUnit

	// The present time in the timer's unit.
	derived currentTime: Timer -> Integer
	// The timer has run for its duration.
	derived expired: Timer -> Boolean

definitions:
	function currentTime($t in Timer) =
		switch timerUnit($t)
			case NANOSEC: mCurrTimeNanosecs
			case MILLISEC: mCurrTimeMillisecs
			case SEC: mCurrTimeSecs
			case MIN: mCurrTimeMins
			case HOUR: mCurrTimeHours
		endswitch

	function expired($t in Timer) = currentTime($t) >= start($t) + duration($t)

	// Starts the timer afresh.
	rule r_reset_timer($t in Timer) = start($t) := currentTime($t)

	// Says how long the timer runs.
	rule r_set_duration($t in Timer, $duration in Integer) = duration($t) := $duration

	// Says in which unit the timer counts.
	rule r_set_timer_unit($t in Timer, $unit in TimerUnit) = timerUnit($t) := $unit
