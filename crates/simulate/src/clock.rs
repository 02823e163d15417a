//! The clock of a run: `currTimeSecs` and its like, and the monitored `mCurrTime…` of the time libraries.
//!
//! The default advances by a fixed amount in each step, so a run is the same every time; a shell may hand in the real
//! one. INVARIANT: within a step the default clock stands still.

use machine::TimeUnit;
use program::Function;

/// Tells the time.
pub trait Clock {
    /// A step begins.
    fn begin(&mut self, _step: u64) {}

    /// The time in a unit. An error is a sentence for the user.
    fn now(&mut self, unit: TimeUnit) -> Result<i64, String>;
}

/// A clock that counts steps.
#[derive(Debug, Clone, Copy)]
pub struct StepClock {
    step_ns: u64,
    now_ns: u64,
}

impl StepClock {
    /// A clock at 0 that each step advances by this many nanoseconds.
    pub fn new(step_ns: u64) -> Self {
        StepClock { step_ns, now_ns: 0 }
    }
}

impl Default for StepClock {
    /// One second a step.
    fn default() -> Self {
        StepClock::new(1_000_000_000)
    }
}

impl Clock for StepClock {
    fn begin(&mut self, step: u64) {
        self.now_ns = step.saturating_mul(self.step_ns);
    }

    fn now(&mut self, unit: TimeUnit) -> Result<i64, String> {
        let unit_ns = match unit {
            TimeUnit::Nanoseconds => 1,
            TimeUnit::Milliseconds => 1_000_000,
            TimeUnit::Seconds => 1_000_000_000,
        };
        i64::try_from(self.now_ns / unit_ns).map_err(|_| "the clock has run out of 64 bits".to_string())
    }
}

/// A monitored function of the time libraries: a unit and how many of it make one.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LibraryTime {
    unit: TimeUnit,
    divisor: i64,
}

impl LibraryTime {
    pub fn of(self, clock: &mut dyn Clock) -> Result<i64, String> {
        Ok(clock.now(self.unit)? / self.divisor)
    }
}

/// Whether a function is the clock of a time library.
pub(crate) fn library_time(function: &Function) -> Option<LibraryTime> {
    if !function.library || !function.parameters.is_empty() {
        return None;
    }
    let (unit, divisor) = match function.name.as_str() {
        "mCurrTimeNanosecs" => (TimeUnit::Nanoseconds, 1),
        "mCurrTimeMillisecs" => (TimeUnit::Milliseconds, 1),
        "mCurrTimeSecs" => (TimeUnit::Seconds, 1),
        "mCurrTimeMins" => (TimeUnit::Seconds, 60),
        "mCurrTimeHours" => (TimeUnit::Seconds, 3600),
        _ => return None,
    };
    Some(LibraryTime { unit, divisor })
}
