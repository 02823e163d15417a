//! Bounds on what one step may take, so that a model that runs forever or grows without end is told so.

/// The limits of a machine; `groundstate run --max-…` sets them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Rounds of `while`, `whilerec` and `iterate` in one step, all together.
    pub iterations: u64,
    /// Calls of turbo rules, macro rules, and functions inside each other.
    pub call_depth: u64,
    /// Elements of one collection or enumeration, and candidates of one choice.
    pub collection: u64,
    /// Updates in one step.
    pub updates: u64,
    /// Locations that have a value, and elements made by `extend`.
    pub locations: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Limits {
            iterations: 1_000_000,
            call_depth: 10_000,
            collection: 10_000_000,
            updates: 10_000_000,
            locations: 50_000_000,
        }
    }
}
