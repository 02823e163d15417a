//! What is looked for in states, and where it was found.

/// What is looked for in a state.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Target {
    /// A step that is a fault, by its class.
    Fault(usize),
    /// No step changes the state.
    Rest,
    /// A condition that does not hold, by its number.
    Condition(usize),
    /// A condition on the step that does not hold in one of its steps, by its number.
    StepCondition(usize),
}

/// Where something was found first.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Found {
    /// What.
    pub target: Target,
    /// The distance of the state.
    pub depth: usize,
    /// The state.
    pub state: Box<[u64]>,
}
