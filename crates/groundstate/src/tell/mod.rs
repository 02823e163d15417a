//! Describes what happened, as text for people.
//!
//! In: records of runs and other results of the operations. Out: lines, for a shell to write. It must not know
//! terminals; the caller asks for colours.

mod coverage;
mod parting;
mod review;
mod run;
mod story;

pub use coverage::{Uncovered, uncovered};
pub use parting::parting;
pub use review::says;
pub use run::{Detail, Narrator};
pub use story::story;

/// A count with its noun.
pub fn plural(count: usize, word: &str) -> String {
    if count == 1 { format!("1 {word}") } else { format!("{count} {word}s") }
}
