//! An `if` ladder that compares one location with literals, and the `switch` that means the same; missing cases of a `switch`.
//!
//! In: a model, and a token that belongs to the `if` or `switch` itself. Out: edits of its own words; the rules in it keep their
//! bytes. Only a location is compared: a term with a choice in it could have another value each time.

use std::collections::BTreeSet;

use model::{DomainKind, FunctionKind, Referent, RuleKind};
use syntax::ast::{self, AstNode};
use syntax::{SyntaxKind, SyntaxNode, SyntaxToken};

use super::{Candidate, RefactoringKind, bytes, has_comment, is_rule, level};
use crate::analysis::Analysis;
use crate::fix::line_end;
use crate::layout::indentation;
use crate::position::Edit;

/// What can be made of the `if` or `switch` that a token belongs to.
pub(super) fn rewrite(analysis: &Analysis, token: &SyntaxToken) -> Vec<Candidate> {
    let Some(rule) = token.parent_ancestors().find(is_rule) else { return Vec::new() };
    let found = match ast::Rule::cast(rule) {
        Some(ast::Rule::If(ladder)) => vec![to_switch(analysis, &ladder)],
        Some(ast::Rule::Switch(switch)) => vec![to_ladder(analysis, &switch), complete(analysis, &switch)],
        _ => Vec::new(),
    };
    found.into_iter().flatten().collect()
}

fn to_switch(analysis: &Analysis, ladder: &ast::IfRule) -> Option<Candidate> {
    let mut compared: Vec<(SyntaxNode, SyntaxNode)> = Vec::new();
    for branch in ladder.branches() {
        compared.push(comparison(analysis, branch.guard()?.syntax())?);
    }
    let (subject, _) = compared.first()?;
    let same = compared.iter().all(|(other, _)| words(other) == words(subject));
    let distinct: BTreeSet<String> = compared.iter().map(|(_, literal)| words(literal)).collect();
    if compared.len() < 2 || !same || distinct.len() < compared.len() {
        return None;
    }
    let line = line_end(analysis);
    let own = indentation(analysis.text(), bytes(ladder.syntax()).0);
    let mut edits = Vec::new();
    for (index, (branch, (subject, literal))) in ladder.branches().zip(&compared).enumerate() {
        let keyword = if index == 0 { SyntaxKind::IF_KW } else { SyntaxKind::ELSEIF_KW };
        let from = keywords(ladder.syntax(), keyword).nth(index.saturating_sub(1))?;
        let then = keywords(branch.syntax(), SyntaxKind::THEN_KW).next()?;
        let case = format!("case {}:", literal.text());
        let text = if index == 0 { format!("switch {}{line}{own}{case}", subject.text()) } else { case };
        edits.push(between(&from, &then, text));
    }
    edits.extend(keywords(ladder.syntax(), SyntaxKind::ELSE_KW).map(|token| between(&token, &token, "otherwise")));
    let end = keywords(ladder.syntax(), SyntaxKind::ENDIF_KW).next()?;
    edits.push(between(&end, &end, "endswitch"));
    rewritten(analysis, "Convert to `switch`", edits)
}

fn to_ladder(analysis: &Analysis, switch: &ast::SwitchRule) -> Option<Candidate> {
    let subject = switch.subject()?.syntax().clone();
    if !is_location(analysis, &subject) {
        return None;
    }
    let mut edits = Vec::new();
    for (index, case) in switch.cases().enumerate() {
        let literal = case.value()?.syntax().clone();
        if !is_literal(analysis, &literal) {
            return None;
        }
        let from = match index {
            0 => keywords(switch.syntax(), SyntaxKind::SWITCH_KW).next()?,
            _ => keywords(case.syntax(), SyntaxKind::CASE_KW).next()?,
        };
        let colon = keywords(case.syntax(), SyntaxKind::COLON).next()?;
        let word = if index == 0 { "if" } else { "elseif" };
        edits.push(between(&from, &colon, format!("{word} {} = {} then", subject.text(), literal.text())));
    }
    if edits.is_empty() {
        return None;
    }
    edits.extend(keywords(switch.syntax(), SyntaxKind::OTHERWISE_KW).map(|token| between(&token, &token, "else")));
    let end = keywords(switch.syntax(), SyntaxKind::ENDSWITCH_KW).next()?;
    edits.push(between(&end, &end, "endif"));
    rewritten(analysis, "Convert to an `if` ladder", edits)
}

