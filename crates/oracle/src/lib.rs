//! The oracle: a naive interpreter of the checked model, written from the definitions of E. Börger, R. Stärk,
//! *Abstract State Machines*, Springer 2003, to be read beside the book. For tests only.
//!
//! In: a [`model::Model`] without errors, an [`Environment`]. Out: states, update sets, faults. It is slow on purpose:
//! a state is a map, a substate is a copy, a macro call is a substitution, an update set is a list. It shares no code
//! with the machine, and knows neither it nor the IR. `tests/agreement.rs` checks that the two agree, on models that
//! [`generate`] makes and [`mod@reduce`] makes small.

mod builtin;
mod domain;
mod element;
mod environment;
mod fault;
pub mod generate;
mod initial;
mod interpreter;
mod print;
pub mod reduce;
mod rule;
mod run;
mod state;
mod substitution;
mod term;
mod value;

pub use environment::{Environment, Tick};
pub use fault::{Fault, Stop};
pub use interpreter::{Assignment, Bounds, Interpreter};
pub use print::show;
pub use run::Oracle;
pub use state::{Clash, Location, State, Symbol, UpdateSet};
pub use value::{Double, Value};
