//! The working memory of compiled code.

use crate::value::Value;

/// The working memory of compiled code, kept from step to step.
#[derive(Debug, Default)]
pub(super) struct Memory {
    /// Values that a term needs while it is evaluated.
    pub(super) temporaries: Vec<Value>,
    /// Candidates of choices that are being collected.
    pub(super) candidates: Vec<Value>,
}
