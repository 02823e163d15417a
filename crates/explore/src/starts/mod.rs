//! The initial states of a program: made one after the other, twice, and kept packed.
//!
//! In: a machine, alternatives of inputs and choices. The first time tells which values locations take, which the packing depends on;
//! the second time each is packed. Out: [`Starts`]: a few words for each, since there may be a great many. What one took from
//! outside is told by making it once more. INVARIANT: they come in the order of their alternatives, whoever makes them.

pub(crate) mod origin;

use std::collections::{BTreeMap, BTreeSet};
use std::ops::ControlFlow;
use std::sync::Arc;

use machine::inside::Store;
use machine::{Fault, FaultKind, Interrupt, Location, Machine, Snapshot, Value};

use crate::alternatives::branches::Branches;
use crate::settings::Trouble;
use crate::starts::origin::Origins;

/// Of so many the answers that lead to one are kept.
const MARK: usize = 64;
/// LIMIT: so many different values of a location are told apart; a domain with more counts as infinite.
const VALUES: usize = 1 << 12;

/// The number of an initial state, in the order of alternatives.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Start(u32);

/// What there is in any of the initial states.
#[derive(Debug)]
pub(crate) struct Seen {
    /// The values of locations: each that a location has in some of the states is in some row.
    pub rows: Vec<Vec<Value>>,
    /// Each input that was asked for, with a value, and with undef if it was that.
    pub asked: Vec<(Location, Value)>,
    /// The states that initial values which come up later are evaluated in.
    pub origins: Arc<Vec<Store>>,
}

/// All initial states.
#[derive(Debug)]
pub struct Starts {
    /// The words of the states, one after the other; one may come up several times.
    words: Vec<u64>,
    /// How many words each has.
    width: usize,
    /// Their numbers, where some were left out.
    numbers: Option<Vec<Start>>,
    /// The answers that lead to each of them whose number is a multiple of [`MARK`].
    marks: Vec<Box<[u32]>>,
    pub(crate) seen: Arc<Seen>,
}

impl Starts {
    /// None yet of states of so many words.
    pub(crate) fn new(seen: Arc<Seen>, width: usize) -> Starts {
        Starts { words: Vec::new(), width, numbers: None, marks: Vec::new(), seen }
    }

    /// Adds the state that these answers lead to.
    pub(crate) fn push(&mut self, words: &[u64], branches: &Branches) {
        if self.len().is_multiple_of(MARK) {
            self.marks.push(branches.answers().iter().map(|asked| asked.taken).collect());
        }
        self.words.extend_from_slice(words);
    }

    /// All are there: gives back the room for more.
    pub(crate) fn close(&mut self) {
        self.words.shrink_to_fit();
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.words.len() / self.width
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.words.is_empty()
    }

    /// The states and their numbers.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (&[u64], Start)> {
        let number = |at: usize| self.numbers.as_ref().map_or(Start(at as u32), |numbers| numbers[at]);
        self.words.chunks_exact(self.width).enumerate().map(move |(at, state)| (state, number(at)))
    }

    /// The first of the states.
    pub fn first(&self) -> Option<&[u64]> {
        self.words.get(..self.width)
    }

    /// The words of the states, one after the other.
    pub fn words(&self) -> &[u64] {
        &self.words
    }

    /// Leaves out those that are not to stay.
    pub(crate) fn retain(&mut self, stays: &[bool]) {
        let stay: Vec<(&[u64], Start)> =
            self.iter().zip(stays).filter(|(_, stays)| **stays).map(|(one, _)| one).collect();
        let numbers = stay.iter().map(|(_, start)| *start).collect();
        let words = stay.iter().flat_map(|(state, _)| *state).copied().collect();
        (self.words, self.numbers) = (words, Some(numbers));
    }

    /// The answers that lead to a start before this one or to itself, and how many starts after that it comes.
    pub(crate) fn way_to(&self, start: Start) -> (&[u32], usize) {
        let number = start.0 as usize;
        (&self.marks[number / MARK], number % MARK)
    }
}

