//! Links from a chart to its specification.

use syntax::Span;

/// A piece of AsmetaL that a shape stands for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Link {
    /// The term or rule, on one line, without comments.
    pub text: String,
    /// The name that the picture shows: of the function, literal or rule that it begins with.
    pub name: String,
    /// It is this name applied to arguments and nothing else.
    pub is_application: bool,
    /// Where it stands.
    pub span: Span,
}
