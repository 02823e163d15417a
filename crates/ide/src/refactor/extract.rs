//! A rule gets a name: the rules that are chosen become the body of a macro rule, and a call takes their place.
//!
//! In: a model, and neighbouring rules of it. Out: the edits. The variables that the rules use and do not bind are the parameters.
//! A macro call stands for the body with the arguments put in (Börger & Stärk 2003, section 2.2.4), so the meaning is the same.

use groundstate::workspace::Files;
use model::{DomainId, DomainKind, FunctionKind, Model, Referent};
use syntax::{SyntaxKind, SyntaxNode};

use super::{Candidate, RefactoringKind, bytes, is_target, level, meanings, moved, tokens_in};
use crate::analysis::Analysis;
use crate::fix::line_end;
use crate::layout::indentation;
use crate::position::Edit;
use crate::project::Project;

/// A name that no rule has, here or in a file that may import this one.
pub(super) fn fresh_name<F: Files>(project: &mut Project<F>, analysis: &Analysis) -> String {
    let exports = analysis.machine().is_some_and(|machine| machine.export().is_some());
    let others = if exports { project.all_files() } else { Vec::new() };
    let texts: Vec<_> = others.iter().filter_map(|file| project.text(file).ok()).collect();
    let is_free = |name: &String| {
        analysis.model.rules.iter().all(|rule| rule.name != *name)
            && !analysis.text().contains(name.as_str())
            && texts.iter().all(|source| !source.text.contains(name.as_str()))
    };
    let numbered = (2..).map(|number| format!("r_extracted{number}"));
    std::iter::once("r_extracted".to_string()).chain(numbered).find(is_free).unwrap_or_default()
}

/// Gives the chosen rules a name.
pub(super) fn extract(analysis: &Analysis, rules: &[SyntaxNode], name: &str) -> Option<Candidate> {
    let (first, last) = (rules.first()?, rules.last()?);
    if let [only] = rules
        && matches!(only.kind(), SyntaxKind::MACRO_CALL_RULE | SyntaxKind::SKIP_RULE)
    {
        return None;
    }
    let tree = analysis.tree()?;
    let text = analysis.text();
    let range = (bytes(first).0, bytes(last).1);
    let declaration = first.ancestors().find(|node| node.kind() == SyntaxKind::RULE_DECL)?;
    let declaration = declaration.parent().filter(|node| node.kind() == SyntaxKind::MAIN_RULE).unwrap_or(declaration);
    let parameters = parameters(analysis, &tree, range)?;
    let end = line_end(analysis);
    let outer = indentation(text, bytes(&declaration).0);
    let level = level(text);
    let inner = format!("{outer}{level}");
    let own = indentation(text, range.0);
    let body = match rules {
        [_] => moved(&tree, range, (own, &inner), &|_| None),
        _ => {
            let (open, close) = match first.parent()?.kind() {
                SyntaxKind::SEQ_RULE => ("seq", "endseq"),
                _ => ("par", "endpar"),
            };
            let deeper = format!("{inner}{level}");
            let body = moved(&tree, range, (own, &deeper), &|_| None);
            format!("{open}{end}{deeper}{body}{end}{inner}{close}")
        }
    };
    let named: Vec<String> = parameters.iter().map(|(name, domain)| format!("{name} in {domain}")).collect();
    let list = if named.is_empty() { String::new() } else { format!("({})", named.join(", ")) };
    let arguments: Vec<&str> = parameters.iter().map(|(name, _)| name.as_str()).collect();
    let written = format!("rule {name}{list} ={end}{inner}{body}{end}{end}{outer}");
    let edits = vec![
        Edit::insert(before(&declaration), written),
        Edit::new(range.0..range.1, format!("{name}[{}]", arguments.join(", "))),
    ];
    let title = match rules.len() {
        1 => "Extract the rule into a rule of its own".to_string(),
        count => format!("Extract the {count} rules into a rule of its own"),
    };
    Some(Candidate::new(title, RefactoringKind::Extract, edits).naming(meanings(analysis, |_| true)))
}

/// The variables that are used in a range and bound outside of it, with their domains. None if one cannot be handed over: it is
/// updated, its domain has no name here, or a function is local to the rules around.
fn parameters(analysis: &Analysis, tree: &SyntaxNode, range: (u32, u32)) -> Option<Vec<(String, String)>> {
    let inside = |at: u32| range.0 <= at && at < range.1;
    let mut found: Vec<(String, String)> = Vec::new();
    for name in analysis.names.iter().filter(|name| inside(name.span.start)) {
        if let Referent::Function(id) = name.referent
            && analysis.model.function(id).kind == FunctionKind::Local
            && !inside(analysis.model.function(id).span.start)
        {
            return None;
        }
    }
    for token in tokens_in(tree, range).filter(|token| token.kind() == SyntaxKind::VARIABLE) {
        let [name] = analysis.names_at(token.text_range().start().into()) else { return None };
        let Referent::Variable(bound, domain) = name.referent else { return None };
        if bound.file == analysis.file && inside(bound.start) {
            continue;
        }
        if is_target(&token) {
            return None;
        }
        let parameter = (token.text().to_string(), domain_here(&analysis.model, domain)?);
        if !found.contains(&parameter) {
            found.push(parameter);
        }
    }
    // A name that is bound twice outside would be one parameter of two domains.
    let distinct = found.iter().all(|(name, _)| found.iter().filter(|(other, _)| other == name).count() == 1);
    distinct.then_some(found)
}

/// A domain as it is written in the file.
fn domain_here(model: &Model, domain: DomainId) -> Option<String> {
    let all = |parts: &[DomainId]| parts.iter().all(|part| domain_here(model, *part).is_some());
    let is_known = match model.domains.kind(domain) {
        DomainKind::Error => false,
        DomainKind::Prod(parts) | DomainKind::Rule(parts) => all(parts),
        DomainKind::Seq(of) | DomainKind::Powerset(of) | DomainKind::Bag(of) => all(&[*of]),
        DomainKind::Map(key, value) => all(&[*key, *value]),
        _ => model.names.domain(&model.domains.display(domain)) == Some(domain),
    };
    is_known.then(|| model.domains.display(domain))
}

/// Where a declaration can be put before another: in front of the comments that belong to that one.
fn before(declaration: &SyntaxNode) -> u32 {
    let mut at = bytes(declaration).0;
    let mut token = declaration.first_token().and_then(|token| token.prev_token());
    while let Some(space) = token.filter(|token| token.kind() == SyntaxKind::WHITESPACE) {
        let comment = space.prev_token().filter(|token| token.kind().is_trivia());
        let Some(comment) = comment.filter(|_| space.text().matches('\n').count() == 1) else { break };
        let begins_line = comment
            .prev_token()
            .is_some_and(|before| before.kind() == SyntaxKind::WHITESPACE && before.text().contains('\n'));
        if !begins_line {
            break;
        }
        at = comment.text_range().start().into();
        token = comment.prev_token();
    }
    at
}
