//! Where the parts of each node go: what separates a part from the one before, and whether it is indented.
//!
//! In: a node. Out: its document. All nodes are treated alike: the parts come in order, each with the separator that
//! [`part`] gives; a term is a group; in a rule or section, the parts between two line ends are a group.

use super::comment;
use super::document::Document;
use super::separator::{Separator, Separator::*, is_rule, part};
use crate::SyntaxKind::{self, *};
use crate::{SyntaxElement, SyntaxNode, SyntaxToken};
use rowan::NodeOrToken;

/// The document of a node.
pub(super) fn node(node: &SyntaxNode) -> Document {
    if node.kind() == BINARY_TERM {
        return indent(vec![chain(node)]);
    }
    let mut lines = Vec::new();
    let mut line = Vec::new();
    let mut before: Option<SyntaxKind> = None;
    let mut first_own = true;
    for element in node.children_with_tokens().filter(|element| !element.kind().is_trivia()) {
        let Some(previous) = before.replace(element.kind()) else {
            line.push(starting(&element)); // the comments before it are printed by the node around
            continue;
        };
        let separator = part(node, previous, &element);
        match separator {
            Own | OwnIndented | OwnIndentedTwice | Section => {
                lines.push(group(std::mem::take(&mut line)));
                lines.push(own_line(
                    &element,
                    separator,
                    !first_own || matches!(node.kind(), SOURCE_FILE | SCENARIO_FILE),
                ));
                first_own = !matches!(separator, OwnIndented | OwnIndentedTwice);
            }
            FoldAlone if is_rule(element.kind()) => {
                lines.push(group(std::mem::take(&mut line)));
                lines.push(in_line(&element, separator));
            }
            _ => line.push(in_line(&element, separator)),
        }
    }
    if node.kind() == CONDITIONAL_BRANCH {
        lines.extend(line); // it is folded when the whole `if` is
    } else {
        lines.push(group(line));
    }
    Document::Concat(lines)
}

/// A chain of operators of one level, which is folded before the operators; they stand below the first operand.
fn chain(top: &SyntaxNode) -> Document {
    let mut rests = Vec::new();
    let mut first = top.clone();
    while first.kind() == BINARY_TERM && level(&first) == level(top) {
        let mut parts = first.children_with_tokens().filter(|element| !element.kind().is_trivia());
        let left = parts.next();
        rests.push(parts.collect::<Vec<SyntaxElement>>());
        let Some(NodeOrToken::Node(left)) = left else { break };
        first = left;
    }
    let mut parts = vec![node(&first)];
    for rest in rests.iter().rev() {
        let rest = rest.iter().enumerate().map(|(index, part)| in_line(part, if index == 0 { Line } else { Space }));
        parts.extend(rest);
    }
    group(parts)
}

/// The level of the operator of a binary term.
fn level(node: &SyntaxNode) -> Option<u8> {
    let operator =
        node.children_with_tokens().filter_map(NodeOrToken::into_token).find(|token| !token.kind().is_trivia());
    operator.and_then(|operator| crate::grammar::power_of(operator.text()))
}

fn group(parts: Vec<Document>) -> Document {
    Document::Group(Box::new(Document::Concat(parts)))
}

fn indent(parts: Vec<Document>) -> Document {
    Document::Indent(Box::new(Document::Concat(parts)))
}

/// A part that starts a line.
fn own_line(element: &SyntaxElement, separator: Separator, blanks: bool) -> Document {
    let Some(first) = first_token(element) else { return Document::nothing() };
    let gap = comment::gap(&first, blanks);
    let body = folded(element);
    match separator {
        OwnIndented => indent(vec![gap.inner, gap.outer, body]),
        OwnIndentedTwice => indent(vec![indent(vec![gap.inner, gap.outer, body])]),
        Section => Document::Concat(vec![indent(vec![gap.inner]), Document::BlankLine, gap.outer, body]),
        _ => Document::Concat(vec![indent(vec![gap.inner]), gap.outer, body]),
    }
}

/// A part that continues a line.
fn in_line(element: &SyntaxElement, separator: Separator) -> Document {
    let mut parts = match first_token(element) {
        Some(first) => comment::within_line(&first),
        None => Vec::new(),
    };
    parts.push(match separator {
        Fold | SoftFold | FoldAlone | FoldAloneTwice => folded(element),
        _ => starting(element),
    });
    let with = |separator: Document, mut parts: Vec<Document>| {
        parts.insert(0, separator);
        parts
    };
    match separator {
        Space => Document::Concat(with(Document::Space, parts)),
        Fold => indent(with(Document::Line, parts)),
        Break => Document::Concat(with(Document::HardLine, parts)),
        FoldAlone => group(vec![indent(with(Document::Line, parts))]),
        FoldAloneTwice => group(vec![indent(vec![indent(with(Document::Line, parts))])]),
        SoftFold => indent(with(Document::SoftLine, parts)),
        Line => Document::Concat(with(Document::Line, parts)),
        _ => Document::Concat(parts),
    }
}

/// A part whose comments before it are printed already.
fn starting(element: &SyntaxElement) -> Document {
    match element {
        NodeOrToken::Node(child) => node(child),
        NodeOrToken::Token(token) => text(token),
    }
}

/// A part on a line of its own, indented already.
fn folded(element: &SyntaxElement) -> Document {
    match element {
        NodeOrToken::Node(child) if child.kind() == BINARY_TERM => chain(child),
        _ => starting(element),
    }
}

fn text(token: &SyntaxToken) -> Document {
    let mut parts = vec![Document::Text(token.text().to_string())];
    parts.extend(comment::behind(token));
    Document::Concat(parts)
}

fn first_token(element: &SyntaxElement) -> Option<SyntaxToken> {
    match element {
        NodeOrToken::Node(node) => node.first_token(),
        NodeOrToken::Token(token) => Some(token.clone()),
    }
}
