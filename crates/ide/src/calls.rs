//! Which rules call a rule, and which it calls.
//!
//! In: a project, a file and the offset of a rule's name. Out: the rules, each with the places of the calls.

use std::collections::BTreeMap;

use groundstate::workspace::Files;
use model::Referent;
use syntax::ast::{self, AstNode};
use syntax::{Span, SyntaxToken};

use crate::analysis::{Analysis, Place, Role};
use crate::navigate::references;
use crate::project::Project;

/// A rule at one end of calls.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Called {
    /// Its name.
    pub name: String,
    /// Where that is declared.
    pub place: Place,
    /// The places of the calls, in the file of the caller.
    pub calls: Vec<(u32, u32)>,
}

/// The rules that call the rule that is named at an offset.
pub fn callers<F: Files>(project: &mut Project<F>, path: &str, offset: u32) -> Vec<Called> {
    let mut found: BTreeMap<Place, Called> = BTreeMap::new();
    for reference in references(project, path, offset).into_iter().filter(|reference| reference.role == Role::Call) {
        let Ok(analysis) = project.analysis(&reference.place.path) else { continue };
        let (start, end) = reference.place.range;
        let Some(rule) = analysis.enclosing_rule(Span { file: analysis.file, start, end }) else { continue };
        let place = analysis.place(Span::new(analysis.file, rule.text_range()));
        let name = rule.text().to_string();
        let known = found.entry(place.clone()).or_insert(Called { name, place, calls: Vec::new() });
        known.calls.push((start, end));
    }
    found.into_values().collect()
}

/// The rules that the rule whose name is at an offset calls.
pub fn callees<F: Files>(project: &mut Project<F>, path: &str, offset: u32) -> Vec<Called> {
    let Ok(analysis) = project.analysis(path) else { return Vec::new() };
    let Some(rule) = declared_at(&analysis, offset) else { return Vec::new() };
    let range = rule.range();
    let mut found: BTreeMap<Place, Called> = BTreeMap::new();
    for name in &analysis.names {
        let inside = u32::from(range.start()) <= name.span.start && name.span.end <= u32::from(range.end());
        let (Referent::Rule(id), true) = (name.referent, inside && !name.declares) else { continue };
        let called = analysis.model.rule(id);
        let place = analysis.place(called.span);
        let known = found.entry(place.clone());
        let known = known.or_insert(Called { name: called.name.clone(), place, calls: Vec::new() });
        known.calls.push((name.span.start, name.span.end));
    }
    found.into_values().collect()
}

fn declared_at(analysis: &Analysis, offset: u32) -> Option<ast::RuleDecl> {
    let token: SyntaxToken = analysis.token_at(offset)?;
    token.parent().and_then(ast::RuleDecl::cast)
}
