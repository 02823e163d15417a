//! The tree as short text, for the unit tests of the grammar: `BINARY(a + b)`.
//!
//! A node is its kind without the last word, with its children in parentheses; a token is its text. A node too long for
//! a line has a line for each child. The ids of the faults stand after the tree.

use crate::{FileId, Parse, SyntaxNode};
use rowan::{Direction, NodeOrToken};

const WIDTH: usize = 70;

/// A term's tree.
pub(super) fn term(text: &str) -> String {
    whole(&crate::parse_term(FileId(0), text))
}

/// The tree of a file.
pub(super) fn file(text: &str) -> String {
    whole(&crate::parse_asmetal(FileId(0), text))
}

/// The tree of a scenario.
pub(super) fn scenario(text: &str) -> String {
    whole(&crate::parse_avalla(FileId(0), text))
}

/// The tree of a chart.
pub(super) fn chart(text: &str) -> String {
    whole(&crate::parse_chart(FileId(0), text))
}

/// The tree of a rule, and of what stands after it.
pub(super) fn rule(text: &str) -> String {
    let parse = crate::parse_asmetal(FileId(0), &format!("asm a signature: definitions: rule r_a = {text}"));
    let declaration = parse.syntax().descendants().find(|node| node.kind() == crate::SyntaxKind::RULE_DECL);
    let body = declaration.iter().flat_map(|node| node.children());
    let behind = declaration.iter().flat_map(|node| node.siblings(Direction::Next).skip(1));
    with_faults(body.chain(behind).map(|node| of_node(&node, 0)).collect(), &parse)
}

fn whole(parse: &Parse) -> String {
    with_faults(children(&parse.syntax(), 0), parse)
}

fn with_faults(mut parts: Vec<String>, parse: &Parse) -> String {
    parts.extend(parse.diagnostics.iter().map(|fault| format!("!{}", fault.id)));
    joined(&parts, 0)
}

fn of_node(node: &SyntaxNode, indent: usize) -> String {
    let name = format!("{:?}", node.kind());
    let ends = ["_TERM", "_RULE", "_COMMAND", "_DOMAIN", "_DECL"];
    let name = ends.iter().find_map(|end| name.strip_suffix(end)).unwrap_or(&name).to_string();
    let flat = children(node, 0);
    match name.as_str() {
        "LITERAL" | "VARIABLE" | "ENUM" | "FUNCTION" | "NAMED" | "NAME_REF" if flat.len() == 1 => return flat.concat(),
        _ => {}
    }
    let line = format!("{name}({})", flat.join(" "));
    if line.len() + indent <= WIDTH && !line.contains('\n') {
        return line;
    }
    let margin = " ".repeat(indent + 2);
    let lines: Vec<String> = children(node, indent + 2).iter().map(|part| format!("\n{margin}{part}")).collect();
    format!("{name}({})", lines.concat())
}

fn children(node: &SyntaxNode, indent: usize) -> Vec<String> {
    let parts = node.children_with_tokens().filter_map(|element| match element {
        NodeOrToken::Node(node) => Some(of_node(&node, indent)),
        NodeOrToken::Token(token) => (!token.kind().is_trivia()).then(|| token.text().to_string()),
    });
    parts.collect()
}

fn joined(parts: &[String], indent: usize) -> String {
    let line = parts.join(" ");
    if line.len() + indent <= WIDTH && !line.contains('\n') { line } else { parts.join("\n") }
}
