//! Applying an update set word by word.
//!
//! Most updates write scalars over scalars; for those two words are compared and exchanged, whatever they mean.
//! INVARIANT: what [`apply`] leaves in the store and on the stack is what exchanging the values would.
#![allow(unsafe_code)]

use crate::store::Store;
use crate::update::Updates;
use crate::value::Value;

/// The tags below this one are those of values without memory of their own.
const COMPOUND: u64 = 8;

/// Exchanges the value of each update with that of its location, where they differ; tells whether any did.
pub(crate) fn apply(store: &mut Store, updates: &mut Updates) -> bool {
    let mut changed = false;
    let mut compound = false;
    for update in &mut updates.stack {
        let value = &mut store.values[update.location as usize];
        if exchange(value, &mut update.value, &mut compound) {
            changed = true;
        }
    }
    updates.compound |= compound;
    changed
}

#[inline(always)]
fn exchange(value: &mut Value, new: &mut Value, compound: &mut bool) -> bool {
    let (old_at, new_at) = (std::ptr::from_mut(value).cast::<u64>(), std::ptr::from_mut(new).cast::<u64>());
    // SAFETY: a value is two aligned words, the first its tag. The second may be partly padding, which is only
    // moved, never interpreted: it is read as `MaybeUninit`.
    unsafe {
        let (old_tag, new_tag) = (*old_at, *new_at);
        if old_tag < COMPOUND && new_tag < COMPOUND {
            let payload = |at: *mut u64| at.add(1).cast::<std::mem::MaybeUninit<u64>>();
            if old_tag == new_tag && *value == *new {
                return false;
            }
            std::ptr::swap(payload(old_at), payload(new_at));
            (*old_at, *new_at) = (new_tag, old_tag);
            return true;
        }
    }
    *compound = true;
    if *value == *new {
        return false;
    }
    std::mem::swap(value, new);
    true
}

/// Empties the stack of an update set.
pub(crate) fn clear(updates: &mut Updates) {
    if updates.compound {
        updates.stack.clear();
        updates.compound = false;
    } else {
        // SAFETY: no value on the stack has memory of its own, so none needs to be dropped.
        unsafe { updates.stack.set_len(0) };
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
            Value::string("x"),
            Value::seq(vec![Value::Integer(1)]),
        ];
        for old in &values {
            for new in &values {
                let (mut left, mut right, mut compound) = (old.clone(), new.clone(), false);
                assert_eq!(exchange(&mut left, &mut right, &mut compound), old != new);
                assert_eq!((&left, &right), if old == new { (old, new) } else { (new, old) });
                let has_memory = |value: &Value| matches!(value, Value::String(_) | Value::Seq(_));
                assert_eq!(compound, has_memory(old) || has_memory(new));
            }
        }
    }
}
