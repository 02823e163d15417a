//! Checkpoints: what a search keeps while it runs, so that it goes on later.
//!
//! In: a [`Keeper`], which does the I/O, and words. Out: the same words later, or why they are refused. `words` is the format, `values`
//! how values, and what has numbers in packed states, become words; `identity` tells what a checkpoint belongs to. INVARIANT: nothing is
//! used before the checksum is verified, and no number before it is known to name something.

mod identity;
mod keeper;
mod values;
mod words;

pub use identity::{hash, layout, of_program};
pub use keeper::{Keeper, Refusal};
pub(crate) use values::write_value;
pub use values::{Known, Words, write_location, write_text, write_values};
pub use words::{Kind, Reader, Writer};
