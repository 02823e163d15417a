//! What happens in the steps of an explorer for the first time, and which values its states have.
//!
//! In: the steps that its machine makes, states. Out: [`Sighting`]s with the answers that lead to them, [`Met`] values by
//! location. Steps that are remembered are those of some step that the machine made, so they show nothing new. An
//! alternative that an assumption leaves out does not count; of one that is dead, what its guard reads does.

use std::collections::{BTreeMap, BTreeSet};

use machine::inside::is_kept;
use machine::{Fault, Location, Observation, Value};
use rustc_hash::FxHashSet;

use crate::alternatives::kind::AlternativeKind;
use crate::explorer::Explorer;
use crate::explorer::sighting::{Met, Refusals, Sighting};
use crate::packed::kept::is_input;
use crate::packed::words::NOWHERE;

impl Explorer {
    /// Notes what the step at hand showed.
    pub(super) fn sight(&mut self, kind: AlternativeKind) {
        let Some(observations) = self.machine.watched() else { return };
        let seen = observations.take();
        let made = kind == AlternativeKind::Next;
        if kind == AlternativeKind::Excluded || kind == AlternativeKind::Unbounded {
            return;
        }
        let picks: Vec<u32> = self.branches.answers().iter().map(|asked| asked.taken).collect();
        if made {
            self.refusals.made.push(picks.clone());
        }
        for observation in seen {
            let is_new = if made { observations.learn(observation) } else { self.in_faults.insert(observation) };
            if is_new {
                self.sightings.push(Sighting { observation, picks: picks.clone(), made });
            }
        }
    }

    /// Notes what the guard of a candidate read that was refused.
    pub(super) fn note_refusal(&mut self) {
        let Some(observations) = self.machine.watched() else { return };
        let mut read = observations.take();
        read.retain(|observation| matches!(observation, Observation::Read(..)));
        let picks = self.branches.answers().iter().map(|asked| asked.taken).collect();
        self.refusals.refused.push((picks, read));
    }

    /// What guards of refused candidates read belongs to a step that takes another one.
    pub(super) fn sight_refusals(&mut self) {
        let Some(observations) = self.machine.watched() else { return };
        let Refusals { refused, made, unmade } = &mut self.refusals;
        for (picks, read) in refused.drain(..) {
            let step = made.iter().find(|made| Refusals::is_of(&picks, made));
            *unmade |= step.is_none() && !read.is_empty();
            for (observation, picks) in read.into_iter().zip(step.into_iter().cycle()) {
                if observations.learn(observation) {
                    self.sightings.push(Sighting { observation, picks: picks.clone(), made: true });
                }
            }
        }
    }

    /// Whether a guard read something, in the states expanded so far, in no step that can be made.
    pub fn reads_in_no_step(&self) -> bool {
        self.refusals.unmade
    }

    /// The answers that lead to the candidates that were refused among the paths that were gone through last.
    pub fn refused(&mut self) -> Vec<Vec<u32>> {
        self.refusals.refused.drain(..).map(|(picks, _)| picks).collect()
    }

    /// What the guards of refused candidates read in some of the steps with these answers.
    pub fn read_by_refused(
        &mut self,
        state: &[u64],
        refused: &[Vec<u32>],
        steps: &[Vec<u32>],
    ) -> Vec<(Observation, Vec<u32>)> {
        let mut found = Vec::new();
        for picks in refused {
            let Some(step) = steps.iter().find(|step| Refusals::is_of(picks, step)) else { continue };
            let seen = self.observe(state, picks).into_iter();
            let read = seen.filter(|observation| matches!(observation, Observation::Read(..)));
            found.extend(read.map(|observation| (observation, step.clone())));
        }
        found
    }

    /// What has happened for the first time since this was last asked.
    pub fn sightings(&mut self) -> Vec<Sighting> {
        std::mem::take(&mut self.sightings)
    }

