//! The faults that checking reports: one function for each kind, grouped by subject.
//!
//! In: the names, domains and places involved. Out: a [`Diagnostic`]. This module only words the faults. The code
//! that checks a rule of the language decides whether there is one. INVARIANT: every id is in [`IDS`] and has a page
//! `spec/faults/<id>.md`.

pub(crate) mod domain;
pub(crate) mod function;
pub(crate) mod import;
pub(crate) mod name;
pub(crate) mod property;
pub(crate) mod rule;
pub(crate) mod term;

/// The ids of all faults that checking a model may report.
pub const IDS: &[&str] = &[
    "agent-without-program",
    "argument-count",
    "argument-domain",
    "branch-domains",
    "case-never-matches",
    "circular-import",
    "concrete-over-concrete",
    "define-dynamic-function",
    "definition-domain",
    "domain-contents",
    "domain-in-capitals",
    "domain-not-definable",
    "domain-without-contents",
    "duplicate-default-init",
    "duplicate-definition",
    "duplicate-domain",
    "duplicate-element",
    "duplicate-enum-literal",
    "duplicate-function",
    "duplicate-parameter",
    "duplicate-property",
    "duplicate-rule",
    "dynamic-in-static",
    "element-domains",
    "empty-range",
    "endless-definition",
    "extend-static-domain",
    "file-name-mismatch",
    "guard-not-boolean",
    "import-not-found",
    "import-without-export",
    "init-static-function",
    "library-copy",
    "library-path",
    "main-with-parameters",
    "malformed-character",
    "missing-default-init",
    "missing-standard-library",
    "narrower-domain",
    "never-begins",
    "no-such-overload",
    "not-a-collection",
    "not-a-location",
    "not-a-rule",
    "not-basic-domain",
    "not-exported",
    "number-too-large",
    "over-unknown-name",
    "property-not-boolean",
    "range-bounds",
    "recursive-macro-rule",
    "return-lost",
    "rule-argument-count",
    "rule-argument-domain",
    "rule-call-brackets",
    "rule-without-result",
    "static-derived-function",
    "undeclared-definition",
    "undefined-function",
    "unknown-domain",
    "unknown-enum-literal",
    "unknown-function",
    "unknown-name-exported",
    "unknown-rule",
    "unknown-variable",
    "update-domain",
    "update-not-allowed",
    "update-of-variable",
];

use syntax::{Diagnostic, Severity, Span};

/// The faults found so far.
#[derive(Debug, Default)]
pub(crate) struct Faults {
    list: Vec<Diagnostic>,
    library_reported: bool,
}

impl Faults {
    /// Adds a fault.
    pub(crate) fn push(&mut self, fault: Diagnostic) {
        debug_assert!(IDS.contains(&fault.id), "{} is not listed", fault.id);
        self.list.push(fault);
    }

    /// A fault was just reported at or inside this place.
    pub(crate) fn has_at(&self, span: Span) -> bool {
        let inside = |other: Span| other.file == span.file && span.start <= other.start && other.end <= span.end;
        self.list.iter().rev().take(8).any(|fault| inside(fault.primary.span))
    }

    /// Some fault is an error.
    pub(crate) fn has_errors(&self) -> bool {
        self.list.iter().any(|fault| fault.severity == Severity::Error)
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.list.len()
    }

    /// Changes those that came after the first `from`.
    pub(crate) fn amend(&mut self, from: usize, change: impl FnMut(&mut Diagnostic)) {
        self.list.iter_mut().skip(from).for_each(change);
    }

    /// Adds faults of an earlier stage.
    pub(crate) fn extend(&mut self, faults: impl IntoIterator<Item = Diagnostic>) {
        self.list.extend(faults);
    }

    /// Adds the fault that the standard library is not imported, once for a model.
    pub(crate) fn missing_library(&mut self, fault: Diagnostic) {
        if !std::mem::replace(&mut self.library_reported, true) {
            self.push(fault);
        }
    }

    /// After a name that is a keyword, the text does not mean what it says: from there on only the fault of the name
    /// counts.
    fn drop_what_follows_from_keywords(&mut self) {
        let names = self.list.iter().filter(|fault| fault.id == "keyword-as-name");
        let places: Vec<Span> = names.map(|fault| fault.primary.span).collect();
        self.list.retain(|fault| {
            let place = fault.primary.span;
            let behind = places.iter().any(|name| name.file == place.file && name.start < place.start);
            !behind || fault.id == "keyword-as-name" || syntax::FAULT_IDS.contains(&fault.id)
        });
    }

    /// All faults, in the order of files and positions.
    pub(crate) fn into_sorted(mut self) -> Vec<Diagnostic> {
        self.drop_what_follows_from_keywords();
        self.list.sort_by_key(|fault| (fault.primary.span.file, fault.primary.span.start));
        self.list
    }
}

/// `1 argument`, `2 arguments`
pub(crate) fn count(n: usize, noun: &str) -> String {
    match n {
        1 => format!("1 {noun}"),
        _ => format!("{n} {noun}s"),
    }
}

/// `A`, `A and B`, `A, B and C`
pub(crate) fn list(items: &[String]) -> String {
    match items {
        [] => "nothing".to_string(),
        [one] => one.clone(),
        [front @ .., last] => format!("{} and {last}", front.join(", ")),
    }
}

/// Says that a term of one domain is where another is expected.
pub(crate) struct Mismatch {
    /// What is expected.
    pub(crate) expected: String,
    /// What the term is.
    pub(crate) found: String,
    /// A function of the standard library that converts the one into the other.
    pub(crate) conversion: Option<&'static str>,
}

impl Mismatch {
    fn reason(&self) -> String {
        format!("{}, where {} is expected", self.found, self.expected)
    }

    fn help(&self) -> String {
        match self.conversion {
            Some("iton") => "if it is never negative, convert it: `iton(…)`".to_string(),
            Some(function) => format!("convert it: `{function}(…)`"),
            None => format!("give a term of domain {}", self.expected),
        }
    }
}
