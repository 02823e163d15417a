//! The tree as text, for `groundstate dump tree` and golden tests.
//!
//! In: a node. Out: one line for each node or token: nodes with their byte range, tokens with their text in quotes.
//! White space is left out. The form is stable: tests of later stages pin it. The walk does not recurse, so any depth
//! is fine.

use crate::{SyntaxKind, SyntaxNode};
use rowan::{NodeOrToken, WalkEvent};
use std::fmt::Write;

/// The tree below a node, one line for each node and token.
pub fn dump(node: &SyntaxNode) -> String {
    let mut out = String::new();
    let mut depth = 0;
    for event in node.preorder_with_tokens() {
        match event {
            WalkEvent::Enter(NodeOrToken::Node(node)) => {
                let range = node.text_range();
                let (start, end) = (u32::from(range.start()), u32::from(range.end()));
                let _ = writeln!(out, "{:indent$}{:?} {start}..{end}", "", node.kind(), indent = 2 * depth);
                depth += 1;
            }
            WalkEvent::Enter(NodeOrToken::Token(token)) if token.kind() != SyntaxKind::WHITESPACE => {
                let _ = writeln!(out, "{:indent$}{:?} {:?}", "", token.kind(), token.text(), indent = 2 * depth);
            }
            WalkEvent::Leave(NodeOrToken::Node(_)) => depth -= 1,
            _ => {}
        }
    }
    out
}
