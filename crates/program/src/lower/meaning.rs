//! The meaning of an application of a function.

use crate::builtin::Builtin;

/// The meaning of an application of a function.
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
    /// Its argument with this index: unary plus, `first(1, 2)`.
    Argument(usize),
}
