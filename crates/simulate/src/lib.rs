//! Runs: a machine is stepped with inputs and choices from outside, until something says stop.
//!
//! In: a [`program::Program`], [`Inputs`] (layers of sources of input values, a policy for choices, a clock) and
//! [`Options`]. Out: one [`Record`] at a time from a [`Run`], so nothing here grows with the number of steps. The
//! records of a run are its trace, and [`Recorded`] plays one back. It must not know files, terminals or the real
//! clock: shells hand in what they read, as data or through [`Source`] and [`Clock`].

mod choose;
mod clock;
mod constants;
mod decided;
mod delayed;
mod draw;
mod inputs;
mod invariants;
mod named;
mod positional;
mod random;
mod read;
mod recorded;
mod run;
mod signal;
mod splitmix;
mod trace;
mod weighted;

pub use choose::{Asked, ChoiceMade, Choices, Chooser};
pub use clock::{Clock, StepClock};
pub use constants::Constants;
pub use decided::Decided;
pub use draw::{Bounds, Carriers};
pub use inputs::{Ask, Inputs, Source};
pub use machine::Passed;
pub use named::{Given, Named, Problem, Steps, Weighing};
pub use positional::Positional;
pub use random::RandomSource;
pub use read::{Written, expected, read_location, read_value, read_written};
pub use recorded::{Parted, Recorded};
pub use run::{Options, Run};
pub use signal::Signal;
pub use splitmix::SplitMix;
pub use trace::{End, Header, Invariants, Record, StepRecord, Violation};
pub use weighted::{Misfit, Misplaced, Often, Weighted};
