//! Steps of whole sets of states: the trees of decisions walked with many states at a time.
//!
//! In: sets of packed states, in whatever form their owner keeps them ([`StateSets`]). Out: for each end of the tree the
//! states that come to it. Where a set meets a branch that no step has taken yet, the machine makes the steps of one of
//! its states and the walk goes on: so a symbolic search needs no second meaning of the language, and learns of the tree
//! only what can be reached.

use crate::alternatives::kind::AlternativeKind;
use crate::explorer::Explorer;
use crate::memory::condition::Truth;
use crate::memory::tree::{Place, Stop, Tree};
use crate::packed::widening::Widening;
use crate::packed::words::{Bits, Overwrite};

/// Sets of packed states.
pub trait StateSets {
    /// A set.
    type Set: Clone;
    /// Why an operation has no result: no room, or no patience.
    type Failure;

    /// Whether a set has no state.
    fn is_empty(&self, set: &Self::Set) -> bool;
    /// The codes that a field has in a set, in order, each with the states that have it.
    ///
    /// # Errors
    /// No room.
    fn split(&mut self, set: &Self::Set, field: Bits) -> Result<Vec<(u64, Self::Set)>, Self::Failure>;
    /// The states of both.
    ///
    /// # Errors
    /// No room.
    fn union(&mut self, a: &Self::Set, b: &Self::Set) -> Result<Self::Set, Self::Failure>;
    /// The states of the first that are not in the second.
    ///
    /// # Errors
    /// No room.
    fn minus(&mut self, a: &Self::Set, b: &Self::Set) -> Result<Self::Set, Self::Failure>;
    /// A state of a set that is not empty.
    fn member(&self, set: &Self::Set) -> Box<[u64]>;
}

/// What the alternatives that come to one end have in common.
#[derive(Debug, Clone, Copy)]
pub struct Alternative<'a> {
    /// What they come to.
    pub kind: AlternativeKind,
    /// The conditions on the step that do not hold, by their numbers.
    pub failed: &'a [u32],
    /// How the next state differs from the state.
    pub overwrites: &'a [Overwrite],
}

/// Why a set could not be expanded.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SetTrouble<F> {
    /// A successor does not fit: all begins anew.
    Narrow(Widening),
    /// The tree has grown beyond its limit: steps look at too much of the state.
    Crowded,
    /// Whoever waits has had enough.
    Interrupted,
    /// The sets' owner failed.
    Failed(F),
}

impl<F> From<F> for SetTrouble<F> {
    fn from(failure: F) -> Self {
        SetTrouble::Failed(failure)
    }
}

impl Explorer {
    /// Where the fields of a packed state stand, in their order.
    pub fn fields(&self) -> Vec<Bits> {
        let fields = self.encoding.fields.iter().filter(|field| field.bits > 0);
        fields.map(|field| Bits { word: field.word, shift: field.shift, bits: field.bits }).collect()
    }

    /// Which fields matter to each other: for each kind of step met so far the fields that it looks at and those that it
    /// writes, as places in [`Explorer::fields`].
    pub fn dependencies(&self) -> Vec<Vec<usize>> {
        let fields = self.fields();
        let place = |bits: Bits| fields.binary_search(&bits).unwrap_or(0);
        let mut found = std::collections::BTreeSet::new();
        self.steps.tree.each_end(&mut |looked, end| {
            let mut edge: Vec<usize> = looked.iter().map(|bits| place(*bits)).collect();
            for overwrite in self.steps.overwrites_of(end) {
                let touched = fields.iter().enumerate().filter(|(_, bits)| {
                    bits.word == overwrite.word && overwrite.clear >> bits.shift & ((1 << bits.bits) - 1) != 0
                });
                edge.extend(touched.map(|(index, _)| index));
            }
            edge.sort_unstable();
            edge.dedup();
            found.insert(edge);
        });
        found.into_iter().filter(|edge| edge.len() > 1).collect()
    }

    /// How many parts the step of every state has that begin with nothing but a choice; 1 where it begins otherwise.
    /// Known once some state was expanded.
    pub fn parts(&self) -> usize {
        match self.steps.tree.stop(Place::Root) {
            Some(Stop::Ask { of, .. }) => of as usize,
            _ => 1,
        }
    }

    /// Expands one part of the steps of a set of states: calls `visit` with the states that come to each end. The parts
    /// together are the whole; a state may come to several ends. Gives back the states that the part is alive in.
    ///
    /// # Errors
    /// See [`SetTrouble`].
    pub fn expand_part<S: StateSets>(
        &mut self,
        part: usize,
        sets: &mut S,
        set: &S::Set,
        visit: &mut Visit<'_, S>,
    ) -> Result<Option<S::Set>, SetTrouble<S::Failure>> {
        let place = match self.steps.tree.stop(Place::Root) {
            Some(stop @ Stop::Ask { .. }) => Tree::child(stop, part as u64),
            _ => Place::Root,
        };
        self.expand_from(place, sets, set.clone(), visit)
    }

    /// The same for what comes where no part is alive: the states in which none is.
    ///
    /// # Errors
    /// See [`SetTrouble`].
    pub fn expand_otherwise<S: StateSets>(
        &mut self,
        sets: &mut S,
        set: &S::Set,
        visit: &mut Visit<'_, S>,
    ) -> Result<(), SetTrouble<S::Failure>> {
        if let Some(stop @ Stop::Ask { of, guarded: true, .. }) = self.steps.tree.stop(Place::Root) {
            self.expand_from(Tree::child(stop, u64::from(of)), sets, set.clone(), visit)?;
        }
        Ok(())
    }

