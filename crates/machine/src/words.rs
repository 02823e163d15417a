//! Values as the two words that they are.
//!
//! Most updates write scalars over scalars; for those two words are compared and exchanged, whatever they mean. Values are moved
//! by their words, too: a processor that reads sixteen bytes waits for two words to come together that compiled code has
//! just written.
#![allow(unsafe_code)]

use std::mem::MaybeUninit;

use crate::value::Value;

/// The tags below this one are those of values without memory of their own; `Kind::tag` of native/shape.rs has them all.
const COMPOUND: u64 = 8;
/// The tag of undef, which has no payload.
const UNDEF: u64 = 0;
/// By tag, which bits of the second word are written.
const WRITTEN: [u64; COMPOUND as usize] = [0, 0xff, u64::MAX, u64::MAX, u64::MAX, u64::MAX, 0xffff_ffff, 0xffff_ffff];

/// Exchanges two values where they differ; tells whether they do. `compound` becomes true where one may have memory of its own.
#[inline(always)]
pub(crate) fn exchange(value: &mut Value, new: &mut Value, compound: &mut bool) -> bool {
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

/// Whether a value without memory of its own, given by its words, is that value.
#[inline(always)]
pub(crate) fn is_same_scalar([tag, payload]: [u64; 2], other: &Value) -> bool {
    let other = std::ptr::from_ref(other).cast::<u64>();
    // SAFETY: as in `exchange`: two aligned words, of which the bits are compared that a variant with that tag has written.
    unsafe {
        let written = WRITTEN[(tag & (COMPOUND - 1)) as usize];
        tag == *other && (payload ^ other.add(1).read_volatile()) & written == 0
    }
}

/// Exchanges two values, whatever they are.
#[inline(always)]
pub(crate) fn swap(one: &mut Value, two: &mut Value) {
    let (one, two) =
        (std::ptr::from_mut(one).cast::<MaybeUninit<u64>>(), std::ptr::from_mut(two).cast::<MaybeUninit<u64>>());
    // SAFETY: a value is two aligned words; both are moved as they are, padding included.
    unsafe {
        let [a, b] = [one.read_volatile(), one.add(1).read_volatile()];
        let [c, d] = [two.read_volatile(), two.add(1).read_volatile()];
        one.write(c);
        one.add(1).write(d);
        two.write(a);
        two.add(1).write(b);
    }
}

/// Shortens a list without looking at what is dropped of it: what `may_own` memory, if anything does, is looked at.
pub(crate) fn shorten<T>(list: &mut Vec<T>, len: usize, may_own: bool) {
    if may_own || len > list.len() {
        list.truncate(len);
    } else {
        // SAFETY: it is no longer than before. What is forgotten is not dropped, which harms nothing.
        unsafe { list.set_len(len) };
    }
}

/// Moves a value to where there is none yet, and leaves undef.
#[inline(always)]
pub(crate) fn put(place: &mut MaybeUninit<Value>, value: &mut Value) {
    let from = std::ptr::from_mut(value).cast::<MaybeUninit<u64>>();
    let to = place.as_mut_ptr().cast::<MaybeUninit<u64>>();
    // SAFETY: as in `swap`; the value is in one place at the end, since undef stands in the other.
    unsafe {
        to.write(from.read_volatile());
        to.add(1).write(from.add(1).read_volatile());
        from.write(MaybeUninit::new(UNDEF));
    }
}

/// Takes a value, and leaves undef.
#[inline(always)]
pub(crate) fn take(place: &mut Value) -> Value {
    let words = std::ptr::from_mut(place).cast::<MaybeUninit<u64>>();
    // SAFETY: as in `swap`; the value is in one place at the end, since undef stands in the other.
    unsafe {
        let taken = [words.read_volatile(), words.add(1).read_volatile()];
        words.write(MaybeUninit::new(UNDEF));
        std::mem::transmute::<[MaybeUninit<u64>; 2], Value>(taken)
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
        let words = [[0, 7], [1, 0], [1, 1], [2, 1], [2, 2]];
        for (scalar, words) in values.iter().zip(words) {
            values.iter().for_each(|other| assert_eq!(is_same_scalar(words, other), scalar == other));
        }
        for old in &values {
            for new in &values {
                let (mut left, mut right, mut compound) = (old.clone(), new.clone(), false);
                assert_eq!(exchange(&mut left, &mut right, &mut compound), old != new);
                assert_eq!((&left, &right), if old == new { (old, new) } else { (new, old) });
                let (mut left, mut right) = (old.clone(), new.clone());
                swap(&mut left, &mut right);
                assert_eq!((&left, &right), (new, old));
                assert_eq!((&take(&mut left), &left), (new, &Value::Undef));
                let has_memory = |value: &Value| matches!(value, Value::String(_) | Value::Seq(_));
                assert_eq!(compound, has_memory(old) || has_memory(new));
            }
        }
    }
}
