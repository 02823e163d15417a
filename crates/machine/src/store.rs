//! The current state: a value for each location, and the carriers of the dynamic domains.
//!
//! Locations have numbers ([`crate::layout`]), so reading a value looks up no name. INVARIANT: between steps, a location's
//! entry is its value in the state. Within a `seq`, it is the value in the intermediate state, and the log in
//! [`crate::update`] can restore the other.

use std::ops::Range;
use std::sync::Arc;

use hashbrown::HashMap;
use program::{DomainId, FunctionId, Program};
use rustc_hash::FxBuildHasher;

use crate::layout::{Extents, Layout, LocationIndex, lay_out};
use crate::location::{Location, LocationRef};
use crate::value::Value;

/// The elements of a dynamic domain.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Carrier {
    /// Abstract: how many elements the state has.
    pub count: u32,
    /// Abstract: the number that the next fresh element gets.
    pub fresh: u32,
    /// Concrete and dynamic: its elements, sorted.
    pub elements: Vec<Value>,
    /// Elements that only the intermediate state of a running `seq` has, beyond those.
    pub intermediate: Vec<Value>,
}

impl Clone for Carrier {
    fn clone(&self) -> Carrier {
        let Carrier { count, fresh, elements, intermediate } = self;
        Carrier { count: *count, fresh: *fresh, elements: elements.clone(), intermediate: intermediate.clone() }
    }

    fn clone_from(&mut self, other: &Carrier) {
        (self.count, self.fresh) = (other.count, other.fresh);
        self.elements.clone_from(&other.elements);
        self.intermediate.clone_from(&other.intermediate);
    }
}

/// The values of a state by the numbers of its locations, and what belongs to them.
#[derive(Debug)]
pub struct Store {
    /// The value of each location.
    pub(crate) values: Vec<Value>,
    /// For an input: the epoch in which the environment gave it.
    pub(crate) given: Vec<u32>,
    /// By function.
    pub(crate) layouts: Arc<[Layout]>,
    /// The functions that have dense locations, each with the first of them, in the order of those.
    owners: Arc<[(LocationIndex, FunctionId)]>,
    dense: u32,
    sparse: HashMap<Location, LocationIndex, FxBuildHasher>,
    /// The locations of the sparse numbers, from `dense` on.
    sparse_locations: Vec<Location>,
    touched: u64,
    /// By domain; only dynamic ones' are used.
    pub(crate) carriers: Vec<Carrier>,
}

impl Clone for Store {
    fn clone(&self) -> Store {
        Store {
            values: self.values.clone(),
            given: self.given.clone(),
            layouts: Arc::clone(&self.layouts),
            owners: Arc::clone(&self.owners),
            dense: self.dense,
            sparse: self.sparse.clone(),
            sparse_locations: self.sparse_locations.clone(),
            touched: self.touched,
            carriers: self.carriers.clone(),
        }
    }

    /// In the memory that this one has: a search goes back to one state many times.
    fn clone_from(&mut self, other: &Store) {
        let Store { values, given, layouts, owners, dense, sparse, sparse_locations, touched, carriers } = self;
        values.clone_from(&other.values);
        given.clone_from(&other.given);
        layouts.clone_from(&other.layouts);
        owners.clone_from(&other.owners);
        *dense = other.dense;
        sparse.clone_from(&other.sparse);
        sparse_locations.clone_from(&other.sparse_locations);
        *touched = other.touched;
        carriers.clone_from(&other.carriers);
    }
}

impl Store {
    /// A store whose locations are all undef; `most` is the limit of their number.
    pub(crate) fn new(program: &Program, contents: &dyn Fn(DomainId) -> Option<Vec<Value>>, most: u64) -> Store {
        let (layouts, dense) = lay_out(&Extents::new(program, contents), most);
        let owners = layouts.iter().zip(0..).filter_map(|(layout, function)| {
            let first = match layout {
                Layout::Single(index) => *index,
                Layout::Dense { base, .. } => *base,
                Layout::None | Layout::Sparse => return None,
            };
            Some((first, FunctionId(function)))
        });
        let owners = owners.collect();
        Store {
            values: vec![Value::Undef; dense as usize],
            given: vec![0; dense as usize],
            layouts: layouts.into(),
            owners,
            dense,
            sparse: HashMap::default(),
            sparse_locations: Vec::new(),
            touched: 0,
            carriers: vec![Carrier::default(); program.domains.len()],
        }
    }

    /// The number of a location, if it has one yet.
    #[inline]
    pub fn find(&self, function: FunctionId, arguments: &[Value]) -> Option<LocationIndex> {
        match &self.layouts[function.0 as usize] {
            Layout::Single(index) => return Some(*index),
            Layout::Dense { base, dimensions, .. } => {
                let mut offset = 0u32;
                let mut inside = true;
                for (dimension, argument) in dimensions.iter().zip(arguments) {
                    match dimension.index(argument) {
                        Some(index) => offset = offset * dimension.size + index,
                        None => {
                            inside = false;
                            break;
                        }
                    }
                }
                if inside {
                    return Some(base + offset);
                }
            }
            Layout::None | Layout::Sparse => {}
        }
        self.sparse.get(&LocationRef { function, arguments }).copied()
    }

    /// The number of a location, giving it one if it has none.
    pub fn number(&mut self, function: FunctionId, arguments: &[Value]) -> LocationIndex {
        if let Some(index) = self.find(function, arguments) {
            return index;
        }
        let index = self.values.len() as u32;
        let location = Location { function, arguments: arguments.to_vec() };
        self.sparse_locations.push(location.clone());
        self.sparse.insert(location, index);
        self.values.push(Value::Undef);
        self.given.push(0);
        self.touched += 1;
        index
    }

