//! Links: the AsmetaL between braces, as text on one line, and the name that pictures show for it.

use syntax::ast::{self, AstNode, Rule, Term};
use syntax::{FileId, Span, SyntaxKind, SyntaxNode};

use crate::link::Link;

/// The text of a node on one line, without comments.
pub(crate) fn flat(node: &SyntaxNode) -> String {
    let mut text = String::new();
    let mut space = false;
    for token in node.descendants_with_tokens().filter_map(|element| element.into_token()) {
        if token.kind().is_trivia() {
            space = !text.is_empty();
            continue;
        }
        // A line break within parentheses leaves no space.
        let bracket = text.ends_with(['(', '[']) || [")", "]", ","].contains(&token.text());
        if std::mem::take(&mut space) && !bracket {
            text.push(' ');
        }
        text.push_str(token.text());
    }
    text
}

/// The contents of a link; `None` if it is empty.
pub(super) fn link(file: FileId, node: &ast::Link) -> Option<Link> {
    let inner = node.syntax().children().find(|child| child.kind() != SyntaxKind::ERROR);
    let (text, range) = match (&inner, node.rule_name()) {
        (Some(inner), _) => (flat(inner), syntax::ast::trimmed_range(inner)),
        (None, Some(name)) => (name.text().to_string(), name.text_range()),
        (None, None) => return None,
    };
    let first = node.syntax().descendants_with_tokens().filter_map(|element| element.into_token());
    let named = [SyntaxKind::RULE_ID, SyntaxKind::FUNCTION_ID, SyntaxKind::ENUM_ID, SyntaxKind::DOMAIN_ID];
    let name = first.filter(|token| named.contains(&token.kind())).map(|token| token.text().to_string()).next();
    let is_application = match inner {
        None => true,
        Some(inner) => {
            matches!(Term::cast(inner.clone()), Some(Term::Function(_) | Term::Enum(_)))
                || matches!(Rule::cast(inner), Some(Rule::MacroCall(_)))
        }
    };
    Some(Link { name: name.unwrap_or_else(|| text.clone()), text, is_application, span: Span::new(file, range) })
}

/// A name that a function can have.
pub(crate) fn names_function(name: &str) -> bool {
    let parse = syntax::parse_term(FileId(0), name);
    let term = ast::TermFile::cast(parse.syntax()).and_then(|file| file.term());
    parse.diagnostics.is_empty() && matches!(term, Some(Term::Function(_)))
}
