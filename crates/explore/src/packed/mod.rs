//! States packed into words: what stands where, and the values that have no bits of their own.
//!
//! From below: [`words`] are fields and what overwrites them, [`codes`] how values become codes, [`collection`] those of sequences and sets, [`room`] where these stand in place, [`interner`] the numbers of
//! values without a bound, [`few`] those of the few that a location has taken, [`kept`] which inputs an initial state keeps, [`numbered`] numbers of states; [`encoding`] puts them together, [`inputs`] is its
//! part for those inputs. It knows no alternatives and no search.

pub(crate) mod codes;
pub(crate) mod collection;
pub(crate) mod encoding;
pub(crate) mod few;
mod inputs;
pub(crate) mod interner;
pub(crate) mod kept;
pub(crate) mod numbered;
mod room;
pub(crate) mod widening;
pub(crate) mod words;