    fn expand_from<S: StateSets>(
        &mut self,
        place: Place,
        sets: &mut S,
        set: S::Set,
        visit: &mut Visit<'_, S>,
    ) -> Result<Option<S::Set>, SetTrouble<S::Failure>> {
        if sets.is_empty(&set) {
            return Ok(None);
        }
        if self.steps.tree.stop(place).is_none() && !self.steps.tree.is_crowded() {
            let state = sets.member(&set);
            self.expand_by_machine(&state, &mut Vec::new()).map_err(SetTrouble::Narrow)?;
        }
        if self.settings.interrupt.is_raised() {
            return Err(SetTrouble::Interrupted);
        }
        let Some(stop) = self.steps.tree.stop(place) else { return Err(SetTrouble::Crowded) };
        stacker::maybe_grow(1 << 18, 4 << 20, || match stop {
            Stop::Dead => Ok(None),
            Stop::End(end) => {
                let kind = self.steps.kind_of(end);
                let (failed, overwrites) = (self.steps.failures_of(end), self.steps.overwrites_of(end));
                visit(sets, &Alternative { kind, failed, overwrites }, &set)?;
                Ok(Some(set))
            }
            Stop::Field { bits, .. } => {
                let mut alive = None;
                for (code, some) in sets.split(&set, bits)? {
                    let some = self.expand_from(Tree::child(stop, code), sets, some, visit)?;
                    alive = join(sets, alive, some)?;
                }
                Ok(alive)
            }
            Stop::Ask { of, guarded, .. } => {
                let mut alive = None;
                for child in 0..of {
                    let some = self.expand_from(Tree::child(stop, u64::from(child)), sets, set.clone(), visit)?;
                    alive = join(sets, alive, some)?;
                }
                if guarded {
                    let rest = match &alive {
                        Some(alive) => sets.minus(&set, alive)?,
                        None => set.clone(),
                    };
                    let some = self.expand_from(Tree::child(stop, u64::from(of)), sets, rest, visit)?;
                    alive = join(sets, alive, some)?;
                }
                Ok(alive)
            }
        })
    }

    /// The states of a set in which a condition does not come to [`Truth::True`], by what it comes to.
    ///
    /// # Errors
    /// See [`SetTrouble`].
    pub fn truths<S: StateSets>(
        &mut self,
        condition: usize,
        sets: &mut S,
        set: &S::Set,
    ) -> Result<Judged<S::Set>, SetTrouble<S::Failure>> {
        let mut found: Judged<S::Set> = Vec::new();
        let mut open = set.clone();
        for part in 0..self.conditions[condition].parts.len() {
            let mut ends: Vec<(Truth, S::Set)> = Vec::new();
            self.truths_from(condition, part, Place::Root, sets, open.clone(), &mut ends)?;
            // If there are several answers, the worst one counts.
            ends.sort_by_key(|(truth, _)| std::cmp::Reverse(*truth));
            let mut worse: Option<S::Set> = None;
            for (truth, states) in ends {
                let new = match &worse {
                    Some(worse) => sets.minus(&states, worse)?,
                    None => states.clone(),
                };
                worse = join(sets, worse, Some(states))?;
                if truth == Truth::True || sets.is_empty(&new) {
                    continue;
                }
                // A part after an undefined one may still make the whole false.
                if truth != Truth::Undef {
                    open = sets.minus(&open, &new)?;
                }
                found.push((truth, new));
            }
        }
        Ok(found)
    }

    fn truths_from<S: StateSets>(
        &mut self,
        condition: usize,
        part: usize,
        place: Place,
        sets: &mut S,
        set: S::Set,
        ends: &mut Vec<(Truth, S::Set)>,
    ) -> Result<(), SetTrouble<S::Failure>> {
        if sets.is_empty(&set) {
            return Ok(());
        }
        let tree = &self.conditions[condition].parts[part].tree;
        if tree.stop(place).is_none() && !tree.is_crowded() {
            let state = sets.member(&set);
            self.decide(condition, part, &state);
        }
        if self.settings.interrupt.is_raised() {
            return Err(SetTrouble::Interrupted);
        }
        let tree = &self.conditions[condition].parts[part].tree;
        let Some(stop) = tree.stop(place) else { return Err(SetTrouble::Crowded) };
        stacker::maybe_grow(1 << 18, 4 << 20, || match stop {
            Stop::Dead => Ok(()),
            Stop::End(end) => {
                let truth = Truth::of_end(end);
                match ends.iter_mut().find(|(other, _)| *other == truth) {
                    Some((_, states)) => *states = sets.union(states, &set)?,
                    None => ends.push((truth, set)),
                }
                Ok(())
            }
            Stop::Field { bits, .. } => {
                for (code, some) in sets.split(&set, bits)? {
                    self.truths_from(condition, part, Tree::child(stop, code), sets, some, ends)?;
                }
                Ok(())
            }
            Stop::Ask { of, guarded, .. } => {
                for child in 0..of + u32::from(guarded) {
                    self.truths_from(condition, part, Tree::child(stop, u64::from(child)), sets, set.clone(), ends)?;
                }
                Ok(())
            }
        })
    }
}

/// Is told of an end: what it means, and which states come to it.
pub type Visit<'v, S> =
    dyn FnMut(&mut S, &Alternative<'_>, &<S as StateSets>::Set) -> Result<(), <S as StateSets>::Failure> + 'v;

fn join<S: StateSets>(sets: &mut S, a: Option<S::Set>, b: Option<S::Set>) -> Result<Option<S::Set>, S::Failure> {
    match (a, b) {
        (Some(a), Some(b)) => sets.union(&a, &b).map(Some),
        (a, b) => Ok(a.or(b)),
    }
}

/// States by what a condition comes to in them.
pub type Judged<Set> = Vec<(Truth, Set)>;
