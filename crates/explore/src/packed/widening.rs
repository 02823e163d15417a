//! What an encoding of states was found too narrow for, so that the next one is wide enough.

use std::collections::{BTreeMap, BTreeSet};

use program::FunctionId;

use crate::checkpoint::{Known, Refusal, Words};
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

    /// All of it, as words of a checkpoint.
    pub fn keep(&self, words: &mut Vec<u64>) {
        let Widening { undefined, rest, longest, numbered, rooms, outgrown } = self;
        let functions = |words: &mut Vec<u64>, functions: &BTreeSet<FunctionId>| {
            words.push(functions.len() as u64);
            words.extend(functions.iter().map(|function| u64::from(function.0)));
        };
        functions(words, undefined);
        words.push(u64::from(*rest));
        words.push(longest.len() as u64);
        words.extend(longest.iter().flat_map(|(function, length)| [u64::from(function.0), *length as u64]));
        functions(words, numbered);
        words.push(rooms.len() as u64);
        words.extend(rooms.iter().flat_map(|(location, bits)| [u64::from(*location), u64::from(*bits)]));
        words.push(outgrown.len() as u64);
        words.extend(outgrown.iter().map(|location| u64::from(*location)));
    }

    /// What was kept.
    ///
    /// # Errors
    /// The words are none of a widening.
    pub fn again(words: &mut Words<'_>, known: Known<'_>) -> Result<Widening, Refusal> {
        let undefined = words.many(|words| known.function(words))?;
        let rest = words.below(2)? == 1;
        let longest = words.many(|words| Ok((known.function(words)?, words.number()?)))?;
        let numbered = words.many(|words| known.function(words))?;
        let rooms = words.many(|words| Ok((words.number()?, words.number()?)))?;
        let outgrown = words.many(|words| words.number())?;
        Ok(Widening { undefined, rest, longest, numbered, rooms, outgrown })
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
