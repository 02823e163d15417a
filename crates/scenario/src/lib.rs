//! Scenarios in Avalla: parsed, resolved against a model, run, judged, and what they covered.
//!
//! In: the text of a scenario ([`parse`]), the model it loads, lowered ([`resolve()`]). Out: a [`Verdict`] and [`Counts`]
//! of what ran ([`run()`]). The meaning of commands is spec/avalla.md: inputs persist until set again; a `check` sees the
//! inputs of the next step; after a failed check the rest of its group is checked, and then the run stops. It must not
//! know files, random sources or wire formats.

mod coverage;
mod environment;
mod expand;
mod explain;
mod play;
mod resolve;
mod run;
mod script;
mod stage;
mod story;
mod verdict;

pub use coverage::{Branch, Counts, Coverage, Evidence, Forall, Item, Items, Wanted, WantedKind, wanted};
pub use environment::{Choices, FirstCandidate, Made};
pub use expand::Blocks;
pub use explain::{Reading, explain};
pub use play::{Play, Saved};
pub use resolve::{Parsed, parse, resolve};
pub use run::{judged, run};
pub use script::Script;
pub use stage::{Moved, Options};
pub use story::{Passage, PassageKind, Story};
pub use verdict::{Failure, FailureKind, Judgement, Remark, Verdict};
