//! What an encoding of states was found too narrow for, so that the next one is wide enough.

use std::collections::{BTreeMap, BTreeSet};

use program::FunctionId;

use crate::packed::collection::Misfit;

/// What has been found not to fit since the encoding was made.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Widening {
    /// Functions that may be undef.
    pub(crate) undefined: BTreeSet<FunctionId>,
    /// The rest changes.
    pub(crate) rest: bool,
    /// Functions that hold sequences, and how long these have become.
    pub(crate) longest: BTreeMap<FunctionId, usize>,
    /// Functions that hold collections of other elements than those of their domains.
    pub(crate) numbered: BTreeSet<FunctionId>,
}

impl Widening {
    /// Adds what another has found.
    pub fn merge(&mut self, other: &Widening) {
        self.undefined.extend(&other.undefined);
        self.rest |= other.rest;
        for (function, length) in &other.longest {
            let longest = self.longest.entry(*function).or_default();
            *longest = (*longest).max(*length);
        }
        self.numbered.extend(&other.numbered);
    }

    /// Whether nothing has been found.
    pub fn is_empty(&self) -> bool {
        *self == Widening::default()
    }
}

/// The state does not fit into the encoding.
#[derive(Debug)]
pub(crate) struct TooNarrow(pub Widening);

impl TooNarrow {
    /// A collection of a function has no code.
    pub fn of(function: FunctionId, misfit: Misfit) -> TooNarrow {
        let mut widening = Widening::default();
        match misfit {
            Misfit::Longer(length) => _ = widening.longest.insert(function, length),
            Misfit::Foreign => _ = widening.numbered.insert(function),
        }
        TooNarrow(widening)
    }
}
