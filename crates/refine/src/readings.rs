//! What inputs were in the steps of a diagram: sets of values by location, each with a number.
//!
//! In: labels of steps, one after the other. Out: numbers of what was read. INVARIANT: the same that was read has one number.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use explore::checkpoint::{Refusal, Words};
use rustc_hash::FxHashMap;

use crate::side::{Inputs, LabelId};

/// By location of an input the values that it had in a diagram.
pub(crate) type Reads = BTreeMap<u32, BTreeSet<u32>>;

/// The number of a [`Reads`].
pub(crate) type ReadsId = u32;

/// See the module.
#[derive(Debug)]
pub(crate) struct Readings {
    all: Vec<Rc<Reads>>,
    numbers: FxHashMap<Rc<Reads>, ReadsId>,
    /// By what was read before and the label of a step: what was read then.
    after: FxHashMap<(ReadsId, LabelId), ReadsId>,
}

impl Default for Readings {
    fn default() -> Readings {
        let mut readings = Readings { all: Vec::new(), numbers: FxHashMap::default(), after: FxHashMap::default() };
        readings.number(Reads::new());
        readings
    }
}

impl Readings {
    /// Nothing was read.
    pub const NONE: ReadsId = 0;

    /// What a number says.
    pub fn get(&self, reads: ReadsId) -> &Reads {
        &self.all[reads as usize]
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.all.len()
    }

    /// All of them, as words of a checkpoint.
    pub fn keep(&self, words: &mut Vec<u64>) {
        words.push(self.all.len() as u64);
        for reads in &self.all {
            words.push(reads.len() as u64);
            for (location, values) in &**reads {
                words.extend([u64::from(*location), values.len() as u64]);
                words.extend(values.iter().map(|value| u64::from(*value)));
            }
        }
    }

    /// What was kept, with the same numbers.
    ///
    /// # Errors
    /// The words are none of these inputs.
    pub fn again(words: &mut Words<'_>, inputs: &Inputs) -> Result<Readings, Refusal> {
        let mut readings = Readings { all: Vec::new(), numbers: FxHashMap::default(), after: FxHashMap::default() };
        let location = |words: &mut Words<'_>| {
            let location = words.below(inputs.told.len())?;
            Ok((location, words.many(|words| words.below(inputs.told_values.len()))?))
        };
        let all: Vec<Reads> = words.many(|words| words.many(location))?;
        let count = all.len();
        all.into_iter().for_each(|reads| _ = readings.number(reads));
        let is_first = readings.all.first().is_some_and(|reads| reads.is_empty());
        if is_first && readings.all.len() == count { Ok(readings) } else { Err(Refusal::Damaged) }
    }

    fn number(&mut self, reads: Reads) -> ReadsId {
        let next = self.all.len() as ReadsId;
        let Readings { all, numbers, .. } = self;
        *numbers.entry(Rc::new(reads)).or_insert_with_key(|reads| {
            all.push(Rc::clone(reads));
            next
        })
    }

    /// What was read before and in a step.
    pub fn with(&mut self, before: ReadsId, label: LabelId, inputs: &Inputs) -> ReadsId {
        if let Some(known) = self.after.get(&(before, label)) {
            return *known;
        }
        let mut reads = self.get(before).clone();
        for (location, value) in inputs.entries(label).iter() {
            reads.entry(*location).or_default().insert(*value);
        }
        let after = self.number(reads);
        self.after.insert((before, label), after);
        after
    }

    /// The same where inputs that were not read have these values.
    pub fn where_unread(&mut self, before: ReadsId, values: &BTreeMap<u32, u32>) -> ReadsId {
        if values.is_empty() {
            return before;
        }
        let mut reads = self.get(before).clone();
        reads.extend(values.iter().map(|(location, value)| (*location, BTreeSet::from([*value]))));
        self.number(reads)
    }
}
