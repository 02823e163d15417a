//! Places in a tree: ranges without the trivia around a node.

use syntax::ast::trimmed_range;
use syntax::{SyntaxKind, SyntaxNode, SyntaxToken};

/// A range as facts have it.
pub(crate) fn at(range: impl Into<std::ops::Range<u32>>) -> (u32, u32) {
    let range = range.into();
    (range.start, range.end)
}

/// The bytes of a node.
pub(crate) fn bytes(node: &SyntaxNode) -> std::ops::Range<usize> {
    trimmed_range(node).into()
}

/// The node inside any parentheses.
pub(crate) fn inside(node: &SyntaxNode) -> SyntaxNode {
    let mut node = node.clone();
    while node.kind() == SyntaxKind::PAREN_TERM
        && let Some(child) = node.first_child()
    {
        node = child;
    }
    node
}

/// The tokens of a node itself that are no trivia.
pub(crate) fn tokens(node: &SyntaxNode) -> impl Iterator<Item = SyntaxToken> {
    node.children_with_tokens().filter_map(|element| element.into_token()).filter(|token| !token.kind().is_trivia())
}
