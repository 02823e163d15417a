//! Locations, states, updates and update sets (Börger & Stärk 2003, section 2.4).
//!
//! A state is the finite map of its locations to values; a location that is not in it never got one, and its value is
//! undef. The universes are part of the state as the book has it, by their characteristic functions:
//! `Domain(D)(x) = true`.

use std::collections::BTreeMap;

use model::{DomainId, FunctionId};

use crate::value::Value;

/// A name of the signature whose interpretation is part of the state.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Symbol {
    /// A dynamic function.
    Function(FunctionId),
    /// The characteristic function of an abstract or dynamic domain.
    Domain(DomainId),
}

/// A location: a name with argument values (definition 2.4.3).
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Location {
    /// The name.
    pub symbol: Symbol,
    /// The arguments.
    pub arguments: Vec<Value>,
}

impl Location {
    /// The location of a function.
    pub fn function(function: FunctionId, arguments: Vec<Value>) -> Location {
        Location { symbol: Symbol::Function(function), arguments }
    }

    /// The location that says whether an element is in a domain.
    pub fn member(domain: DomainId, element: Value) -> Location {
        Location { symbol: Symbol::Domain(domain), arguments: vec![element] }
    }
}

/// A state (definition 2.4.1).
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct State(BTreeMap<Location, Value>);

impl State {
    /// The content of a location.
    pub fn get(&self, location: &Location) -> Value {
        self.0.get(location).cloned().unwrap_or(Value::Undef)
    }

    /// Whether the location was ever given a value, undef included.
    pub fn has(&self, location: &Location) -> bool {
        self.0.contains_key(location)
    }

    /// The state with one location changed.
    pub fn set(&mut self, location: Location, value: Value) {
        self.0.insert(location, value);
    }

    /// The state in which a function is undef everywhere.
    pub fn without(&self, function: FunctionId) -> State {
        let kept = self.0.iter().filter(|(location, _)| location.symbol != Symbol::Function(function));
        State(kept.map(|(location, value)| (location.clone(), value.clone())).collect())
    }

    /// The elements of a domain in canonical order.
    pub fn members(&self, domain: DomainId) -> impl Iterator<Item = &Value> {
        let symbol = Symbol::Domain(domain);
        self.0.keys().filter(move |location| location.symbol == symbol).map(|location| &location.arguments[0])
    }

    /// All locations that are not undef, in canonical order.
    pub fn locations(&self) -> impl Iterator<Item = (&Location, &Value)> {
        self.0.iter().filter(|(_, value)| !value.is_undef())
    }

    /// The state A + U that results from firing a consistent update set in the state A (definition 2.4.5).
    pub fn fire(&self, updates: &UpdateSet) -> State {
        let mut next = self.clone();
        for (location, value) in &updates.0 {
            next.set(location.clone(), value.clone());
        }
        next
    }
}

/// Two updates of one location to different values.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Clash {
    /// The location.
    pub location: Location,
    /// The value first yielded.
    pub first: Value,
    /// The other value.
    pub second: Value,
}

/// A set of updates (definition 2.4.4).
///
/// It is a set: the order of its updates, in which they were yielded, does not matter.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct UpdateSet(Vec<(Location, Value)>);

impl UpdateSet {
    /// The empty set.
    pub fn empty() -> UpdateSet {
        UpdateSet::default()
    }

    /// The set {(l, v)}.
    pub fn one(location: Location, value: Value) -> UpdateSet {
        UpdateSet(vec![(location, value)])
    }

    /// Is it ∅?
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// U ∪ V.
    pub fn union(mut self, other: UpdateSet) -> UpdateSet {
        for update in other.0 {
            if !self.0.contains(&update) {
                self.0.push(update);
            }
        }
        self
    }

    /// U ⊕ V: the updates of V, and those of U to locations that V does not update (definition 4.1.1).
    pub fn then(self, later: UpdateSet) -> UpdateSet {
        let kept = self.0.into_iter().filter(|(location, _)| later.value(location).is_none());
        UpdateSet(kept.collect::<Vec<_>>()).union(later)
    }

    /// The violations of consistency: (l, v) ∈ U, (l, w) ∈ U, v ≠ w (definition 2.4.5).
    pub fn clashes(&self) -> Vec<Clash> {
        let mut clashes = Vec::new();
        for (index, (location, second)) in self.0.iter().enumerate() {
            for (earlier, first) in &self.0[..index] {
                if earlier == location && first != second {
                    clashes.push(Clash { location: location.clone(), first: first.clone(), second: second.clone() });
                }
            }
        }
        clashes
    }

    /// The value to which a location is updated.
    pub fn value(&self, location: &Location) -> Option<&Value> {
        self.0.iter().find(|(updated, _)| updated == location).map(|(_, value)| value)
    }

    /// U without the updates of a function.
    pub fn without(self, function: FunctionId) -> UpdateSet {
        UpdateSet(self.0.into_iter().filter(|(location, _)| location.symbol != Symbol::Function(function)).collect())
    }

    /// The updates in the order yielded.
    pub fn iter(&self) -> impl Iterator<Item = &(Location, Value)> {
        self.0.iter()
    }
}
