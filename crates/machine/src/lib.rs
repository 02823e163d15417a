//! The semantics of ASMs: program × state × environment → update set → next state.
//!
//! In: a [`program::Program`]. A [`Machine`] holds its current state. [`Machine::step`] makes one step with inputs and
//! choices from an [`Environment`], or returns a [`Fault`] and leaves the state as it was. The definitions are those of
//! E. Börger, R. Stärk, *Abstract State Machines*, Springer 2003: locations, updates and update sets (2.4), rules
//! (2.4.4), turbo rules (4.1). It must not know files, clocks, random sources or printing.

mod again;
mod alternatives;
mod branching;
mod builtin;
mod compiled;
mod contain;
mod coverage;
mod elsewhere;
mod engine;
mod enumerate;
mod environment;
mod evaluate;
mod execute;
mod fault;
pub mod inside;
mod interrupt;
mod journal;
mod layout;
mod limits;
mod location;
mod machine;
mod mark;
mod measure;
mod membership;
mod memo;
mod native;
mod observe;
mod perform;
mod piece;
mod pieces;
mod print;
mod stage;
mod start;
mod step;
mod store;
mod trail;
mod update;
mod value;
mod watch;
mod weighed;
mod words;
mod work;

pub use alternatives::{Alternatives, Bounds};
pub use coverage::Coverage;
pub use engine::EngineChoice;
pub use environment::{Choice, Closed, Draw, Environment, TimeUnit};
pub use fault::{ClashSide, Fault, FaultClass, FaultKind};
pub use interrupt::{Cause, Interrupt};
pub use limits::Limits;
pub use location::{Location, LocationRef};
pub use machine::{Change, Machine, Snapshot};
pub use mark::Mark;
pub use observe::{CONDITIONS, Observation, Truths, conditions_of};
pub use piece::{Edit, Piece};
pub use print::{BriefValue, Show, ShowValue, element_name};
pub use step::{Passed, Step};
pub use value::{Real, Value};
pub use weighed::{Items, Weigh, Weighed, Weight};
