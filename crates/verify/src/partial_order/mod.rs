//! Partial-order reduction, if the main rule chooses who moves: independent moves are made in one order only.
//!
//! In: a program whose main rule is one `choose` over constant domains; each binding is a *part*. Out: for a state,
//! either all its steps or those of one part, an *ample set* (D. Peled, *All from one, one for all*, 1993; E. Clarke,
//! O. Grumberg, D. Peled, *Model Checking*, 1999, ch. 10). One part suffices if no other part ever writes what it reads
//! now, no other part ever reads or writes what it writes now, and no checked condition reads what it writes. Then it
//! can make the same steps after any steps of the others, with the same result. The machine tells what the part reads
//! and writes now; [`footprint`] tells from the rules what others may ever do. INVARIANT: along the steps of ample
//! sets, states grow in the canonical order, so every cycle contains a state all of whose steps are made.
//!
//! LIMIT: a tree of steps that was given up has no parts: then all steps are made, by each worker from when it gave up.
//! LIMIT: locations whose values are numbered, or that are in the rest of the state, concern all parts.

mod footprint;
mod located;

use std::sync::Arc;

use explore::{AlternativeKind, Bits, Expansion, Explorer, Overwrite, SetTrouble, StateSets, Widening, apply};
use program::Program;

use crate::partial_order::footprint::{Footprint, footprints};
use crate::partial_order::located::located;
use crate::plan::Plan;

/// LIMIT: the most parts.
const PARTS: usize = 64;

/// Why states cannot be reduced.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unreduced {
    /// The main rule does not choose who moves, or chooses among too many.
    NoChoice,
    /// An invariant or an assumption reads inputs, so every step may violate it.
    Inputs,
    /// No part has locations of its own.
    AllShared,
}

/// A partial-order reduction for one program.
#[derive(Debug)]
pub(crate) struct Reduction {
    fields: Vec<Bits>,
    /// For each part, the fields that it may read, and those that it may write.
    looks: Vec<Vec<bool>>,
    writes: Vec<Vec<bool>>,
    /// For each field, whether its location is known.
    located: Vec<bool>,
    /// For each field, the parts (as bits) that may read or write it, and those that may write it.
    touched_by: Vec<u64>,
    written_by: Vec<u64>,
    /// For each field, whether a condition may read it.
    visible: Vec<bool>,
    /// For each field, whether it contains an input that an initial state keeps. Every step removes it, and nothing
    /// restores it.
    inputs: Vec<bool>,
    /// The parts whose steps may suffice.
    candidates: Vec<usize>,
}

/// The reduction, if it is requested, or why it is not possible.
pub(crate) fn reduction(
    program: &Arc<Program>,
    plan: &Plan,
    explorer: &mut Explorer,
) -> (Option<Arc<Reduction>>, Option<Unreduced>) {
    match plan.partial_order.then(|| Reduction::new(program, plan, explorer)) {
        None => (None, None),
        Some(Ok(reduction)) => (Some(Arc::new(reduction)), None),
        Some(Err(unreduced)) => (None, Some(unreduced)),
    }
}

impl Reduction {
    /// Analyses a program.
    pub fn new(program: &Arc<Program>, plan: &Plan, explorer: &mut Explorer) -> Result<Reduction, Unreduced> {
        if !plan.settings.step_conditions.is_empty() {
            return Err(Unreduced::Inputs);
        }
        let (fields, locations) = (explorer.fields(), located(explorer));
        let found = footprints(program, &plan.settings, &locations).filter(|found| found.parts.len() <= PARTS);
        let (parts, visible) = found.map(|found| (found.parts, found.visible)).ok_or(Unreduced::NoChoice)?;
        let initial = explorer.initial().first().map(Box::<[u64]>::from);
        if let Some(state) = initial {
            // What does not fit is reported when the state's steps are made for the search.
            let _ = explorer.expand(&state, &mut Vec::new());
        }
        if explorer.parts() != parts.len() || parts.len() < 2 {
            return Err(Unreduced::NoChoice);
        }
        let by = |touches: &dyn Fn(&Footprint, usize) -> bool| -> Vec<u64> {
            let of = |field| parts.iter().enumerate().filter(move |(_, part)| touches(part, field));
            (0..fields.len()).map(|field| of(field).fold(0, |bits, (part, _)| bits | 1 << part)).collect()
        };
        let mut reduction = Reduction {
            touched_by: by(&|part, field| part.looks[field] || part.writes[field]),
            written_by: by(&|part, field| part.writes[field]),
            located: locations.iter().map(Option::is_some).collect(),
            visible: visible.looks,
            inputs: explorer.are_inputs(&fields),
            looks: parts.iter().map(|part| part.looks.clone()).collect(),
            writes: parts.into_iter().map(|part| part.writes).collect(),
            candidates: Vec::new(),
            fields,
        };
        let keeps = |part: &usize| (0..reduction.fields.len()).any(|field| reduction.is_own(*part, field));
        reduction.candidates = (0..reduction.writes.len()).filter(keeps).collect();
        if reduction.candidates.is_empty() { Err(Unreduced::AllShared) } else { Ok(reduction) }
    }

