//! Describes what happened, as text for people.
//!
//! In: records of runs and other results of the operations. Out: lines, for a shell to write. It must not know
//! terminals; the caller asks for colours.

mod beside;
mod coverage;
mod extent;
mod found;
mod hint;
mod parting;
mod proof;
mod refinement;
mod review;
mod run;
mod side_by_side;
mod sought;
mod story;
mod verdict;

pub use beside::{beside, but, outside};
pub use coverage::{Uncovered, uncovered};
pub use extent::{Extent, explored, place_of, why_unreduced};
pub use found::{FoundChange, FoundStep};
pub use hint::hint;
pub use parting::parting;
pub use proof::said;
pub use refinement::{Refinements, Standing, no_start, trace_of};
pub use review::says;
pub use run::{Detail, Narrator};
pub use side_by_side::{Row, WAITS};
pub use story::story;
pub use verdict::{Story, Verdicts, id};

/// A count with its noun.
pub fn plural(count: usize, word: &str) -> String {
    if count == 1 { format!("1 {word}") } else { format!("{count} {word}s") }
}
