//! All futures of a state: every choice taken, every input given, states short enough to be kept by the million.
//!
//! An [`Explorer`] holds a machine and makes its steps again and again, each time with the next alternative at the last
//! place where there is one (`alternatives`). States are packed into words (`packed`); what a step came to is remembered
//! by what it looked at, so that most steps need no machine at all (`memory`). INVARIANT: the meaning of a step is that of
//! [`machine`]; what comes out does not depend on what was remembered.

mod alternatives;
mod assumed;
pub mod checkpoint;
mod compiled;
mod explorer;
mod given;
mod memory;
mod packed;
mod settings;
mod starts;

pub use alternatives::expansion::Expansion;
pub use alternatives::kind::AlternativeKind;
pub use alternatives::told::{ChoiceTaken, Told};
pub use alternatives::unbounded::{Unbounded, UnboundedKind};
pub use assumed::{assumed_bounds, input_values};
pub use explorer::Explorer;
pub use explorer::census::{Mover, Unlike};
pub use explorer::orbit::{Orbits, Permutation};
pub use explorer::paths::{Outcome, Path, Reading, Visitor};
pub use explorer::sets::{Alternative, Judged, SetTrouble, StateSets, Visit};
pub use explorer::sighting::{Met, Sighting};
pub use given::Given;
pub use memory::condition::Truth;
pub use packed::interner::Interner;
pub use packed::numbered::Numbered;
pub use packed::widening::{Rooms, Widening};
pub use packed::words::{Bits, Overwrite, apply, hash};
pub use settings::{Settings, Trouble};
pub use starts::{Start, Starts};
