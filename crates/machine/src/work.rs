//! What a step has worked, held against its limits; and the request to end it, looked at on the way.
//!
//! Everything that a rule or term can do again and again counts: bindings of variables, calls, rounds of loops, and an
//! eighth of the members that an operation copies or looks through. INVARIANT: between two looks at the request lies no more
//! than [`INTERVAL`] of that, or one operation on values within the limit of their size.

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
