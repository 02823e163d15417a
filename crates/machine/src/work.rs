//! Compares the work of a step with its limits, and checks the request to stop on the way.
//!
//! Everything that a rule or term can repeat counts: bindings of variables, calls, rounds of loops, and an eighth of the
//! members that an operation copies or goes through. INVARIANT: between two checks of the request there is at most
//! [`INTERVAL`] of that work, or one operation on values within the limit of their size.

/// Work between two looks.
pub(crate) const INTERVAL: u64 = 1 << 12;
/// What a step has worked.
#[derive(Debug, Default, Clone, Copy)]
pub(crate) struct Work {
    pub done: u64,
    /// When to look again.
    pub look: u64,
}

impl Work {
    /// Nothing is done yet.
    pub fn none() -> Work {
        Work { done: 0, look: INTERVAL }
    }
}
