//! What compiled code calls to look through collections and items, none of which belongs to a machine.
//!
//! In: where values stand. Out: where their items stand, in which order, or at which position one is. The promises of the code are those
//! that [`crate::native::runtime`] names.
#![allow(unsafe_code)]

use program::CollectionKind;

use crate::native::comprehension::kind_of;
use crate::value::Value;

/// Where the items of a set or a sequence are and how many, written to two words; of another kind, none.
pub unsafe extern "C" fn items(collection: *const Value, kind: i64, out: *mut [u64; 2]) -> i64 {
    // SAFETY: *values*; `out` is two words on the code's stack. The items live as long as their collection.
    unsafe {
        let items: &[Value] = match (&*collection, kind_of(kind)) {
            (Value::Set(items), CollectionKind::Set) | (Value::Seq(items), CollectionKind::Seq) => items,
            _ => return 1,
        };
        *out = [items.as_ptr() as u64, items.len() as u64];
    }
    0
}

/// Sorts items and leaves out those that repeat; how many are left.
pub unsafe extern "C" fn arrange(start: *mut Value, count: u64) -> i64 {
    // SAFETY: the items are the code's own, as many as it says, all of them scalars, which need not be dropped.
    let items = unsafe { std::slice::from_raw_parts_mut(start, count as usize) };
    items.sort_unstable();
    let mut distinct = 0;
    for index in 0..items.len() {
        if index == 0 || items[index] != items[distinct - 1] {
            items.swap(distinct, index);
            distinct += 1;
        }
    }
    distinct as i64
}

/// The position of the first item that is a scalar; -1 where there is none.
pub unsafe extern "C" fn position(start: *const Value, count: u64, tag: u64, payload: u64) -> i64 {
    let wanted = [tag, payload];
    // SAFETY: the items are as many as the code says; the two words are those of a scalar, which needs no drop.
    let (items, wanted) =
        unsafe { (std::slice::from_raw_parts(start, count as usize), &*std::ptr::from_ref(&wanted).cast::<Value>()) };
    items.iter().position(|item| item == wanted).map_or(-1, |position| position as i64)
}
