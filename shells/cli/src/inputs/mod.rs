//! Where inputs come from: options, files and the terminal as sources of `simulate`.
//!
//! The options are declared and the files read here; what they say, `groundstate::inputs` knows.

mod options;
mod prompt;

pub use options::{Assembled, Chosen, HELP, InputArguments, assemble};
pub use prompt::{Prompt, Question};
