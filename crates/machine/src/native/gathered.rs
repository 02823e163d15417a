//! What compiled code calls to look through collections and items, and to make collections of them.
//!
//! In: where values stand. Out: where their items stand, in which order, or at which position one is; the collection of some items. The
//! promises of the code are those that [`crate::native::runtime`] names.
#![allow(unsafe_code)]

use program::CollectionKind;
use syntax::{FileId, Span};

use crate::evaluate::collection;
use crate::native::comprehension::kind_of;
use crate::native::context::Context;
use crate::native::memory::Lately;
use crate::value::Value;

const NOWHERE: Span = Span { file: FileId(0), start: 0, end: 0 };

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

/// Adds copies of values to the items of a collection that is not made, where all are scalars and there is room.
pub unsafe extern "C" fn extend(context: *mut Context, start: *const Value, count: u64) -> i64 {
    // SAFETY: *context*; the values are as many as the code says, and the items that it counts lie below them or elsewhere.
    unsafe {
        let values = std::slice::from_raw_parts(start, count as usize);
        let context = &mut *context;
        if context.item + count > context.item_capacity || !values.iter().all(Value::is_scalar) {
            return 1;
        }
        std::ptr::copy(start, context.items.add(context.item as usize), count as usize);
        context.item += count;
    }
    0
}

/// Makes the collection of items.
pub unsafe extern "C" fn make(context: *mut Context, start: *const Value, count: u64, kind: i64) -> *const Value {
    // SAFETY: *context*; the items are as many as the code says, and those of a set sorted and distinct.
    unsafe {
        let (items, kind) = (std::slice::from_raw_parts(start, count as usize), kind_of(kind));
        let place = match Context::memory(context).lately(kind, items) {
            Some(Lately::Made(value)) => return (*context).keep(value.clone()),
            Some(Lately::Free(place)) => Some(place),
            None => None,
        };
        let value = match kind {
            CollectionKind::Set => Value::sorted(items.to_vec()),
            kind => collection(kind, items.to_vec()),
        };
        let made = Context::executor(context).made(value, NOWHERE);
        if let (Ok(value), Some(place)) = (&made, place) {
            place.clone_from(value);
        }
        made.map_or(std::ptr::null(), |value| (*context).keep(value))
    }
}