    /// All that happens in one step.
    pub fn observe(&mut self, state: &[u64], picks: &[u32]) -> Vec<Observation> {
        let former = self.machine.watch(Some(Box::default()));
        self.load(state);
        self.branches.follow(picks);
        self.begin_watching();
        let _ = self.machine.prepare(&mut self.branches);
        self.machine.discard();
        let observations = self.machine.watch(former);
        observations.map(|mut observations| observations.take()).unwrap_or_default()
    }

    /// Whether observations name a location by its number.
    pub fn is_numbered(&self, location: &Location) -> bool {
        let store = self.machine.store();
        let found = store.find(location.function, &location.arguments);
        found.is_some_and(|index| store.is_lasting(index))
    }

    /// The location of a number that an observation names.
    pub fn location(&self, index: u32) -> Location {
        self.machine.store().location(index)
    }

    /// The elements of a domain, as far as they are the same in all states and no more than `most`.
    pub fn elements(&mut self, domain: program::DomainId, most: usize) -> Option<Vec<Value>> {
        if !self.encoding.constant[domain.0 as usize] || !self.program.is_listable(domain) {
            return None;
        }
        let elements = self.machine.elements(domain).ok()?;
        (elements.len() <= most).then_some(elements)
    }

    /// Notes the values that a state has.
    pub fn meet(&self, state: &[u64], met: &mut Met) {
        let fields = &self.encoding.fields;
        if met.codes.is_empty() {
            met.codes = vec![FxHashSet::default(); fields.len()];
            met.last = state.iter().map(|word| !word).collect();
        }
        for (field, codes) in fields.iter().zip(&mut met.codes) {
            let word = field.word as usize;
            if (met.last[word] ^ state[word]) & field.mask() != 0 || field.bits == 0 {
                codes.insert(field.code(state));
            }
        }
        met.last.copy_from_slice(state);
    }

    /// The values met, by location.
    pub fn values_met(&mut self, met: &Met) -> BTreeMap<Location, BTreeSet<Value>> {
        let mut values: BTreeMap<Location, BTreeSet<Value>> = BTreeMap::new();
        let Explorer { encoding, machine, view, program, .. } = self;
        for (index, codes) in met.codes.iter().enumerate() {
            let field = encoding.fields[index];
            let mut codes: Vec<u64> = codes.iter().copied().collect();
            codes.sort_unstable();
            for code in codes {
                if encoding.origin == Some(index as u32) || encoding.kept.fields.contains(&(index as u32)) {
                    continue;
                }
                if encoding.rest == Some(index as u32) {
                    let rest = view.rest(code as u32);
                    for (location, value) in rest.locations.iter().filter(|one| !is_input(program, &one.0)) {
                        values.entry(location.clone()).or_default().insert(value.clone());
                    }
                    continue;
                }
                let mut words = vec![0; encoding.words];
                field.put(code, &mut words);
                let value = encoding.value(field, &words, view);
                values.entry(machine.store().location(field.location)).or_default().insert(value);
            }
        }
        if encoding.rest.is_none() {
            for (location, value) in &encoding.constant_rest.locations {
                values.entry(location.clone()).or_default().insert(value.clone());
            }
        }
        // What no step changes, and is the same in all initial states, is no part of states.
        let store = machine.store();
        for (index, _) in (0..).zip(encoding.of_location.iter()).filter(|(_, place)| **place == NOWHERE) {
            let location = store.location(index);
            if is_kept(program, location.function) {
                values.entry(location).or_default().insert(store.value(index).clone());
            }
        }
        values
    }

    pub(super) fn begin_watching(&mut self) {
        if let Some(observations) = self.machine.watched() {
            observations.begin();
        }
    }

    /// Ends it; gives the first clash of a step that has gone on after it.
    pub(super) fn end_watching(&mut self) -> Option<Box<Fault>> {
        self.machine.watched()?.end()
    }
}
