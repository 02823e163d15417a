//! Reads what stands beside a model: inputs by step, values to try, what to verify, and options about all of these.
//!
//! In: texts, with a [`FileId`] if a fault should show its place. Out: sources of [`simulate`], bounds of a search,
//! [`verification::Verification`], or what is wrong. A fault in a file is a [`Diagnostic`]; a wrong option is a
//! sentence, and the shell adds the name of the option. It must not know files or the command line.

pub mod bound;
pub mod node;
mod options;
mod scalar;
mod table;
pub mod verification;
mod yaml;

use std::fmt;
use std::path::Path;

use program::Program;
use simulate::{Given, Named, Problem, Steps, Weighing, Written};
use syntax::{Diagnostic, FileId, Span};

pub use options::{asked, constants, integers, reals, step_ns, weighted, without_source};
pub use scalar::Scalar;

/// How inputs are written down.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// Steps to locations to values.
    Yaml,
    /// A column for each location, or `step,location,value`.
    Csv,
}

impl Form {
    /// The form of a file, from its ending; none for any other ending.
    pub fn of(path: &Path) -> Option<Form> {
        match path.extension()?.to_str()? {
            "yaml" | "yml" => Some(Form::Yaml),
            "csv" => Some(Form::Csv),
            _ => None,
        }
    }
}

/// A file of inputs as a source for a program.
///
/// # Errors
/// The first place that cannot be read; otherwise all inputs that the program does not have, and all values that do not
/// fit.
pub fn named(program: &Program, form: Form, file: FileId, source: &str) -> Result<Named, Vec<Diagnostic>> {
    let read = match form {
        Form::Yaml => yaml::read(file, source),
        Form::Csv => table::read(file, source).map(|given| Contents { given, weighings: Vec::new() }),
    };
    let Contents { given, weighings } = read.map_err(|fault| vec![*fault])?;
    Named::new(program, &given, &weighings).map_err(|problems| {
        let diagnostic = |problem: Problem| {
            let id = if problem.value { "bad-input-value" } else { "unknown-input" };
            Diagnostic::error(id, problem.span, problem.message)
        };
        problems.into_iter().map(diagnostic).collect()
    })
}

/// An option that says nothing that can be used.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refused {
    /// What was given.
    pub text: String,
    /// What is wrong with it, as a clause.
    pub reason: String,
}

impl Refused {
    fn new(text: &str, reason: impl Into<String>) -> Refused {
        Refused { text: text.to_string(), reason: reason.into() }
    }
}

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.text, self.reason)
    }
}

/// What a file says.
#[derive(Debug, Default)]
struct Contents {
    given: Vec<Given>,
    weighings: Vec<Weighing>,
}

/// What is read of a file, or the first thing in it that cannot be read.
type Read<T> = Result<T, Box<Diagnostic>>;

fn fault(span: Span, message: impl Into<String>) -> Box<Diagnostic> {
    Box::new(Diagnostic::error("bad-input-file", span, message))
}

fn steps(text: &str, span: Span) -> Result<Steps, Box<Diagnostic>> {
    Steps::read(text).map_err(|message| fault(span, message))
}

/// A whole file as a span, for faults that have no better place.
fn whole(file: FileId) -> Span {
    Span { file, start: 0, end: 0 }
}

/// A cell's or scalar's text as a value.
fn text(text: &str) -> Written {
    Written::Text(text.to_string())
}
