//! Values without a bound, each kept once and named by a number.
//!
//! Shared by all explorers of one search, so that equal values have equal numbers everywhere; each explorer keeps a copy
//! of what it has seen of it. INVARIANT: two values, or two rests, are equal exactly when their numbers are. The numbers
//! depend on who came first and never reach output.

use std::sync::{Arc, Mutex, PoisonError};

use hashbrown::HashMap;
use machine::inside::Grown;
use machine::{Location, Value};
use rustc_hash::FxBuildHasher;

/// What a state has beyond its fields: locations that come up as a run goes on, and the elements of domains that grow.
#[derive(Debug, Clone, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct Rest {
    /// In canonical order; one that is undef stands here where it was made so.
    pub locations: Vec<(Location, Value)>,
    /// The domains whose elements differ from those that they are declared with.
    pub grown: Vec<Grown>,
}

#[derive(Debug)]
struct Table<T> {
    numbers: HashMap<T, u32, FxBuildHasher>,
    items: Vec<T>,
}

impl<T> Default for Table<T> {
    fn default() -> Self {
        Table { numbers: HashMap::default(), items: Vec::new() }
    }
}

impl<T: Clone + Eq + std::hash::Hash> Table<T> {
    fn number(&mut self, item: &T) -> u32 {
        if let Some(number) = self.numbers.get(item) {
            return *number;
        }
        let number = self.items.len() as u32;
        self.numbers.insert(item.clone(), number);
        self.items.push(item.clone());
        number
    }
}

#[derive(Debug, Default)]
struct Tables {
    values: Table<Value>,
    rests: Table<Arc<Rest>>,
}

/// See the module.
#[derive(Debug, Default)]
pub struct Interner {
    tables: Mutex<Tables>,
}

impl Interner {
    /// How many values and rests it holds.
    pub fn len(&self) -> usize {
        let tables = self.tables.lock().unwrap_or_else(PoisonError::into_inner);
        tables.values.items.len() + tables.rests.items.len()
    }

    /// Whether it holds nothing.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// One explorer's view.
#[derive(Debug)]
pub(crate) struct View {
    shared: Arc<Interner>,
    seen: Tables,
}

impl View {
    pub fn new(shared: Arc<Interner>) -> View {
        View { shared, seen: Tables::default() }
    }

    /// What it is a view of.
    pub fn shared(&self) -> &Arc<Interner> {
        &self.shared
    }

    fn renew(&mut self) {
        let shared = self.shared.tables.lock().unwrap_or_else(PoisonError::into_inner);
        for value in &shared.values.items[self.seen.values.items.len()..] {
            self.seen.values.number(value);
        }
        for rest in &shared.rests.items[self.seen.rests.items.len()..] {
            self.seen.rests.number(rest);
        }
    }

    /// The number of a value.
    pub fn number(&mut self, value: &Value) -> u32 {
        if let Some(number) = self.seen.values.numbers.get(value) {
            return *number;
        }
        let number = self.shared.tables.lock().unwrap_or_else(PoisonError::into_inner).values.number(value);
        self.renew();
        number
    }

    /// The value of a number.
    pub fn value(&mut self, number: u32) -> &Value {
        if number as usize >= self.seen.values.items.len() {
            self.renew();
        }
        &self.seen.values.items[number as usize]
    }

    /// The number of a rest.
    pub fn rest_number(&mut self, rest: &Arc<Rest>) -> u32 {
        if let Some(number) = self.seen.rests.numbers.get(rest) {
            return *number;
        }
        let number = self.shared.tables.lock().unwrap_or_else(PoisonError::into_inner).rests.number(rest);
        self.renew();
        number
    }

    /// The rest of a number.
    pub fn rest(&mut self, number: u32) -> Arc<Rest> {
        if number as usize >= self.seen.rests.items.len() {
            self.renew();
        }
        Arc::clone(&self.seen.rests.items[number as usize])
    }
}
