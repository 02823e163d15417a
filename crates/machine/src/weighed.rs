//! Collections that know how large they are when all that is shared within them is unfolded.
//!
//! Values share their parts: `s := [s, s]` takes a few words in each step, but doubles what printing, ordering and hashing
//! walk through. So every collection keeps its depth and its *weight*: the number of values at its leaves, each counted as
//! often as it occurs. Both are computed from those of the members when the collection is made. A limit on the weight
//! bounds every walk through a value ([`crate::measure`]). CIRCLE(values)

use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::fmt;
use std::hash::{Hash, Hasher};
use std::ops::Deref;

use crate::value::Value;

/// The weight and the depth of a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Weight {
    /// Values at its leaves, each as often as it occurs; at least one. A string counts a value for every two words.
    pub leaves: u64,
    /// The depth to which collections and tuples nest.
    pub depth: u32,
}

impl Weight {
    /// Of a value without parts.
    pub(crate) const SCALAR: Weight = Weight { leaves: 1, depth: 0 };

    fn of_members(members: impl Iterator<Item = (Weight, u64)>) -> Weight {
        let mut all = Weight { leaves: 0, depth: 0 };
        for (weight, times) in members {
            all.leaves = all.leaves.saturating_add(weight.leaves.saturating_mul(times));
            all.depth = all.depth.max(weight.depth);
        }
        Weight { leaves: all.leaves.max(1), depth: all.depth.saturating_add(1) }
    }
}

/// What a collection can be made of.
pub trait Weigh {
    /// Its weight, from those of its members.
    fn weigh(&self) -> Weight;
}

impl Weigh for Vec<Value> {
    fn weigh(&self) -> Weight {
        Weight::of_members(self.iter().map(|value| (value.weight(), 1)))
    }
}

impl Weigh for BTreeMap<Value, u64> {
    fn weigh(&self) -> Weight {
        Weight::of_members(self.iter().map(|(value, times)| (value.weight(), *times)))
    }
}

impl Weigh for BTreeMap<Value, Value> {
    fn weigh(&self) -> Weight {
        Weight::of_members(self.iter().flat_map(|(key, value)| [(key.weight(), 1), (value.weight(), 1)]))
    }
}

/// An immutable collection and its weight.
#[derive(Clone)]
pub struct Weighed<T> {
    members: T,
    weight: Weight,
}

/// The members of a tuple, a sequence or a set.
pub type Items = Weighed<Vec<Value>>;

impl<T: Weigh> Weighed<T> {
    /// Weighs a collection.
    pub fn new(members: T) -> Weighed<T> {
        let weight = members.weigh();
        Weighed { members, weight }
    }

    /// Its weight.
    pub fn weight(&self) -> Weight {
        self.weight
    }
}

impl<T> Deref for Weighed<T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.members
    }
}

impl<T: PartialEq> PartialEq for Weighed<T> {
    fn eq(&self, other: &Self) -> bool {
        self.weight == other.weight && self.members == other.members
    }
}

impl<T: Eq> Eq for Weighed<T> {}

impl<T: Ord> PartialOrd for Weighed<T> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// The order of the members: the weight has no part in it.
impl<T: Ord> Ord for Weighed<T> {
    fn cmp(&self, other: &Self) -> Ordering {
        if std::ptr::eq(self, other) { Ordering::Equal } else { self.members.cmp(&other.members) }
    }
}

impl<T: Hash> Hash for Weighed<T> {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.members.hash(state);
    }
}

impl<T: fmt::Debug> fmt::Debug for Weighed<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.members.fmt(f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pair_of(value: &Value) -> Value {
        Value::seq(vec![value.clone(), value.clone()])
    }

    #[test]
    fn what_is_shared_is_weighed_each_time() {
        let mut value = Value::Integer(1);
        for _ in 0..10 {
            value = pair_of(&value);
        }
        assert_eq!(value.weight(), Weight { leaves: 1024, depth: 10 });
        let map = Value::map([(Value::Integer(1), value.clone()), (value, Value::Integer(2))]);
        assert_eq!(map.weight(), Weight { leaves: 2050, depth: 11 });
        assert_eq!(Value::seq(Vec::new()).weight(), Weight { leaves: 1, depth: 1 });
    }

    #[test]
    fn what_is_one_is_compared_at_once() {
        let mut value = Value::Integer(1);
        for _ in 0..200 {
            value = pair_of(&value);
        }
        assert_eq!(value.weight().leaves, u64::MAX);
        assert_eq!(value, value.clone());
        assert_eq!(value.cmp(&value.clone()), Ordering::Equal);
        // Both members are one value, so comparing the first decides.
        assert_eq!(pair_of(&value).cmp(&pair_of(&value)), Ordering::Equal);
    }
}
