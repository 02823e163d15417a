//! Faults in a user's text, as data: what is wrong, where, why, and what to do.
//!
//! Every stage adds its faults beside its result; shells render them (text or JSON). A diagnostic's `id` is
//! kebab-case and names its page `spec/faults/<id>.md`, which `groundstate explain <id>` shows.

use crate::span::Span;

/// How bad a fault is. Only an `Error` stops the flow after the stage that found it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// The model means nothing, or not what its author thinks.
    Error,
    /// The model means something, but likely not what its author thinks.
    Warning,
    /// A remark.
    Note,
}

/// A place that a diagnostic points to, with what to see there.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Label {
    /// Where.
    pub span: Span,
    /// What is seen there; may be empty for the primary one.
    pub text: String,
}

/// One fault.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostic {
    /// Kebab-case name of the kind of fault.
    pub id: &'static str,
    /// How bad.
    pub severity: Severity,
    /// One sentence, lower case first, no full stop: what is wrong.
    pub message: String,
    /// Where it is wrong.
    pub primary: Label,
    /// Other places that matter: the first declaration, the other rule of a clash.
    pub secondary: Vec<Label>,
    /// What to do about it.
    pub help: Option<String>,
}

impl Diagnostic {
    /// An error at a place.
    pub fn error(id: &'static str, span: Span, message: impl Into<String>) -> Self {
        Diagnostic {
            id,
            severity: Severity::Error,
            message: message.into(),
            primary: Label { span, text: String::new() },
            secondary: Vec::new(),
            help: None,
        }
    }

    /// A warning at a place.
    pub fn warning(id: &'static str, span: Span, message: impl Into<String>) -> Self {
        Diagnostic { severity: Severity::Warning, ..Diagnostic::error(id, span, message) }
    }

    /// Says what is seen at the primary place. It adds to the message, never repeats it.
    pub fn here(mut self, seen: impl Into<String>) -> Self {
        self.primary.text = seen.into();
        self
    }

    /// Points to another place.
    pub fn with_label(mut self, span: Span, text: impl Into<String>) -> Self {
        self.secondary.push(Label { span, text: text.into() });
        self
    }

    /// Says what to do.
    pub fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}
