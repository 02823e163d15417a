//! Generates C++ from models and from systems.
//!
//! [`model`] makes one class of a model's state, step and environment. [`system`] makes a program of a chart's system,
//! over the runtime of `cpp/`: one thread per task, and the channels of the chart. [`names`] chooses the names for
//! both, and [`headers`] has what the generated code includes. What cannot be generated is refused with its place.

mod fault;
pub mod headers;
pub mod model;
pub mod names;
pub mod system;

pub use fault::IDS as FAULT_IDS;