    /// Whether a part may write a field that concerns no other part.
    fn is_own(&self, part: usize, field: usize) -> bool {
        self.located[field] && !self.visible[field] && self.writes[part][field] && self.touched_by[field] == 1 << part
    }

    /// Makes the necessary steps of a state; see [`Explorer::expand`].
    ///
    /// # Errors
    /// A successor does not fit.
    pub fn expand(&self, explorer: &mut Explorer, state: &[u64], out: &mut Vec<u64>) -> Result<Expansion, Widening> {
        let start = out.len();
        // The first move consumes the inputs that an initial state keeps, so all parts depend on each other.
        if explorer.keeps_inputs(state) {
            return explorer.expand(state, out);
        }
        // Steps that are not remembered by parts are made all at once.
        let known = explorer.parts() == self.looks.len();
        for part in self.candidates.iter().filter(|_| known) {
            match self.ample(explorer, *part, state, out) {
                Ok(Some(expansion)) => return Ok(expansion),
                Ok(None) => out.truncate(start),
                Err(widening) => return Err(widening),
            }
        }
        explorer.expand(state, out)
    }

    /// The steps of a part, if they suffice.
    fn ample(
        &self,
        explorer: &mut Explorer,
        part: usize,
        state: &[u64],
        out: &mut Vec<u64>,
    ) -> Result<Option<Expansion>, Widening> {
        let (start, mut expansion, mut own) = (out.len(), Expansion::default(), true);
        let mut one = One { state, looked: Vec::new() };
        let visited = explorer.expand_part(part, &mut one, &true, &mut |_, alternative, _| {
            own &= alternative.kind == AlternativeKind::Next && alternative.failed.is_empty();
            own &= alternative.overwrites.iter().all(|overwrite| self.writes_its_own(part, overwrite));
            let next = out.len();
            out.extend_from_slice(state);
            apply(alternative.overwrites, &mut out[next..]);
            if out[next..] == *state {
                out.truncate(next);
                expansion.stayed += 1;
            } else {
                expansion.moved += 1;
            }
            Ok(())
        });
        match visited {
            Ok(Some(_)) => {}
            // If the caller asked to stop, making all steps notices it, too.
            Ok(None) | Err(SetTrouble::Crowded | SetTrouble::Interrupted) => return Ok(None),
            Err(SetTrouble::Narrow(widening)) => return Err(widening),
            Err(SetTrouble::Failed(never)) => match never {},
        }
        own &= one.looked.iter().all(|bits| self.looks_at_what_stays(part, *bits));
        if !own || expansion.moved == 0 {
            return Ok(None);
        }
        let grows = |next: &[u64]| explorer.compare(next, state).is_gt();
        let ample = out[start..].chunks_exact(state.len()).all(grows);
        Ok(ample.then_some(expansion))
    }

    fn writes_its_own(&self, part: usize, overwrite: &Overwrite) -> bool {
        let first = self.fields.partition_point(|bits| bits.word < overwrite.word);
        let fields = (first..self.fields.len()).take_while(|field| self.fields[*field].word == overwrite.word);
        let mut touched = fields.filter(|field| {
            let Bits { shift, bits, .. } = self.fields[*field];
            overwrite.clear >> shift & ((1 << bits) - 1) != 0
        });
        touched.all(|field| {
            if self.inputs[field] {
                return true;
            }
            assert!(!self.located[field] || self.writes[part][field], "a part writes what its text does not");
            self.is_own(part, field)
        })
    }

    fn looks_at_what_stays(&self, part: usize, bits: Bits) -> bool {
        let Ok(field) = self.fields.binary_search(&bits) else { return false };
        let (looks, writes) = (self.looks[part][field], self.writes[part][field]);
        assert!(!self.located[field] || looks || writes, "a part looks at what its text does not");
        self.located[field] && self.written_by[field] & !(1 << part) == 0
    }
}

/// A set of one state or none, which records what is read.
struct One<'s> {
    state: &'s [u64],
    looked: Vec<Bits>,
}

/// Operations on it cannot fail.
enum Never {}

impl StateSets for One<'_> {
    type Set = bool;
    type Failure = Never;

    fn is_empty(&self, set: &bool) -> bool {
        !set
    }

    fn split(&mut self, set: &bool, field: Bits) -> Result<Vec<(u64, bool)>, Never> {
        self.looked.push(field);
        let code = self.state[field.word as usize] >> field.shift & ((1 << field.bits) - 1);
        Ok(if *set { vec![(code, true)] } else { Vec::new() })
    }

    fn union(&mut self, a: &bool, b: &bool) -> Result<bool, Never> {
        Ok(*a || *b)
    }

    fn minus(&mut self, a: &bool, b: &bool) -> Result<bool, Never> {
        Ok(*a && !*b)
    }

    fn member(&self, _: &bool) -> Box<[u64]> {
        self.state.into()
    }
}
