//! What one machine keeps while it runs compiled code.
//!
//! In: what the code refers to, which is the same for all machines. Out: the data that the code and its helpers change: tables as far as they are
//! filled, and what is open in the running step.

use std::hash::{Hash, Hasher};
use std::sync::Arc;

use program::CollectionKind;
use rustc_hash::FxHasher;

use crate::memo::Version;
use crate::native::numbered::Numbered;
use crate::update::{Sequence, Unit};
use crate::value::Value;

/// See the module.
#[derive(Debug)]
pub(super) struct Memory {
    pub numbered: Arc<Numbered>,
    /// By fixed term.
    tables: Vec<Table>,
    /// By fixed term: the addresses of its states and of its values, as compiled code reads them.
    places: Vec<[u64; 2]>,
    /// Values that a term needs while it is evaluated.
    pub temporaries: Vec<Value>,
    /// Candidates of choices that are being collected.
    pub candidates: Vec<Value>,
    /// Items of collections that are not made: room for scalars, its length 0.
    pub items: Vec<Value>,
    /// Units and sequences open now.
    pub units: Vec<Unit>,
    pub sequences: Vec<(Sequence, Version)>,
    /// Comprehensions whose elements are being collected, the innermost last.
    pub collections: Vec<Collected>,
    /// Small collections that were made lately, by a hash of their items: what is made again is the same value.
    lately: Box<[Value]>,
}

/// LIMIT: so many collections are found again, of at most so many items.
const LATELY: usize = 256;
const SMALL: usize = 8;

/// The values of a fixed term, as far as they were asked for. INVARIANT: its arrays stay where they are.
#[derive(Debug)]
struct Table {
    /// By entry: 1 where it has been evaluated.
    states: Box<[u8]>,
    values: Box<[Value]>,
}

/// What stands where a small collection may have been put.
#[derive(Debug)]
pub(super) enum Lately<'m> {
    /// The collection.
    Made(&'m Value),
    /// Something else, which it is to replace.
    Free(&'m mut Value),
}

/// The elements of a comprehension so far.
#[derive(Debug, Default)]
pub(super) struct Collected {
    pub elements: Vec<Value>,
    /// Their size, unfolded.
    pub leaves: u64,
}

impl Memory {
    /// That of a machine that has not run the code.
    pub fn new(numbered: Arc<Numbered>) -> Memory {
        let table = |entries: usize| Table {
            states: vec![0; entries].into_boxed_slice(),
            values: vec![Value::Undef; entries].into_boxed_slice(),
        };
        let mut tables: Vec<Table> = numbered.fixed.iter().map(|fixed| table(fixed.entries)).collect();
        let place = |table: &mut Table| {
            [table.states.as_mut_ptr().expose_provenance() as u64, table.values.as_mut_ptr().expose_provenance() as u64]
        };
        let places = tables.iter_mut().map(place).collect();
        Memory {
            numbered,
            tables,
            places,
            temporaries: Vec::new(),
            candidates: Vec::new(),
            items: Vec::new(),
            units: Vec::new(),
            sequences: Vec::new(),
            collections: Vec::new(),
            lately: vec![Value::Undef; LATELY].into_boxed_slice(),
        }
    }

    /// Where the tables are.
    pub fn places(&self) -> *const [u64; 2] {
        self.places.as_ptr()
    }

    /// Fills an entry of a table.
    pub fn fill(&mut self, table: usize, entry: usize, value: Value) {
        let table = &mut self.tables[table];
        table.values[entry] = value;
        table.states[entry] = 1;
    }

    /// Where a collection of these items stands if it was made lately, or is to be put when it is made.
    pub fn lately(&mut self, kind: CollectionKind, items: &[Value]) -> Option<Lately<'_>> {
        if items.len() > SMALL {
            return None;
        }
        let mut hasher = FxHasher::default();
        (kind as u8).hash(&mut hasher);
        items.iter().for_each(|item| item.hash(&mut hasher));
        let place = &mut self.lately[(hasher.finish() >> 32) as usize % LATELY];
        let same = match (&*place, kind) {
            (Value::Seq(made), CollectionKind::Seq) | (Value::Set(made), CollectionKind::Set) => made[..] == *items,
            _ => false,
        };
        Some(if same { Lately::Made(place) } else { Lately::Free(place) })
    }

    /// Forgets what an abandoned step left.
    pub fn clear(&mut self) {
        self.units.clear();
        self.sequences.clear();
        self.collections.clear();
    }
}
