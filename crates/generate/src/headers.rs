//! The headers of the C++ runtime that generated code includes; `build.rs` gathers them.
//!
//! Out: their names and texts, sorted by name. [`RUNTIME`] stands in the folder `groundstate` of an include path,
//! [`MACHINE`] in `groundstate/machine`.

/// Names and texts.
pub type Headers = &'static [(&'static str, &'static str)];

include!(concat!(env!("OUT_DIR"), "/headers.rs"));
