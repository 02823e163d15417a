//! First-order mutants of a model: its text with one small fault put in, by a published list of operators
//! (spec/mutation.md).
//!
//! In: a checked model, and which of its files to mutate. Out: [`Mutant`]s, each an edit of that file's text, with the
//! place and the operator. A mutant differs from the model in its rules, in the definitions that these use or in its
//! initial state, never in its properties: those are to judge it. [`same()`] tells whether a mutant makes the same steps as
//! the model from every reachable state, so that nothing can tell the two apart. A chart's mutants are edits of its text, too
//! ([`chart_mutants`]). It knows no judge.
//!
//! INVARIANT: mutants are in the order of the text, and the same text gives the same mutants.

mod all;
mod drawn;
mod edit;
mod facts;
mod footprint;
mod make;
mod mutant;
mod operator;
mod places;
mod reach;
mod same;
mod score;

pub use all::mutants;
pub use drawn::chart_mutants;
pub use edit::{Change, Edit, applied, changed};
pub use mutant::{Mutant, Named};
pub use operator::Operator;
pub use same::{Differs, Extent, Variant, same};
pub use score::{Interval, interval};
