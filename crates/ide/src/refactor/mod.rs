//! Refactorings: edits after which the model means what it meant.
//!
//! In: a model and a range of it. Out: [`Refactoring`]s. They are made on the tree: what is not taken from its place keeps its
//! bytes. INVARIANT: what is offered was made to a copy first, and the copy has the faults that the model has, and its names
//! mean the same. A text that cannot be parsed is left alone.

mod extract;
mod inline;
mod ladder;
mod parallel;

use std::path::Path;

use groundstate::Kind;
use groundstate::workspace::Files;
use model::Referent;
use syntax::ast::{self, AstNode, trimmed_range};
use syntax::{Severity, SyntaxKind, SyntaxNode, SyntaxToken};

use crate::analysis::Analysis;
use crate::position::{Edit, edited};
use crate::project::{Overlaid, Project, library_text};

/// What is done.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum RefactoringKind {
    /// Something gets a name.
    Extract,
    /// What has a name is written in its place.
    Inline,
    /// The same is written otherwise.
    Rewrite,
}

/// See the module.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refactoring {
    /// What it does.
    pub title: String,
    /// Of which kind it is.
    pub kind: RefactoringKind,
    /// The edits of the file.
    pub edits: Vec<Edit>,
}

/// One that is not proved yet.
struct Candidate {
    refactoring: Refactoring,
    /// What the names of the file are to mean afterwards; none where they may change.
    names: Option<Vec<Referent>>,
}

impl Candidate {
    fn new(title: impl Into<String>, kind: RefactoringKind, edits: Vec<Edit>) -> Candidate {
        Candidate { refactoring: Refactoring { title: title.into(), kind, edits }, names: None }
    }

    fn naming(mut self, names: Vec<Referent>) -> Candidate {
        self.names = Some(names);
        self
    }
}

/// What can be done at a range: to the rules that it covers, or to the rule that it begins in.
pub fn refactorings<F: Files>(project: &mut Project<F>, path: &str, range: (u32, u32)) -> Vec<Refactoring> {
    if Kind::of(Path::new(path)) != Some(Kind::Model) || library_text(path).is_some() {
        return Vec::new();
    }
    let Ok(analysis) = project.analysis(path) else { return Vec::new() };
    let broken = |fault: &syntax::Diagnostic| fault.severity == Severity::Error;
    if analysis.parse().is_none_or(|parse| parse.diagnostics.iter().any(broken)) {
        return Vec::new();
    }
    let mut found: Vec<Candidate> = Vec::new();
    let chosen = chosen(&analysis, range);
    if !chosen.is_empty() {
        let name = extract::fresh_name(project, &analysis);
        found.extend(extract::extract(&analysis, &chosen, &name));
        found.extend(parallel::wrap(&analysis, &chosen));
    }
    if let Some(token) = analysis.token_at(range.0) {
        found.extend(inline::inline(&analysis, &token));
        found.extend(parallel::merge(&analysis, &token));
        found.extend(ladder::rewrite(&analysis, &token));
    }
    found.retain(|candidate| holds(project, path, &analysis, candidate));
    found.into_iter().map(|candidate| candidate.refactoring).collect()
}

