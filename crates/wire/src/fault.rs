//! Faults and failures as JSON objects.
//!
//! In: diagnostics with their texts; for a failure of the world, the shell's words. Out: [`Fault`], [`WorldFailure`].

use serde::Serialize;
use syntax::{Diagnostic, Severity, Sources, Span};

/// A range of a source text. Lines and columns count from 1, columns in characters. The end is the first character
/// after the range.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Place {
    file: String,
    line: u32,
    column: u32,
    end_line: u32,
    end_column: u32,
}

impl Place {
    /// The range as lines and columns.
    pub fn new(sources: &Sources, span: Span) -> Place {
        let file = sources.file(span.file);
        let (start, end) = (file.line_column(span.start), file.line_column(span.end));
        Place {
            file: file.name.clone(),
            line: start.line,
            column: start.column,
            end_line: end.line,
            end_column: end.column,
        }
    }
}

#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Label<'a> {
    #[serde(flatten)]
    place: Place,
    text: &'a str,
}

/// `{"type":"fault",…}`
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Fault<'a> {
    #[cfg_attr(test, schemars(extend("const" = "fault")))]
    r#type: &'static str,
    id: &'static str,
    severity: &'static str,
    message: &'a str,
    #[serde(flatten)]
    place: Place,
    reason: &'a str,
    labels: Vec<Label<'a>>,
    help: Option<&'a str>,
}

impl<'a> Fault<'a> {
    /// The fault.
    pub fn new(sources: &Sources, diagnostic: &'a Diagnostic) -> Fault<'a> {
        let label = |label: &'a syntax::Label| Label { place: Place::new(sources, label.span), text: &label.text };
        Fault {
            r#type: "fault",
            id: diagnostic.id,
            severity: match diagnostic.severity {
                Severity::Error => "error",
                Severity::Warning => "warning",
                Severity::Note => "note",
            },
            message: &diagnostic.message,
            place: Place::new(sources, diagnostic.primary.span),
            reason: &diagnostic.primary.text,
            labels: diagnostic.secondary.iter().map(label).collect(),
            help: diagnostic.help.as_deref(),
        }
    }
}

/// `{"type":"failure",…}`: a failure of the world, not of the model.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct WorldFailure {
    #[cfg_attr(test, schemars(extend("const" = "failure")))]
    r#type: &'static str,
    id: &'static str,
    message: String,
    help: Option<String>,
}

impl WorldFailure {
    /// The failure: its kebab-case name, a sentence, what to do.
    pub fn new(id: &'static str, message: String, help: Option<String>) -> Self {
        WorldFailure { r#type: "failure", id, message, help }
    }
}
