//! What an application of a function is.

use crate::builtin::Builtin;

/// What an application of a function is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Meaning {
    /// A location.
    Read,
    /// Its definition.
    Define,
    /// A fault: it has no definition and is no element.
    Missing,
    /// An operation of the library.
    Builtin(Builtin),
    /// Just its argument of that index: unary plus, `first(1, 2)`.
    Argument(usize),
}
