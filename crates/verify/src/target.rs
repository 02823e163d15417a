//! The targets of a search, and where they were found.

/// Something to look for in a state.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Target {
    /// A step faults, by the fault's class.
    Fault(usize),
    /// No step changes the state.
    Rest,
    /// A condition is false, by its number.
    Condition(usize),
    /// A condition on steps is false for one of its steps, by its number.
    StepCondition(usize),
}

/// The first place where a target was found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Found {
    /// What.
    pub target: Target,
    /// The distance of the state.
    pub depth: usize,
    /// The state.
    pub state: Box<[u64]>,
}
