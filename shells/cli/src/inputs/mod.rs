//! Sources of inputs: options and files. Those that are asked for come from the prompt.
//!
//! This crate declares the options and reads the files; `groundstate::inputs` interprets them.

mod options;

pub use options::{Asks, Assembled, Chosen, HELP, InputArguments, assemble};
