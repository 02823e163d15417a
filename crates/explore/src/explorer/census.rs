//! How many bits the values of each location need, as far as a search has come.
//!
//! In: states that it has found, and those on a walk from the last of them. Out: [`Rooms`] for locations that take few values
//! ([`crate::packed::few`]), more of it where that did not suffice, and the states as they are with that room. INVARIANT: a search
//! that needs more room has come twice as far as the last time, or the room of all locations grows, and at last all fields are full again; so
//! states are packed anew a few times at most.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::explorer::Explorer;
use crate::explorer::sighting::Met;
use crate::packed::codes::{Codes, bits_of};
use crate::packed::encoding::Encoding;
use crate::packed::widening::{Rooms, Widening};
use crate::packed::words::{Field, NOWHERE};

/// LIMIT: with more values a location has a full field.
const MANY: usize = 1 << 16;
/// LIMIT: the states of a walk.
const WALK: usize = 1 << 12;
/// LIMIT: how often all room may grow.
const HURRIES: u8 = 4;

/// Two explorers have other fields.
#[derive(Debug)]
pub struct Unlike;

impl Explorer {
    /// The room that locations need in these states and others; none if states would hardly become shorter. Afterwards the explorer has
    /// made steps that no search asked for.
    pub fn census<'s>(&mut self, states: impl Iterator<Item = &'s [u64]>) -> Option<Rooms> {
        let mut met = Met::default();
        self.initial().iter().for_each(|(state, _)| self.meet(state, &mut met));
        let mut last = None;
        states.for_each(|state| {
            self.meet(state, &mut met);
            last = Some(state);
        });
        let rooms = self.rooms(&met);
        let bits = |field: &Field| rooms.0.get(&field.location).copied().unwrap_or(field.bits);
        let needed: usize = self.encoding.fields.iter().map(|field| usize::from(bits(field))).sum();
        // What was learned of steps is learned anew.
        if needed.div_ceil(64) * 4 > self.words() * 3 {
            return None;
        }
        self.walk(last?, &mut met);
        Some(self.rooms(&met))
    }

    /// Meets the states of a walk: what comes up later in a run is told sooner by it than by all states up to some distance.
    fn walk(&mut self, from: &[u64], met: &mut Met) {
        let (mut state, mut successors, mut random) = (from.to_vec(), Vec::new(), 1u64);
        for _ in 0..WALK {
            successors.clear();
            if self.expand(&state, &mut successors).is_err() {
                return;
            }
            let count = successors.len() / state.len();
            random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            match successors.chunks_exact(state.len()).nth((random >> 33) as usize % count.max(1)) {
                Some(next) => state.copy_from_slice(next),
                None => state.copy_from_slice(from),
            }
            self.meet(&state, met);
        }
    }

    fn rooms(&self, met: &Met) -> Rooms {
        let mut rooms = BTreeMap::new();
        for (index, (field, codes)) in (0..).zip(self.encoding.fields.iter().zip(&met.codes)) {
            if field.location == NOWHERE || self.encoding.kept.fields.contains(&index) {
                continue;
            }
            let narrower = match &self.encoding.codes[field.function.0 as usize] {
                // Their codes need no dictionary unless they need no bits either.
                Some(Codes::Listed { .. }) => codes.len() == 1 && field.bits > 0,
                Some(Codes::Interned) => codes.len() <= MANY,
                Some(Codes::InPlace(_)) | None => false,
            };
            if narrower {
                let spare = u8::from(codes.len() > 1) + u8::from(codes.len() > 4);
                rooms.insert(field.location, bits_of(codes.len()) + spare);
            }
        }
        Rooms(rooms)
    }

    /// Packs states of a search as this explorer packs them, if it has the same fields as that search's, with the same interner.
    ///
    /// # Errors
    /// It has others.
    pub fn mover(&self, from: &Explorer) -> Result<Mover, Unlike> {
        let (old, new) = (Arc::clone(&from.encoding), Arc::clone(&self.encoding));
        let place = |field: &Field| (field.location, field.function);
        let alike = Arc::ptr_eq(from.view.shared(), self.view.shared())
            && old.constant_rest == new.constant_rest
            && (old.rest, old.origin) == (new.rest, new.origin)
            && old.kept == new.kept
            && old.fields.iter().map(place).eq(new.fields.iter().map(place));
        if !alike {
            return Err(Unlike);
        }
        let mut by_word: Vec<Vec<usize>> = vec![Vec::new(); old.words];
        for (index, field) in old.fields.iter().enumerate().filter(|(_, field)| field.bits > 0) {
            by_word[field.word as usize].push(index);
        }
        let known = vec![Vec::new(); old.fields.len()];
        Ok(Mover { next: vec![0; new.words], last: Vec::new(), by_word, known, old, new })
    }

    /// More room, for locations that have outgrown theirs above all. The search is in a hurry if it has not come far since the
    /// last time, so many times by now.
    pub fn more_room(&mut self, narrow: &[&Widening], hurries: u8) -> Rooms {
        let mut rooms = BTreeMap::new();
        if hurries > HURRIES {
            return Rooms(rooms);
        }
        let sizes = self.view.shared().sizes();
        let is_outgrown = |field: &Field| narrow.iter().any(|narrow| narrow.outgrown.contains(&field.location));
        let outgrown = self.encoding.fields.iter().filter(|field| field.few && is_outgrown(field));
        let functions: Vec<_> = outgrown.map(|field| field.function).collect();
        for field in self.encoding.fields.iter().filter(|field| field.few) {
            let size = sizes.get(field.location as usize).copied().unwrap_or(0);
            let more = match (is_outgrown(field), size) {
                (true, _) => 2,
                // What holds for one argument of a function often holds for others, too.
                (false, ..=1) => u8::from(functions.contains(&field.function)) + hurries / 2,
                (false, _) => u8::from(bits_of(size) == field.bits) + hurries,
            };
            let full = match &self.encoding.codes[field.function.0 as usize] {
                Some(Codes::Listed { values, undefined }) => bits_of(values.len() + usize::from(*undefined)),
                _ => bits_of(MANY) + 1,
            };
            if field.bits + more < full {
                rooms.insert(field.location, field.bits + more);
            }
        }
        Rooms(rooms)
    }
}

