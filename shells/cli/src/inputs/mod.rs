//! Sources of inputs: options, files and the terminal.
//!
//! This crate declares the options and reads the files; `groundstate::inputs` interprets them.

mod options;
mod prompt;

pub use options::{Assembled, Chosen, HELP, InputArguments, assemble};
pub use prompt::{Prompt, Question};
