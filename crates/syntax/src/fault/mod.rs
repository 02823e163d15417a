//! The faults of syntax: one constructor each, so that all their texts stand together.
//!
//! In: the place and what stands there. Out: a [`crate::Diagnostic`] whose id is one of [`IDS`] and has a page
//! `spec/faults/<id>.md`. Each message says what is wrong, the reason what was expected, the help what to write.

mod lexical;
mod structure;
mod wording;

pub(crate) use lexical::*;
pub(crate) use structure::*;

/// The ids of all faults this crate reports, in alphabetical order.
pub const IDS: &[&str] = &[
    "assign-in-term",
    "domain-arity",
    "duplicate-section",
    "equals-for-assign",
    "expected-command",
    "expected-definition",
    "expected-domain",
    "expected-name",
    "expected-rule",
    "expected-shape",
    "expected-term",
    "expected-token",
    "file-too-large",
    "foreign-operator",
    "keyword-as-name",
    "misplaced-branch",
    "misplaced-section",
    "missing-brackets",
    "missing-end",
    "missing-section",
    "name-class",
    "nested-too-deeply",
    "not-utf8",
    "number-form",
    "quantifier-parentheses",
    "rule-in-term",
    "several-rules",
    "stray-end",
    "term-as-rule",
    "too-many-faults",
    "unexpected-text",
    "unknown-character",
    "unknown-escape",
    "unterminated-character",
    "unterminated-comment",
    "unterminated-string",
];
