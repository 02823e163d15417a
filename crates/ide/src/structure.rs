//! What an editor does with the shape of a text alone: folding, growing selections, the whole file in its canonical layout.
//!
//! In: a tree, however broken. Out: ranges of bytes, or the new text.

use std::path::Path;

use groundstate::Kind;
use groundstate::workspace::Files;
use syntax::ast::trimmed_range;
use syntax::{FileId, Severity, SyntaxKind, SyntaxNode};

use crate::project::Project;

/// Why a part can be folded.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum FoldKind {
    /// Comments that follow each other.
    Comment,
    /// Imports that follow each other.
    Imports,
    /// All else.
    Region,
}

/// The parts of a file that take several lines, in the order of their beginnings.
pub fn folding<F: Files>(project: &mut Project<F>, path: &str) -> Vec<((u32, u32), FoldKind)> {
    let Some(tree) = project.analysis(path).ok().and_then(|analysis| analysis.tree()) else { return Vec::new() };
    let text = tree.text().to_string();
    let lines =
        |(start, end): (u32, u32)| text.get(start as usize..end as usize).is_some_and(|part| part.contains('\n'));
    let mut found: Vec<((u32, u32), FoldKind)> = Vec::new();
    for node in tree.descendants().skip(1).filter(|node| folds(node.kind())) {
        let range = range(&node);
        if lines(range) {
            found.push((range, FoldKind::Region));
        }
    }
    let imports: Vec<(u32, u32)> =
        tree.children().filter(|node| node.kind() == SyntaxKind::IMPORT).map(|node| range(&node)).collect();
    if let (Some(first), Some(last)) = (imports.first(), imports.last())
        && lines((first.0, last.1))
    {
        found.push(((first.0, last.1), FoldKind::Imports));
    }
    found.extend(comments(&tree).into_iter().filter(|range| lines(*range)).map(|range| (range, FoldKind::Comment)));
    found.sort();
    found.dedup();
    found
}

fn folds(kind: SyntaxKind) -> bool {
    use SyntaxKind::*;
    matches!(
        kind,
        SIGNATURE
            | DEFINITIONS
            | RULE_DECL
            | FUNCTION_DEF
            | INIT
            | PAR_RULE
            | SEQ_RULE
            | IF_RULE
            | CHOOSE_RULE
            | FORALL_RULE
            | LET_RULE
            | EXTEND_RULE
            | ITERATE_RULE
            | WHILE_RULE
            | RECURSIVE_WHILE_RULE
            | SWITCH_RULE
            | LOCAL_RULE
            | IF_TERM
            | SWITCH_TERM
            | ENUM_DOMAIN_DECL
            | BLOCK
            | MACHINE_CHART
            | SYSTEM_CHART
            | COMPONENT
            | LAYOUT
    )
}

fn range(node: &SyntaxNode) -> (u32, u32) {
    let range = trimmed_range(node);
    (range.start().into(), range.end().into())
}

/// Comments with nothing but white space between them, as one.
fn comments(tree: &SyntaxNode) -> Vec<(u32, u32)> {
    let mut found: Vec<(u32, u32)> = Vec::new();
    let mut joined = false;
    for token in tree.descendants_with_tokens().filter_map(|element| element.into_token()) {
        let (start, end): (u32, u32) = (token.text_range().start().into(), token.text_range().end().into());
        match token.kind() {
            SyntaxKind::LINE_COMMENT | SyntaxKind::BLOCK_COMMENT => {
                match found.last_mut().filter(|_| joined) {
                    Some(last) => last.1 = end,
                    None => found.push((start, end)),
                }
                joined = true;
            }
            SyntaxKind::WHITESPACE => joined &= token.text().matches('\n').count() < 2,
            _ => joined = false,
        }
    }
    found
}

/// Ever larger parts of the file around an offset, the smallest first.
pub fn selections<F: Files>(project: &mut Project<F>, path: &str, offset: u32) -> Vec<(u32, u32)> {
    let Ok(analysis) = project.analysis(path) else { return Vec::new() };
    let Some(token) = analysis.token_at(offset) else { return Vec::new() };
    let of_token = (token.text_range().start().into(), token.text_range().end().into());
    let mut found = vec![of_token];
    found.extend(token.parent_ancestors().map(|node| range(&node)));
    found.push((0, analysis.text().len() as u32));
    found.dedup();
    found
}

/// The file in its canonical layout.
///
/// # Errors
/// It has faults, or is of a kind that has no canonical layout.
pub fn formatted<F: Files>(project: &mut Project<F>, path: &str) -> Result<String, String> {
    let analysis = project.analysis(path).map_err(|absent| absent.told(path))?;
    if Kind::of(Path::new(path)) == Some(Kind::Coupling) {
        return formatted_text(path, analysis.text());
    }
    match analysis.parse() {
        None => Err("only models, scenarios, charts and couplings have a canonical layout".to_string()),
        Some(parse) if parse.diagnostics.iter().any(|fault| fault.severity == Severity::Error) => {
            Err("a text with errors is not formatted".to_string())
        }
        Some(parse) => Ok(syntax::format(parse)),
    }
}

/// A coupling's text in its canonical layout.
///
/// # Errors
/// It has faults, or is of another kind.
pub fn formatted_text(path: &str, text: &str) -> Result<String, String> {
    match Kind::of(Path::new(path)) {
        Some(Kind::Coupling) => {
            let formatted = groundstate::refine::format(FileId(0), text);
            formatted.map_err(|_| "a text with errors is not formatted".to_string())
        }
        _ => Err("only models, scenarios, charts and couplings have a canonical layout".to_string()),
    }
}
