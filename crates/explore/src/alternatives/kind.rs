//! What one alternative of a step comes to, as far as a search tells it apart.

use machine::FaultClass;

/// What an alternative comes to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AlternativeKind {
    /// A next state.
    Next,
    /// A fault.
    Fault(FaultClass),
    /// It cannot be gone through.
    Unbounded,
    /// An assumption leaves it out.
    Excluded,
}
