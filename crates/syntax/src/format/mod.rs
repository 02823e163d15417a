//! The canonical layout of a model or scenario.
//!
//! In: a parse without errors. Out: its text with tabs for indentation, one rule, declaration or command on each line,
//! long lines folded, and at most one blank line between neighbours. INVARIANT: the tokens and the comments stay the
//! same and in order, so the meaning stays the same; formatting twice changes nothing more.
//!
//! `layout` decides where a node's parts go, `document` holds what is printed, `printer` folds the lines.

mod comment;
mod document;
mod layout;
mod printer;
mod separator;

use crate::{Parse, Severity, SyntaxKind};
use document::Document;

/// The greatest width of a line, where a tab counts as four columns.
pub const WIDTH: usize = 120;

/// Formats a file. A faulty file is returned unchanged.
///
/// ```
/// let parse = syntax::parse_asmetal(syntax::FileId(0), "asm a signature: definitions: main rule r_Main=par x:=1 skip endpar");
/// assert_eq!(
///     syntax::format(&parse),
///     "asm a\n\nsignature:\n\ndefinitions:\n\tmain rule r_Main =\n\t\tpar\n\t\t\tx := 1\n\t\t\tskip\n\t\tendpar\n"
/// );
/// ```
pub fn format(parse: &Parse) -> String {
    let root = parse.syntax();
    if parse.diagnostics.iter().any(|fault| fault.severity == Severity::Error) {
        return root.text().to_string();
    }
    let document =
        Document::Concat(vec![comment::at_start_of_file(&root), layout::node(&root), comment::at_end_of_file(&root)]);
    let mut text = printer::print(&document);
    if root.kind() != SyntaxKind::TERM_FILE && !text.is_empty() {
        text.push('\n');
    }
    text
}