    /// A number that is another one once a location has got a number, an initial value that came up late, or, where functions
    /// are shared, a value of the environment.
    #[inline]
    pub fn touched(&self) -> u64 {
        self.touched
    }

    /// A location has got a value without an update.
    pub(crate) fn touch(&mut self) {
        self.touched += 1;
    }

    /// How many locations have a number.
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// Whether none has.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// How many of them, the first, have the same number in all states.
    pub fn dense_len(&self) -> usize {
        self.dense as usize
    }

    /// The numbers of a function's dense locations, if it has such.
    pub fn dense(&self, function: FunctionId) -> Option<Range<LocationIndex>> {
        match &self.layouts[function.0 as usize] {
            Layout::Single(location) => Some(*location..*location + 1),
            Layout::Dense { base, len, .. } => Some(*base..*base + *len),
            Layout::None | Layout::Sparse => None,
        }
    }

    /// The value of a location.
    #[inline]
    pub fn value(&self, index: LocationIndex) -> &Value {
        &self.values[index as usize]
    }

    /// The values of all locations, in the order of their numbers.
    pub fn values(&self) -> &[Value] {
        &self.values
    }

    /// Whether a location was given its value by the environment or as its initial value, undef perhaps.
    #[inline]
    pub fn is_given(&self, index: LocationIndex) -> bool {
        self.given[index as usize] != 0
    }

    /// Replaces a value by another; its giver stays the same.
    #[inline]
    pub fn overwrite(&mut self, index: LocationIndex, value: Value) {
        self.values[index as usize] = value;
    }

    /// Puts a value where no initial value is to be evaluated any more, even if it is undef.
    #[inline]
    pub fn put(&mut self, index: LocationIndex, value: Value) {
        self.values[index as usize] = value;
        self.given[index as usize] = 1;
    }

    /// Makes a location undef that an initial value is evaluated of when it is read, if it has one.
    #[inline]
    pub fn clear(&mut self, index: LocationIndex) {
        self.values[index as usize] = Value::Undef;
        self.given[index as usize] = 0;
    }

    /// Whether another store of the same program has the same values, whoever gave them.
    pub fn is_like(&self, other: &Store) -> bool {
        self.values == other.values
            && self.given == other.given
            && self.sparse_locations == other.sparse_locations
            && self.carriers == other.carriers
    }

    /// Whether a location keeps its number for good: it is one of the declared arguments.
    pub fn is_lasting(&self, index: LocationIndex) -> bool {
        (index as usize) < self.len() - self.sparse_len()
    }

    /// How many locations have a number beyond the dense ones.
    pub(crate) fn sparse_len(&self) -> usize {
        self.sparse_locations.len()
    }

    /// The location of a number.
    pub fn location(&self, index: LocationIndex) -> Location {
        if index >= self.dense {
            return self.sparse_locations[(index - self.dense) as usize].clone();
        }
        let function = self.function_of(index);
        let mut arguments = Vec::new();
        if let Layout::Dense { base, dimensions, .. } = &self.layouts[function.0 as usize] {
            let mut offset = index - base;
            for dimension in dimensions.iter().rev() {
                arguments.push(dimension.value(offset % dimension.size));
                offset /= dimension.size;
            }
            arguments.reverse();
        }
        Location { function, arguments }
    }

    /// The function of a location's number.
    pub fn function_of(&self, index: LocationIndex) -> FunctionId {
        if index >= self.dense {
            self.sparse_locations[(index - self.dense) as usize].function
        } else {
            // The owners are in the order of their first numbers.
            let after = self.owners.partition_point(|(first, _)| *first <= index);
            self.owners[after - 1].1
        }
    }

    /// The numbers of a function's locations.
    pub(crate) fn indices_of(&self, function: FunctionId) -> Vec<LocationIndex> {
        let mut indices: Vec<LocationIndex> = match &self.layouts[function.0 as usize] {
            Layout::Single(index) => vec![*index],
            Layout::Dense { base, len, .. } => (*base..base + len).collect(),
            Layout::None | Layout::Sparse => Vec::new(),
        };
        let sparse = self.sparse_locations.iter().enumerate().filter(|(_, location)| location.function == function);
        indices.extend(sparse.map(|(i, _)| self.dense + i as u32));
        indices
    }

    /// Takes the numbers back from sparse locations that are undef, unless undef was given to one that `keeps` what
    /// it is given. No number handed out before is valid after.
    pub(crate) fn compact(&mut self, keeps: &dyn Fn(&Location) -> bool) {
        let kept: Vec<(Location, Value, u32)> = std::mem::take(&mut self.sparse_locations)
            .into_iter()
            .enumerate()
            .map(|(i, location)| {
                let index = self.dense as usize + i;
                (location, std::mem::take(&mut self.values[index]), self.given[index])
            })
            .filter(|(location, value, given)| !value.is_undef() || (*given != 0 && keeps(location)))
            .collect();
        self.sparse.clear();
        self.values.truncate(self.dense as usize);
        self.given.truncate(self.dense as usize);
        for (location, value, given) in kept {
            self.sparse.insert(location.clone(), self.values.len() as u32);
            self.sparse_locations.push(location);
            self.values.push(value);
            self.given.push(given);
        }
    }
}
