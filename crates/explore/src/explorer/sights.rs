//! What happens in the steps of an explorer for the first time, and which values its states have.
//!
//! In: the steps that its machine makes, states. Out: [`Sighting`]s with the answers that lead to them, [`Met`] values by
//! location. Steps that are remembered are those of some step that the machine made, so they show nothing new. An
//! alternative that is dead or that an assumption leaves out does not count.

use std::collections::{BTreeMap, BTreeSet};

use machine::inside::is_kept;
use machine::{Fault, Location, Observation, Value};
use rustc_hash::FxHashSet;

use crate::alternatives::kind::AlternativeKind;
use crate::explorer::Explorer;
use crate::explorer::sighting::{Met, Sighting};
use crate::packed::kept::is_input;
use crate::packed::words::NOWHERE;

impl Explorer {
    /// Notes what the step at hand showed.
    pub(super) fn sight(&mut self, kind: AlternativeKind) {
        let Some(observations) = self.machine.watched() else { return };
        let seen = observations.take();
        if seen.is_empty() {
            return;
        }
        let made = kind == AlternativeKind::Next;
        if kind == AlternativeKind::Excluded || kind == AlternativeKind::Unbounded {
            return;
        }
        let picks: Vec<u32> = self.branches.answers().iter().map(|asked| asked.taken).collect();
        for observation in seen {
            let is_new = if made { observations.learn(observation) } else { self.in_faults.insert(observation) };
            if is_new {
                self.sightings.push(Sighting { observation, picks: picks.clone(), made });
            }
        }
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
