//! What steps did, for the caller.

/// What a step did.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Step {
    /// How many updates the step's update set held, trivial ones and new elements included.
    pub updates: usize,
    /// Whether any of them changed a value or a domain grew.
    pub changed: bool,
    /// Whether a domain grew.
    pub grown: bool,
}

/// What several steps did that one call made.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Passed {
    /// How many were made.
    pub steps: u64,
    /// How many of them changed the state.
    pub changed: u64,
    /// How many of them had no update at all.
    pub empty: u64,
    /// How many updates their update sets held.
    pub updates: u64,
}

impl Passed {
    /// Counts one more.
    #[inline]
    pub fn count(&mut self, step: Step) {
        self.steps += 1;
        self.changed += u64::from(step.changed);
        self.empty += u64::from(step.updates == 0);
        self.updates += step.updates as u64;
    }
}

impl std::ops::AddAssign for Passed {
    fn add_assign(&mut self, more: Passed) {
        self.steps += more.steps;
        self.changed += more.changed;
        self.empty += more.empty;
        self.updates += more.updates;
    }
}
