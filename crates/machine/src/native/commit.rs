//! Applying an update set word by word.
//!
//! Most updates write scalars over scalars; for those two words are compared and exchanged, whatever they mean.
//! INVARIANT: what [`apply`] leaves in the store and on the stack is what exchanging the values would.
#![allow(unsafe_code)]

use crate::store::Store;
use crate::update::Updates;
use crate::value::Value;

/// The tags below this one are those of values without memory of their own; [`super::shape::Kind::tag`] has them all.
const COMPOUND: u64 = 8;
/// By tag, which bits of the second word are written.
const WRITTEN: [u64; COMPOUND as usize] = [0, 0xff, u64::MAX, u64::MAX, u64::MAX, u64::MAX, 0xffff_ffff, 0xffff_ffff];

/// Exchanges the value of each update with that of its location, where they differ; tells whether any did.
pub(crate) fn apply(store: &mut Store, updates: &mut Updates) -> bool {
    let mut changed = false;
    let mut compound = false;
    for update in &mut updates.stack {
        let value = &mut store.values[update.location as usize];
        changed |= exchange(value, &mut update.value, &mut compound);
    }
    updates.compound |= compound;
    changed
}

#[inline(always)]
fn exchange(value: &mut Value, new: &mut Value, compound: &mut bool) -> bool {
    let (old_at, new_at) = (std::ptr::from_mut(value).cast::<u64>(), std::ptr::from_mut(new).cast::<u64>());
    // SAFETY: a value is two aligned words, the first its tag. The second is moved as it is, padding included; only
    // the bits that a variant with that tag has written are compared.
    unsafe {
        let (old_tag, new_tag) = (*old_at, *new_at);
        // Tags of several bits below COMPOUND, a power of two, are below it together.
        if (old_tag | new_tag) < COMPOUND {
            let (old_payload, new_payload) = (old_at.add(1).read_volatile(), new_at.add(1).read_volatile());
            // Exchanging what is equal does no harm, and takes no branch.
            (*old_at, *new_at) = (new_tag, old_tag);
            (*old_at.add(1), *new_at.add(1)) = (new_payload, old_payload);
            let written = WRITTEN[(old_tag & (COMPOUND - 1)) as usize];
            return (old_tag ^ new_tag) | ((old_payload ^ new_payload) & written) != 0;
        }
    }
    *compound = true;
    if *value == *new {
        return false;
    }
    std::mem::swap(value, new);
    true
}

/// Whether two values are equal, one of which is known to have no memory of its own.
#[inline(always)]
pub(super) fn is_same_scalar(scalar: &Value, other: &Value) -> bool {
    let (one, two) = (std::ptr::from_ref(scalar).cast::<u64>(), std::ptr::from_ref(other).cast::<u64>());
    // SAFETY: as in `exchange`: two aligned words each, of which the bits are compared that a variant with that tag has written.
    unsafe {
        let tag = *one;
        let written = WRITTEN[(tag & (COMPOUND - 1)) as usize];
        tag == *two && (one.add(1).read_volatile() ^ two.add(1).read_volatile()) & written == 0
    }
}

impl Updates {
    /// Empties the stack.
    pub fn clear_stack(&mut self) {
        if self.compound {
            self.stack.clear();
            self.compound = false;
        } else {
            // SAFETY: no value on the stack has memory of its own, so none needs to be dropped.
            unsafe { self.stack.set_len(0) };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exchanges_what_differs() {
        let values = [
            Value::Undef,
            Value::Boolean(false),
            Value::Boolean(true),
            Value::Integer(1),
            Value::Integer(2),
            Value::Char('x'),
            Value::Char('y'),
            Value::Enum(program::DomainId(3), 1),
            Value::Enum(program::DomainId(3), 2),
            Value::Real(crate::value::Real::new(1.5).expect("a number")),
            Value::string("x"),
            Value::seq(vec![Value::Integer(1)]),
        ];
        for old in &values {
            for new in &values {
                let (mut left, mut right, mut compound) = (old.clone(), new.clone(), false);
                assert_eq!(exchange(&mut left, &mut right, &mut compound), old != new);
                assert_eq!((&left, &right), if old == new { (old, new) } else { (new, old) });
                if old.is_scalar() {
                    assert_eq!(is_same_scalar(old, new), old == new);
                }
                let has_memory = |value: &Value| matches!(value, Value::String(_) | Value::Seq(_));
                assert_eq!(compound, has_memory(old) || has_memory(new));
            }
        }
    }
}
