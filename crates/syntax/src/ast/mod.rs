//! Typed views of the lossless tree. Later stages read the tree through them.
//!
//! A view is a cheap handle on a [`SyntaxNode`]. Every accessor may give `None` (or an empty iterator), because the
//! tree of a faulty text has holes. The parser has already reported them, so a reader skips them silently.

mod chart;
mod file;
mod rule;
mod scenario;
mod system;
mod term;

pub use chart::*;
pub use file::*;
pub use rule::*;
pub use scenario::*;
pub use system::*;
pub use term::*;

use crate::{AsmetaL, SyntaxKind, SyntaxNode, SyntaxToken};

/// A typed view of a node.
pub trait AstNode: Sized {
    /// Views the node, if it is of this type.
    fn cast(node: SyntaxNode) -> Option<Self>;
    /// The node viewed.
    fn syntax(&self) -> &SyntaxNode;

    /// The byte range without leading and trailing trivia.
    fn range(&self) -> rowan::TextRange {
        trimmed_range(self.syntax())
    }
}

/// The byte range of a node without the trivia at its ends.
///
/// INVARIANT: the parser puts trivia outside the nodes it separates, so only a root has trivia at its ends, and
/// looking at its own children is enough. For all other nodes this takes constant time.
pub fn trimmed_range(node: &SyntaxNode) -> rowan::TextRange {
    if node.parent().is_some() {
        return node.text_range();
    }
    let trivia = |element: &crate::SyntaxElement| element.kind().is_trivia();
    let mut first = node.first_child_or_token();
    while let Some(element) = first.as_ref().filter(|element| trivia(element)) {
        first = element.next_sibling_or_token();
    }
    let mut last = node.last_child_or_token();
    while let Some(element) = last.as_ref().filter(|element| trivia(element)) {
        last = element.prev_sibling_or_token();
    }
    match (first, last) {
        (Some(first), Some(last)) => rowan::TextRange::new(first.text_range().start(), last.text_range().end()),
        _ => rowan::TextRange::empty(node.text_range().start()),
    }
}

/// Iterates over the children of one view type.
pub type Children<N> = std::iter::FilterMap<rowan::SyntaxNodeChildren<AsmetaL>, fn(SyntaxNode) -> Option<N>>;

pub(crate) fn children<N: AstNode>(node: &SyntaxNode) -> Children<N> {
    node.children().filter_map(N::cast)
}

pub(crate) fn child<N: AstNode>(node: &SyntaxNode) -> Option<N> {
    children(node).next()
}

pub(crate) fn nth<N: AstNode>(node: &SyntaxNode, index: usize) -> Option<N> {
    children(node).nth(index)
}

pub(crate) fn tokens(node: &SyntaxNode) -> impl Iterator<Item = SyntaxToken> {
    node.children_with_tokens().filter_map(|element| element.into_token()).filter(|token| !token.kind().is_trivia())
}

pub(crate) fn token(node: &SyntaxNode, kind: SyntaxKind) -> Option<SyntaxToken> {
    tokens(node).find(|token| token.kind() == kind)
}

/// Declares typed views of single node kinds.
macro_rules! nodes {
    ($($(#[$meta:meta])* $name:ident = $kind:ident),* $(,)?) => {$(
        $(#[$meta])*
        #[derive(Debug, Clone, PartialEq, Eq, Hash)]
        pub struct $name(crate::SyntaxNode);

        impl crate::ast::AstNode for $name {
            fn cast(node: crate::SyntaxNode) -> Option<Self> {
                (node.kind() == crate::SyntaxKind::$kind).then_some($name(node))
            }
            fn syntax(&self) -> &crate::SyntaxNode {
                &self.0
            }
        }
    )*};
}

/// Declares a view that is one of several.
macro_rules! choice {
    ($(#[$meta:meta])* $name:ident { $($variant:ident($node:ident)),* $(,)? }) => {
        $(#[$meta])*
        #[derive(Debug, Clone, PartialEq, Eq, Hash)]
        #[allow(missing_docs, reason = "each variant is documented at its node")]
        pub enum $name { $($variant($node)),* }

        impl crate::ast::AstNode for $name {
            fn cast(node: crate::SyntaxNode) -> Option<Self> {
                None$(.or_else(|| $node::cast(node.clone()).map($name::$variant)))*
            }
            fn syntax(&self) -> &crate::SyntaxNode {
                match self { $($name::$variant(node) => node.syntax()),* }
            }
        }
    };
}

use choice;
use nodes;
