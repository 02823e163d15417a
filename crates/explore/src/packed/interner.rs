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

use crate::checkpoint::{Known, Refusal, Words, write_location, write_value, write_values};
use crate::packed::few::Dictionary;

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
    /// By location, its values where it has room for few.
    few: Vec<Dictionary>,
}

impl Tables {
    fn dictionary(&mut self, location: u32) -> &mut Dictionary {
        let index = location as usize;
        if self.few.len() <= index {
            self.few.resize_with(index + 1, Dictionary::default);
        }
        &mut self.few[index]
    }
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

    /// By location, how many values it has taken, where it has room for few.
    pub(crate) fn sizes(&self) -> Vec<usize> {
        let tables = self.tables.lock().unwrap_or_else(PoisonError::into_inner);
        tables.few.iter().map(Dictionary::len).collect()
    }

    /// Whether it holds nothing.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// All that it holds, as words of a checkpoint.
    pub fn keep(&self, words: &mut Vec<u64>) {
        let tables = self.tables.lock().unwrap_or_else(PoisonError::into_inner);
        write_values(words, &tables.values.items);
        words.push(tables.rests.items.len() as u64);
        for rest in &tables.rests.items {
            let Rest { locations, grown } = &**rest;
            words.push(locations.len() as u64);
            for (location, value) in locations {
                write_location(words, location);
                write_value(words, value);
            }
            words.push(grown.len() as u64);
            for Grown { domain, count, elements } in grown {
                words.extend([u64::from(domain.0), u64::from(*count)]);
                write_values(words, elements);
            }
        }
        words.push(tables.few.len() as u64);
        for dictionary in &tables.few {
            words.push(dictionary.numbers().len() as u64);
            words.extend(dictionary.numbers().iter().map(|number| u64::from(*number)));
        }
    }

    /// One that holds what was kept, with the same numbers.
    ///
    /// # Errors
    /// The words are none of an interner.
    pub fn again(words: &mut Words<'_>, known: Known<'_>) -> Result<Interner, Refusal> {
        let mut tables = Tables::default();
        for value in known.values(words)? {
            tables.values.number(&value);
        }
        let rests: Vec<Rest> = words.many(|words| {
            let locations = words.many(|words| Ok((known.location(words)?, known.value(words)?)))?;
            let grown = words.many(|words| {
                let (domain, count) = (known.domain(words)?, words.number()?);
                Ok(Grown { domain, count, elements: known.values(words)? })
            })?;
            Ok(Rest { locations, grown })
        })?;
        for rest in rests {
            tables.rests.number(&Arc::new(rest));
        }
        let few: Vec<Vec<u32>> = words.many(|words| words.many(|words| words.number()))?;
        for (location, numbers) in few.into_iter().enumerate() {
            let dictionary = tables.dictionary(location as u32);
            numbers.into_iter().for_each(|number| _ = dictionary.add(number));
        }
        let count = tables.values.items.len();
        match tables.few.iter().flat_map(Dictionary::numbers).all(|number| (*number as usize) < count) {
            true => Ok(Interner { tables: Mutex::new(tables) }),
            false => Err(Refusal::Damaged),
        }
    }
}

/// One explorer's view.
#[derive(Debug)]
pub(crate) struct View {
    shared: Arc<Interner>,
    seen: Tables,
    /// The numbers of the integers from 0 on, the most frequent values.
    near: Box<[u32; NEAR]>,
}

/// LIMIT: integers below this one are found by place.
const NEAR: usize = 1 << 10;
/// Such an integer has no number.
const NONE: u32 = u32::MAX;

impl View {
    pub fn new(shared: Arc<Interner>) -> View {
        View { shared, seen: Tables::default(), near: Box::new([NONE; NEAR]) }
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
    #[inline]
    pub fn number(&mut self, value: &Value) -> u32 {
        let near = match value {
            Value::Integer(integer) => usize::try_from(*integer).ok().filter(|place| *place < NEAR),
            _ => None,
        };
        let Some(place) = near else { return self.number_by_hash(value) };
        if self.near[place] == NONE {
            self.near[place] = self.number_by_hash(value);
        }
        self.near[place]
    }

    fn number_by_hash(&mut self, value: &Value) -> u32 {
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

    /// The code of a value of a location that has room for few; none where there is no room for it.
    #[inline]
    pub fn few_code(&mut self, location: u32, bits: u8, value: &Value) -> Option<u64> {
        let number = self.number(value);
        let known = self.seen.few.get(location as usize).and_then(|dictionary| dictionary.code(number));
        let code = match known {
            Some(code) => code,
            None => self.new_few_code(location, bits, number)?,
        };
        Some(u64::from(code))
    }

    #[cold]
    fn new_few_code(&mut self, location: u32, bits: u8, number: u32) -> Option<u32> {
        let mut shared = self.shared.tables.lock().unwrap_or_else(PoisonError::into_inner);
        let code = shared.dictionary(location).code_within(number, bits)?;
        self.seen.dictionary(location).renew(shared.dictionary(location));
        Some(code)
    }

    /// The value of such a code.
    pub fn few_value(&mut self, location: u32, code: u64) -> &Value {
        let known = self.seen.few.get(location as usize).and_then(|dictionary| dictionary.number(code));
        let number = match known {
            Some(number) => number,
            None => {
                let mut shared = self.shared.tables.lock().unwrap_or_else(PoisonError::into_inner);
                let mine = self.seen.dictionary(location);
                mine.renew(shared.dictionary(location));
                mine.number(code).expect("a code that was given to a value")
            }
        };
        self.value(number)
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
