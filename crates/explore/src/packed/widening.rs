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
    /// By dense location number, how many bits suffice for the few values that the location was seen to take.
    pub(crate) rooms: BTreeMap<u32, u8>,
    /// Locations that have taken more values than that.
    pub(crate) outgrown: BTreeSet<u32>,
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
        if other.is_outgrown() {
            self.rooms.clear();
        }
    }

    /// Gives locations the room that a census found to suffice, or takes it back if there was none.
    pub fn settle(&mut self, rooms: Rooms) {
        self.rooms = rooms.0;
    }

    /// Whether a location has outgrown the room that a census gave it.
    pub fn is_outgrown(&self) -> bool {
        !self.outgrown.is_empty()
    }

    /// Whether nothing has been found.
    pub fn is_empty(&self) -> bool {
        *self == Widening::default()
    }
}

/// How many bits suffice for the values that locations were seen to take.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Rooms(pub(crate) BTreeMap<u32, u8>);

/// The state does not fit into the encoding.
#[derive(Debug)]
pub(crate) struct TooNarrow(pub Widening);

impl TooNarrow {
    /// A location has taken more values than it has room for.
    pub fn outgrown(location: u32) -> TooNarrow {
        TooNarrow(Widening { outgrown: BTreeSet::from([location]), ..Widening::default() })
    }

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
