//! Where the items of a sequence or a set stand, for code that looks through them without a call.
//!
//! In: nothing. Out: the offsets at which the pointer to the items and their number stand behind the second word of a value, and the tags of the
//! kinds. How the standard library lays out a vector is its own business: it is looked at, in a value made for that, and where it is not
//! found, code calls [`crate::native::gathered::items`].
#![allow(unsafe_code)]

use std::sync::OnceLock;

use program::CollectionKind;

use crate::value::Value;

/// See the module.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Anatomy {
    pub start: i32,
    pub count: i32,
    seq: i64,
    set: i64,
}

impl Anatomy {
    /// That of this program's values.
    pub fn of_values() -> Option<Anatomy> {
        static FOUND: OnceLock<Option<Anatomy>> = OnceLock::new();
        *FOUND.get_or_init(found)
    }

    /// The tag of a kind of collection whose items can be looked through.
    pub fn tag(&self, kind: CollectionKind) -> Option<i64> {
        match kind {
            CollectionKind::Seq => Some(self.seq),
            CollectionKind::Set => Some(self.set),
            CollectionKind::Bag | CollectionKind::Map => None,
        }
    }
}

/// The two words of a value.
fn words(value: &Value) -> [u64; 2] {
    // SAFETY: a value is two words, both written for collections: the tag and the pointer to what is shared.
    unsafe { *std::ptr::from_ref(value).cast::<[u64; 2]>() }
}

fn found() -> Option<Anatomy> {
    // Its capacity is not its length, so that one is not taken for the other.
    let mut three = Vec::with_capacity(5);
    three.extend([Value::Integer(7), Value::Integer(8), Value::Integer(9)]);
    let value = Value::seq(three);
    let Value::Seq(shared) = &value else { return None };
    let items: &Vec<Value> = shared;
    if items.capacity() == items.len() || size_of::<Vec<Value>>() != 24 {
        return None;
    }
    let [seq, behind] = words(&value);
    let first = std::ptr::from_ref(items) as u64 - behind;
    let vector = std::ptr::from_ref(items).cast::<u64>();
    // SAFETY: a vector is three words here, all of them written: pointer, capacity and length.
    let of_vector = |index: usize| unsafe { *vector.add(index) };
    let offset = |wanted: u64| {
        let index = (0..3).find(|index| of_vector(*index) == wanted)?;
        i32::try_from(first + 8 * index as u64).ok()
    };
    let (start, count) = (offset(items.as_ptr() as u64)?, offset(items.len() as u64)?);
    let [set, _] = words(&Value::set(vec![Value::Integer(7)]));
    Some(Anatomy { start, count, seq: seq as i64, set: set as i64 })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What code would read.
    fn read(anatomy: Anatomy, value: &Value) -> (u64, u64) {
        let [_, behind] = words(value);
        let at = |offset: i32| {
            // SAFETY: as in `found`, of a value of the same type.
            unsafe { *((behind + offset as u64) as *const u64) }
        };
        (at(anatomy.start), at(anatomy.count))
    }

    #[test]
    fn items_are_found() {
        let anatomy = Anatomy::of_values().expect("the standard library's vectors are known");
        for length in [0, 1, 2, 3, 5, 100] {
            let numbers: Vec<Value> = (0..length).map(Value::Integer).collect();
            for (value, kind) in
                [(Value::seq(numbers.clone()), CollectionKind::Seq), (Value::set(numbers.clone()), CollectionKind::Set)]
            {
                let (Value::Seq(items) | Value::Set(items)) = &value else { panic!("made so") };
                assert_eq!(read(anatomy, &value), (items.as_ptr() as u64, length as u64));
                assert_eq!(words(&value)[0] as i64, anatomy.tag(kind).expect("looked through"));
            }
        }
    }
}
