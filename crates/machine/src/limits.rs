//! Bounds on what one step may take, so that a model that runs forever or grows without end gets a fault.

use crate::interrupt::Interrupt;

/// The limits of a machine; `groundstate run --max-…` sets them.
#[derive(Debug, Clone)]
pub struct Limits {
    /// Rounds of `while`, `whilerec` and `iterate` in one step, all together.
    pub iterations: u64,
    /// Calls of turbo rules, macro rules, and functions inside each other.
    pub call_depth: u64,
    /// Elements of one collection or enumeration, and candidates of one choice. What lies in a value counts as often as it
    /// occurs there, though it be kept once.
    pub collection: u64,
    /// Updates in one step.
    pub updates: u64,
    /// Locations that have a value, and elements made by `extend`.
    pub locations: u64,
    /// Bindings of variables, calls and rounds of loops in one step, all together, and an eighth of the members that are
    /// copied or looked through. Compiled code counts fewer: it may make a step that is too long for the interpreter.
    pub work: u64,
    /// Checked within steps: the user may have asked to stop, or memory may be short.
    pub interrupt: Interrupt,
}

impl Default for Limits {
    fn default() -> Self {
        Limits {
            iterations: 1_000_000,
            call_depth: 10_000,
            collection: 10_000_000,
            updates: 10_000_000,
            locations: 50_000_000,
            work: 1_000_000_000,
            interrupt: Interrupt::default(),
        }
    }
}