/// Makes the edits to a copy, and looks whether it has the same faults and names.
fn holds<F: Files>(project: &mut Project<F>, path: &str, before: &Analysis, candidate: &Candidate) -> bool {
    let text = edited(before.text(), &candidate.refactoring.edits);
    let mut copy = Project::new(Overlaid { project });
    if copy.set_text(path, 0, text).is_err() {
        return false;
    }
    let Ok(after) = copy.analysis(path) else { return false };
    let faults = |analysis: &Analysis| {
        let mut found: Vec<(Severity, &'static str)> =
            analysis.findings.diagnostics().map(|fault| (fault.severity, fault.id)).collect();
        found.sort();
        found
    };
    let same_names = candidate.names.as_ref().is_none_or(|expected| {
        let mut expected = expected.clone();
        expected.sort();
        expected == meanings(&after, |_| true)
    });
    same_names && faults(before) == faults(&after)
}

/// What the functions and literals that are named mean, sorted. Functions are numbered as they are declared, so the numbers are the
/// same in the copy.
fn meanings(analysis: &Analysis, here: impl Fn(u32) -> bool) -> Vec<Referent> {
    let names = analysis.names.iter().filter(|name| here(name.span.start) && is_lasting(analysis, name.referent));
    let mut found: Vec<Referent> = names.map(|name| name.referent).collect();
    found.sort();
    found
}

fn is_lasting(analysis: &Analysis, referent: Referent) -> bool {
    match referent {
        Referent::Function(id) => analysis.model.function(id).kind != model::FunctionKind::Local,
        Referent::Literal(..) => true,
        Referent::Domain(_) | Referent::Rule(_) | Referent::Variable(..) => false,
    }
}

/// The rules that a range covers and nothing else but white space and comments: one, or neighbours in a `par` or `seq`.
fn chosen(analysis: &Analysis, (start, end): (u32, u32)) -> Vec<SyntaxNode> {
    let Some(tree) = analysis.tree().filter(|_| start < end) else { return Vec::new() };
    let end = end.min(analysis.text().len() as u32);
    let Some(first) = tree.token_at_offset(start.min(end).into()).right_biased() else { return Vec::new() };
    let Some(last) = tree.token_at_offset(end.into()).left_biased() else { return Vec::new() };
    let first = std::iter::successors(Some(first), SyntaxToken::next_token).find(|token| !token.kind().is_trivia());
    let last = std::iter::successors(Some(last), SyntaxToken::prev_token).find(|token| !token.kind().is_trivia());
    let (Some(first), Some(last)) = (first, last) else { return Vec::new() };
    let (start, end) = (u32::from(first.text_range().start()).max(start), u32::from(last.text_range().end()).min(end));
    if start >= end {
        return Vec::new();
    }
    let covers = |node: &SyntaxNode| {
        let (from, to) = bytes(node);
        from <= start && end <= to
    };
    let mut around = first.parent_ancestors().skip_while(|node| !covers(node));
    let Some(inner) = around.next() else { return Vec::new() };
    let whole = std::iter::once(inner.clone()).chain(around).take_while(|node| bytes(node) == (start, end));
    if let Some(rule) = whole.filter(is_rule).last() {
        return vec![rule];
    }
    if !matches!(inner.kind(), SyntaxKind::PAR_RULE | SyntaxKind::SEQ_RULE) {
        return Vec::new();
    }
    let inside = |node: &SyntaxNode| bytes(node).0 >= start && bytes(node).1 <= end;
    let rules: Vec<SyntaxNode> = inner.children().filter(inside).collect();
    let exact = rules.first().is_some_and(|rule| bytes(rule).0 == start)
        && rules.last().is_some_and(|rule| bytes(rule).1 == end)
        && rules.iter().all(is_rule);
    if exact { rules } else { Vec::new() }
}

fn is_rule(node: &SyntaxNode) -> bool {
    ast::Rule::cast(node.clone()).is_some()
}

/// The bytes of a node.
fn bytes(node: &SyntaxNode) -> (u32, u32) {
    let range = trimmed_range(node);
    (range.start().into(), range.end().into())
}

/// The tokens that lie in a range.
fn tokens_in(tree: &SyntaxNode, (start, end): (u32, u32)) -> impl Iterator<Item = SyntaxToken> {
    let first = tree.token_at_offset(start.into()).right_biased();
    std::iter::successors(first, SyntaxToken::next_token)
        .take_while(move |token| u32::from(token.text_range().end()) <= end)
}

/// Whether there is a comment in a range.
fn has_comment(tree: &SyntaxNode, range: (u32, u32)) -> bool {
    tokens_in(tree, range).any(|token| token.kind().is_trivia() && token.kind() != SyntaxKind::WHITESPACE)
}

/// One more level, as the file has them.
fn level(text: &str) -> &'static str {
    let spaces = text.lines().filter(|line| line.starts_with("  ")).count();
    if spaces > text.lines().filter(|line| line.starts_with('\t')).count() { "    " } else { "\t" }
}

/// A range of the text as it is written where lines begin with `to` instead of `from`, with some of its tokens replaced. Comments
/// and strings keep their lines.
fn moved(
    tree: &SyntaxNode,
    range: (u32, u32),
    (from, to): (&str, &str),
    replaced: &dyn Fn(&SyntaxToken) -> Option<String>,
) -> String {
    let mut text = String::new();
    for token in tokens_in(tree, range) {
        let line = token.text().rfind('\n').filter(|_| token.kind() == SyntaxKind::WHITESPACE);
        match (line, replaced(&token)) {
            (_, Some(other)) => text.push_str(&other),
            (Some(at), None) => {
                let (lines, own) = token.text().split_at(at + 1);
                text.push_str(lines);
                match own.strip_prefix(from) {
                    Some(deeper) => text.extend([to, deeper]),
                    None => text.push_str(own),
                }
            }
            (None, None) => text.push_str(token.text()),
        }
    }
    text
}

/// Whether a variable is what an update or a return writes to.
fn is_target(variable: &SyntaxToken) -> bool {
    let Some(term) = variable.parent() else { return false };
    let Some(rule) = term.parent() else { return false };
    matches!(rule.kind(), SyntaxKind::UPDATE_RULE | SyntaxKind::RETURN_RULE) && rule.children().next() == Some(term)
}