/// How the states of one search become those of another ([`Explorer::mover`]). States that come one after the other
/// should differ little.
#[derive(Debug)]
pub struct Mover {
    old: Arc<Encoding>,
    new: Arc<Encoding>,
    /// By word of an old state, the fields in it.
    by_word: Vec<Vec<usize>>,
    /// By field and old code, the new code of the same value.
    known: Vec<Vec<u64>>,
    /// The old state that came last; empty before the first.
    last: Vec<u64>,
    next: Vec<u64>,
}

/// LIMIT: larger codes are looked up anew each time.
const NEAR: u64 = 1 << 12;
/// A code that is not known yet.
const UNKNOWN: u64 = u64::MAX;

impl Mover {
    /// A state as `explorer`, which the mover is of, packs it.
    ///
    /// # Errors
    /// A field of that explorer has no room for a value.
    pub fn state(&mut self, explorer: &mut Explorer, state: &[u64]) -> Result<&[u64], Unlike> {
        if self.last.is_empty() {
            for index in 0..self.old.fields.len() {
                self.field(explorer, index, state)?;
            }
            self.last.extend_from_slice(state);
        }
        for word in 0..self.by_word.len() {
            let differs = self.last[word] ^ state[word];
            if differs == 0 {
                continue;
            }
            for place in 0..self.by_word[word].len() {
                let index = self.by_word[word][place];
                if self.old.fields[index].mask() & differs != 0 {
                    self.field(explorer, index, state)?;
                }
            }
            self.last[word] = state[word];
        }
        Ok(&self.next)
    }

    fn field(&mut self, explorer: &mut Explorer, index: usize, state: &[u64]) -> Result<(), Unlike> {
        let Mover { old, new, known, next, .. } = self;
        let (from, to) = (old.fields[index], new.fields[index]);
        let code = from.code(state);
        let same = from.location == NOWHERE
            || from.few == to.few && old.codes[from.function.0 as usize] == new.codes[from.function.0 as usize];
        let code = match known[index].get(code as usize) {
            _ if same => code,
            Some(&code) if code != UNKNOWN => code,
            _ => {
                let value = old.value(from, state, &mut explorer.view);
                let moved = new.code(to, &value, &mut explorer.view).map_err(|_| Unlike)?;
                if code < NEAR {
                    let known = &mut known[index];
                    known.resize(known.len().max(code as usize + 1), UNKNOWN);
                    known[code as usize] = moved;
                }
                moved
            }
        };
        to.put(code, next);
        Ok(())
    }
}