/// Adds the literals of the subject's domain that no case has, each with `skip`.
fn complete(analysis: &Analysis, switch: &ast::SwitchRule) -> Option<Candidate> {
    if switch.otherwise().is_some() {
        return None;
    }
    let (start, end) = bytes(switch.syntax());
    let mut domain = None;
    for rule in analysis.model.rules.iter().filter(|rule| rule.span.file == analysis.file) {
        rule.body.walk(&mut |node| {
            if let RuleKind::Switch { subject, .. } = &node.kind
                && (node.span.start, node.span.end) == (start, end)
            {
                domain = Some(subject.domain);
            }
        });
    }
    let domain = domain?;
    let DomainKind::Enum { literals } = analysis.model.domains.kind(domain) else { return None };
    let written: Vec<String> = switch.cases().filter_map(|case| Some(words(case.value()?.syntax()))).collect();
    let missing: Vec<&String> = literals.iter().filter(|literal| !written.contains(literal)).collect();
    let is_seen = |literal: &&String| analysis.model.names.literal(literal).is_some_and(|(other, _)| other == domain);
    if missing.is_empty() || !missing.iter().all(is_seen) {
        return None;
    }
    let text = analysis.text();
    let close = keywords(switch.syntax(), SyntaxKind::ENDSWITCH_KW).next()?;
    let at = u32::from(close.text_range().start());
    let own = indentation(text, at);
    let begins_line = text[..at as usize].ends_with(&format!("\n{own}"));
    let line = line_end(analysis);
    let added: String = match (begins_line, switch.cases().last()) {
        (true, Some(last)) => {
            let case = indentation(text, bytes(last.syntax()).0);
            let level = level(text);
            missing.iter().map(|literal| format!("{case}case {literal}:{line}{case}{level}skip{line}")).collect()
        }
        _ => missing.iter().map(|literal| format!("case {literal}: skip ")).collect(),
    };
    let at = if begins_line { at - own.len() as u32 } else { at };
    let title = match missing.as_slice() {
        [only] => format!("Add the case `{only}`"),
        several => format!("Add the {} missing cases", several.len()),
    };
    Some(Candidate::new(title, RefactoringKind::Rewrite, vec![Edit::insert(at, added)]))
}

/// No comment stood where words were replaced.
fn rewritten(analysis: &Analysis, title: &str, edits: Vec<Edit>) -> Option<Candidate> {
    let tree = analysis.tree()?;
    let clean = edits.iter().all(|edit| !has_comment(&tree, edit.range));
    clean.then(|| Candidate::new(title, RefactoringKind::Rewrite, edits))
}

fn between(from: &SyntaxToken, to: &SyntaxToken, text: impl Into<String>) -> Edit {
    Edit::new(u32::from(from.text_range().start())..u32::from(to.text_range().end()), text)
}

fn keywords(node: &SyntaxNode, kind: SyntaxKind) -> impl Iterator<Item = SyntaxToken> {
    let tokens = node.children_with_tokens().filter_map(|element| element.into_token());
    tokens.filter(move |token| token.kind() == kind)
}

/// A node without white space and comments.
fn words(node: &SyntaxNode) -> String {
    let tokens = node.descendants_with_tokens().filter_map(|element| element.into_token());
    let words: Vec<String> =
        tokens.filter(|token| !token.kind().is_trivia()).map(|token| token.text().to_string()).collect();
    words.join(" ")
}

/// The location and the literal of a guard that compares them.
fn comparison(analysis: &Analysis, guard: &SyntaxNode) -> Option<(SyntaxNode, SyntaxNode)> {
    let mut guard = guard.clone();
    while let Some(inner) = ast::ParenTerm::cast(guard.clone()).and_then(|paren| paren.term()) {
        guard = inner.syntax().clone();
    }
    let equals = ast::BinaryTerm::cast(guard)?;
    if equals.operator()?.kind() != SyntaxKind::EQ {
        return None;
    }
    let (left, right) = (equals.left()?.syntax().clone(), equals.right()?.syntax().clone());
    let (subject, literal) = if is_literal(analysis, &right) { (left, right) } else { (right, left) };
    (is_literal(analysis, &literal) && is_location(analysis, &subject)).then_some((subject, literal))
}

/// A literal that is equal to itself alone.
fn is_literal(analysis: &Analysis, node: &SyntaxNode) -> bool {
    let Some(token) = node.first_token() else { return false };
    match node.kind() {
        SyntaxKind::LITERAL_TERM => {
            !matches!(token.kind(), SyntaxKind::UNDEF_KW | SyntaxKind::REAL | SyntaxKind::COMPLEX)
        }
        SyntaxKind::ENUM_TERM => {
            let names = analysis.names_at(token.text_range().start().into());
            names.iter().any(|name| matches!(name.referent, Referent::Literal(..)))
        }
        _ => false,
    }
}

/// A dynamic function applied to literals, locations and variables; it has one value in a state.
fn is_location(analysis: &Analysis, node: &SyntaxNode) -> bool {
    let Some(term) = ast::FunctionTerm::cast(node.clone()).filter(|term| term.agent().is_none()) else { return false };
    let Some(name) = term.name() else { return false };
    let names = analysis.names_at(name.text_range().start().into());
    let [model::Use { referent: Referent::Function(id), .. }] = names else { return false };
    let dynamic = matches!(
        analysis.model.function(*id).kind,
        FunctionKind::Controlled | FunctionKind::Monitored | FunctionKind::Shared | FunctionKind::Out
    );
    let fixed = |argument: ast::Term| {
        let node = argument.syntax();
        is_literal(analysis, node) || is_location(analysis, node) || is_value(analysis, node)
    };
    dynamic && term.arguments().is_none_or(|list| list.terms().all(fixed))
}

/// A variable that is no parameter: a parameter of a macro rule stands for any term.
fn is_value(analysis: &Analysis, node: &SyntaxNode) -> bool {
    if node.kind() != SyntaxKind::VARIABLE_TERM {
        return false;
    }
    let names = analysis.names_at(bytes(node).0);
    let [model::Use { referent: Referent::Variable(bound, _), .. }] = names else { return false };
    let binder = analysis.token_at(bound.start).and_then(|token| token.parent());
    binder.is_some_and(|binder| binder.kind() != SyntaxKind::PARAMETER)
}
