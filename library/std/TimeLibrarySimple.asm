// Timers that count in seconds.
//
// It is built in: an import whose path ends in `TimeLibrarySimple` finds this text, and the standard library with it.
// As TimeLibrary, without units.
module TimeLibrarySimple

import StandardLibrary

export *

signature:
	abstract domain Timer

	// The present time, by the environment.
	monitored mCurrTimeSecs: Integer

	// When the timer was started last, and how long it runs.
	controlled start: Timer -> Integer
	controlled duration: Timer -> Integer

	// The present time for this timer.
	derived currentTime: Timer -> Integer
	// The timer has run for its duration.
	derived expired: Timer -> Boolean

definitions:
	function currentTime($t in Timer) = mCurrTimeSecs

	function expired($t in Timer) = currentTime($t) >= start($t) + duration($t)

	// Starts the timer afresh.
	rule r_reset_timer($t in Timer) = start($t) := currentTime($t)

	// Says how long the timer runs.
	rule r_set_duration($t in Timer, $duration in Integer) = duration($t) := $duration
