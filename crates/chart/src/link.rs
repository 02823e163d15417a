//! Links from a chart to its specification.

use syntax::Span;

/// The AsmetaL that a shape stands for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Link {
    /// The term or rule, on one line, without comments.
    pub text: String,
    /// The name that the picture shows: of the first function, literal or rule in it.
    pub name: String,
    /// Whether it is only this name applied to arguments.
    pub is_application: bool,
    /// Where it stands.
    pub span: Span,
}
