//! The seam where steps are made without the machine.
//!
//! In: a packed state. Out: what all alternatives of its step come to, and the packed states that they lead to. A maker
//! either knows all of them or says that it does not; the machine makes the step then, and the maker may learn from it.
//! INVARIANT: a maker that knows gives exactly what the machine would, in the order of the alternatives.

use machine::Interrupt;

use crate::alternatives::expansion::Expansion;
use crate::alternatives::successors::Successors;

/// Why a maker has not made all steps of a state.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Unmade {
    /// Some alternative is not known.
    Unknown,
    /// Whoever waits has had enough.
    Interrupted,
}

/// Makes the steps of packed states.
pub(crate) trait StepMaker {
    /// Counts what each alternative of a state comes to, and lists where it leads. Where that is not known both are worth
    /// nothing.
    fn make(
        &mut self,
        state: &[u64],
        interrupt: &Interrupt,
        expansion: &mut Expansion,
        found: &mut Successors<'_>,
    ) -> Result<(), Unmade>;
}