/// Initial states as they are made for the first time.
#[derive(Debug, Default)]
pub(crate) struct Begun {
    columns: Columns,
    /// By location, and whether it was undef.
    asked: BTreeMap<(Location, bool), Value>,
    origins: Origins,
}

impl Begun {
    /// Adds the one that the machine was started in.
    pub fn add(&mut self, machine: &Machine) {
        let values = machine.store().values();
        let changed = machine.changed_by_start();
        match changed {
            Some((locations, _)) => {
                locations.iter().for_each(|location| self.columns.add(*location as usize, &values[*location as usize]));
            }
            None => self.columns.add_all(values),
        }
        for (location, value) in machine.inputs_from(changed.map_or(0, |(_, same)| same)) {
            self.asked.entry((location, value.is_undef())).or_insert(value);
        }
        self.origins.number(machine);
    }

    /// What there is in any of them.
    pub fn seen(self) -> Seen {
        let asked = self.asked.into_iter().map(|((location, _), value)| (location, value)).collect();
        Seen { rows: self.columns.rows(), asked, origins: self.origins.stores() }
    }
}

/// By location the values that it has in some state.
#[derive(Debug, Default)]
struct Columns {
    first: Vec<Value>,
    others: Vec<BTreeSet<Value>>,
}

impl Columns {
    /// Adds those of a state.
    fn add_all(&mut self, values: &[Value]) {
        if self.others.is_empty() {
            self.first = values.to_vec();
            self.others = vec![BTreeSet::new(); values.len()];
        }
        values.iter().enumerate().for_each(|(location, value)| self.add(location, value));
    }

    /// Adds the value of a location.
    fn add(&mut self, location: usize, value: &Value) {
        let (Some(first), Some(others)) = (self.first.get(location), self.others.get_mut(location)) else { return };
        if value != first && (others.len() < VALUES || value.is_undef()) {
            others.insert(value.clone());
        }
    }

    /// As states that together have them all.
    fn rows(self) -> Vec<Vec<Value>> {
        let count = self.others.iter().map(BTreeSet::len).max().unwrap_or(0);
        let mut rows = vec![self.first; count + 1];
        for (location, values) in self.others.into_iter().enumerate() {
            values.into_iter().zip(&mut rows[1..]).for_each(|(value, row)| row[location] = value);
        }
        rows
    }
}

/// What is done in an initial state; whether the others are gone through, too.
pub(crate) type Visit<'v> = dyn FnMut(&mut Machine, &mut Branches) -> Result<ControlFlow<()>, Trouble> + 'v;

/// Starts a machine in one initial state after the other, from the one that the answers lead to which `branches` have.
pub(crate) fn each_start(
    machine: &mut Machine,
    blank: &Snapshot,
    branches: &mut Branches,
    interrupt: &Interrupt,
    visit: &mut Visit<'_>,
) -> Result<(), Trouble> {
    let mut outcome = machine.start_from(blank, branches);
    let ended = loop {
        if let Some(cause) = interrupt.cause() {
            break Err(Trouble::Interrupted(cause));
        }
        if let Err(fault) = outcome {
            break Err(trouble(fault, branches));
        }
        match visit(machine, branches) {
            Ok(ControlFlow::Continue(())) if branches.next() => {}
            Ok(_) => break Ok(()),
            Err(trouble) => break Err(trouble),
        }
        outcome = machine.start_again(blank, branches.kept(), branches);
    };
    machine.end_starts();
    ended
}

/// Why a start was not made.
fn trouble(fault: Fault, branches: &mut Branches) -> Trouble {
    if let FaultKind::Interrupted(cause) = fault.kind {
        return Trouble::Interrupted(cause);
    }
    branches.note_limit(&fault);
    match branches.unbounded {
        Some(unbounded) => Trouble::Unbounded(unbounded),
        None => Trouble::Fault(Box::new(fault)),
    }
}
