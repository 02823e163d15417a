//! All futures of a state: every choice taken, every input given, states short enough to be kept by the million.
//!
//! An [`Explorer`] holds a machine and makes its steps again and again, each time with the next alternative at the last
//! place where there is one ([`branches`]). States are packed into words ([`encoding`]); what a step came to is
//! remembered by what it looked at, so that most steps need no machine at all ([`tree`]). The meaning of a step stays
//! that of the rest of this crate.

mod branches;
mod choose;
mod conditions;
mod encoding;
mod expansion;
mod explorer;
mod interner;
mod judge;
mod kept;
mod orbit;
mod origin;
mod paths;
mod sets;
mod sighted;
mod starts;
mod successors;
mod tree;

pub(crate) use branches::Branches;
pub use branches::{Bounds, ChoiceTaken, Unbounded, UnboundedKind};
pub use conditions::Truth;
pub use encoding::Widening;
pub use expansion::Expansion;
pub use explorer::{Explorer, FaultClass, Settings, Trouble};
pub use interner::Interner;
pub use orbit::{Orbits, Permutation};
pub use paths::{Outcome, Path, Told};
pub use sets::{Alternative, AlternativeKind, Bits, Judged, Overwrite, SetTrouble, StateSets, Visit};
pub use sighted::{Met, Sighting};
pub use starts::{Start, Starts};
