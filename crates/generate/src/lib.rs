//! C++ from models and from systems.
//!
//! [`model`] makes a model's state, step and environment one class. [`system`] makes of a chart's system a program over the
//! runtime of `cpp/`: a thread a task, the channels as the chart has them. [`names`] spells what both call things. What cannot
//! be generated is refused with its place.

mod fault;
pub mod model;
pub mod names;
pub mod system;

pub use fault::IDS as FAULT_IDS;
