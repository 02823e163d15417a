//! Sources of inputs as options and files: what is read here becomes a source of `simulate`.

mod options;
mod prompt;
mod table;
mod yaml;

pub use options::{Assembled, Chosen, HELP, InputArguments, assemble};
pub use prompt::Look;

use groundstate::simulate::{Given, Steps, Written};
use syntax::{Diagnostic, FileId, Span};

/// What a file gives, or the first thing in it that cannot be read.
type Read = Result<Vec<Given>, Box<Diagnostic>>;

fn fault(span: Span, message: impl Into<String>) -> Box<Diagnostic> {
    Box::new(Diagnostic::error("bad-input-file", span, message))
}

fn steps(text: &str, span: Span) -> Result<Steps, Box<Diagnostic>> {
    Steps::read(text).map_err(|message| fault(span, message))
}

/// A whole file as a span, for what has no better place.
fn whole(file: FileId) -> Span {
    Span { file, start: 0, end: 0 }
}

/// A cell's or scalar's text as a value.
fn text(text: &str) -> Written {
    Written::Text(text.to_string())
}
