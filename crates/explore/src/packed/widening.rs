//! What an encoding of states was found too narrow for, so that the next one is wide enough.

use std::collections::BTreeSet;

use program::FunctionId;

/// What has been found not to fit since the encoding was made.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Widening {
    /// Functions that may be undef.
    pub(crate) undefined: BTreeSet<FunctionId>,
    /// The rest changes.
    pub(crate) rest: bool,
}

impl Widening {
    /// Adds what another has found.
    pub fn merge(&mut self, other: &Widening) {
        self.undefined.extend(&other.undefined);
        self.rest |= other.rest;
    }

    /// Whether nothing has been found.
    pub fn is_empty(&self) -> bool {
        !self.rest && self.undefined.is_empty()
    }
}

/// The state does not fit into the encoding.
#[derive(Debug)]
pub(crate) struct TooNarrow(pub Widening);
