//! Changes of a text at places of its tree.

use syntax::SyntaxNode;
use syntax::ast::trimmed_range;

/// One change of the text.
pub(super) struct Edit {
    pub(super) start: usize,
    pub(super) end: usize,
    pub(super) text: String,
}

impl Edit {
    /// A text in the place of a node.
    pub(super) fn replacing(node: &SyntaxNode, text: String) -> Edit {
        let range = trimmed_range(node);
        Edit { start: range.start().into(), end: range.end().into(), text }
    }
}

/// The text with all changes.
pub(super) fn apply(text: &str, mut edits: Vec<Edit>) -> String {
    edits.sort_by_key(|edit| (edit.start, edit.end));
    let mut out = String::new();
    let mut at = 0;
    for edit in edits {
        out.push_str(&text[at..edit.start]);
        out.push_str(&edit.text);
        at = edit.end;
    }
    out + &text[at..]
}
