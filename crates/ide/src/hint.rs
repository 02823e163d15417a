//! What an editor writes between the lines: domains of variables, how often something is named, what can be done with a model.
//!
//! In: a project and a file. Out: [`Hint`]s and [`Lens`]es at their places.

use std::collections::BTreeMap;
use std::path::Path;

use groundstate::Kind;
use groundstate::workspace::Files;
use model::{Domains, Referent, RuleNode, Term, TermKind, Use};
use syntax::{FileId, SyntaxKind};

use crate::analysis::{Analysis, Place, Symbol};
use crate::navigate::others_that_write;
use crate::project::Project;

/// A text that is shown and not there.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Hint {
    /// Before which byte.
    pub at: u32,
    /// What is shown.
    pub text: String,
}

/// What can be done with a line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Action {
    /// `groundstate run`
    Run,
    /// `groundstate verify`
    Verify,
    /// `groundstate test`
    Test,
    /// `groundstate chart draw`
    Draw,
    /// Show these places.
    References(Vec<Place>),
}

/// A line above a declaration.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Lens {
    /// The name that is declared.
    pub range: (u32, u32),
    /// What is shown.
    pub title: String,
    /// What it does.
    pub action: Action,
}

/// Domains of variables that are not written, and where a number is taken to another domain; in the order of their places.
pub fn hints<F: Files>(project: &mut Project<F>, path: &str) -> Vec<Hint> {
    let Ok(analysis) = project.analysis(path) else { return Vec::new() };
    let mut found = Vec::new();
    for name in analysis.names.iter().filter(|name| name.declares) {
        let Referent::Variable(_, domain) = name.referent else { continue };
        let Some(token) = analysis.token_at(name.span.start) else { continue };
        let unwritten = match token.parent().map(|parent| parent.kind()) {
            Some(SyntaxKind::BINDING) => true,
            // A domain says what its elements are; of a term it is not seen.
            Some(SyntaxKind::BINDER) => {
                let range = token.parent().and_then(|binder| binder.children().next());
                range.is_some_and(|range| !matches!(range.kind(), SyntaxKind::DOMAIN_TERM | SyntaxKind::ENUM_TERM))
            }
            _ => false,
        };
        if unwritten && domain != Domains::ERROR {
            found.push(Hint { at: name.span.end, text: format!(": {}", analysis.model.domains.display(domain)) });
        }
    }
    coercions(&analysis, &mut found);
    found.sort();
    found.dedup();
    found
}

fn coercions(analysis: &Analysis, found: &mut Vec<Hint>) {
    let model = &analysis.model;
    let mut look = |term: &Term| {
        if let TermKind::Coerce(inner) = &term.kind
            && inner.span.file == analysis.file
        {
            found.push(Hint { at: inner.span.end, text: format!(" → {}", model.domains.display(term.domain)) });
        }
    };
    let in_file = |file: FileId| file == analysis.file;
    for rule in model.rules.iter().filter(|rule| in_file(rule.span.file)) {
        rule.body.walk(&mut |node: &RuleNode| node.terms(&mut |term| term.walk(&mut look)));
    }
    for function in model.functions.iter().filter(|function| in_file(function.span.file)) {
        if let Some(definition) = &function.definition {
            definition.body.walk(&mut look);
        }
    }
    for property in model.properties.iter().filter(|property| in_file(property.span.file)) {
        property.formula.walk(&mut look);
    }
}

/// What can be done with a file and its declarations.
pub fn lenses<F: Files>(project: &mut Project<F>, path: &str) -> Vec<Lens> {
    let Ok(analysis) = project.analysis(path) else { return Vec::new() };
    let Some(tree) = analysis.tree() else { return Vec::new() };
    let mut found = Vec::new();
    let head = tree.descendants_with_tokens().filter_map(|element| element.into_token());
    let head = head.into_iter().find(|token| token.kind() == SyntaxKind::GENERIC_ID);
    if let Some(head) = head {
        let range = (head.text_range().start().into(), head.text_range().end().into());
        let actions: &[(&str, Action)] = match Kind::of(Path::new(path)) {
            Some(Kind::Model) if analysis.machine().is_some_and(|machine| machine.main_rule().is_some()) => {
                &[("Run", Action::Run), ("Verify", Action::Verify)]
            }
            Some(Kind::Scenario) => &[("Test", Action::Test)],
            Some(Kind::Chart) => &[("Draw", Action::Draw)],
            Some(Kind::Model | Kind::Report | Kind::Verification | Kind::Coupling) | None => &[],
        };
        found.extend(actions.iter().map(|(title, action)| Lens {
            range,
            title: title.to_string(),
            action: action.clone(),
        }));
    }
    found.extend(uses(project, &analysis));
    found
}

/// How often each rule that a file declares is named, there and in the other files of the project.
fn uses<F: Files>(project: &mut Project<F>, analysis: &Analysis) -> Vec<Lens> {
    let is_rule = |name: &Use| matches!(name.referent, Referent::Rule(_));
    let main = analysis.model.main.map(Referent::Rule);
    let declared: Vec<&Use> =
        analysis.names.iter().filter(|name| name.declares && is_rule(name) && Some(name.referent) != main).collect();
    let words: Vec<&str> = declared.iter().map(|name| &analysis.text()[name.span.range()]).collect();
    let (others, more) = others_that_write(project, analysis, &words);
    let mut uses: BTreeMap<Symbol, Vec<Place>> = BTreeMap::new();
    for file in std::iter::once(analysis).chain(others.iter().map(|other| &**other)) {
        for name in file.names.iter().filter(|name| !name.declares && is_rule(name)) {
            uses.entry(file.symbol(name.referent)).or_default().push(file.place(name.span));
        }
    }
    let mut lens = |name: &&Use| {
        let places = uses.remove(&analysis.symbol(name.referent)).unwrap_or_default();
        let elsewhere = places.iter().filter(|place| place.path != analysis.source().name).count();
        let noun = if places.len() == 1 { "use" } else { "uses" };
        let title = match (elsewhere, more) {
            (_, true) => format!("at least {} {noun}", places.len()),
            (0, false) => format!("{} {noun}", places.len()),
            (_, false) => format!("{} {noun}, {elsewhere} in other files", places.len()),
        };
        Lens { range: (name.span.start, name.span.end), title, action: Action::References(places) }
    };
    declared.iter().map(&mut lens).collect()
}
