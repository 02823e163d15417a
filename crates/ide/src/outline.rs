//! The outline of a file: what it declares, in the order of the text.
//!
//! In: a tree, however broken. Out: [`Entry`]s, nested. The text alone decides; nothing is looked up in other files.

use groundstate::workspace::Files;
use syntax::ast::{self, AstNode, Command, DomainDecl, Shape};
use syntax::{SyntaxKind, SyntaxNode, SyntaxToken};

use crate::analysis::Place;
use crate::project::Project;

/// What an entry is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum EntryKind {
    /// `asm`, `module`, `scenario`, `chart`; a machine or system of a chart.
    Machine,
    /// A domain.
    Domain,
    /// An enum domain.
    Enum,
    /// A literal of one.
    Literal,
    /// A function; its kind as it is written.
    Function,
    /// A rule.
    Rule,
    /// An invariant, a temporal property or an assumption.
    Property,
    /// An initial state.
    Init,
    /// A block of a scenario.
    Block,
    /// A shape of a chart, a component, channel or device of a system.
    Shape,
}

/// One thing that is declared.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Entry {
    /// Its name.
    pub name: String,
    /// What it is.
    pub kind: EntryKind,
    /// The rest of its declaration in a few words: `controlled`, `main rule`.
    pub detail: String,
    /// All of it.
    pub range: (u32, u32),
    /// Its name, within the range.
    pub name_range: (u32, u32),
    /// What is declared in it.
    pub inner: Vec<Entry>,
}

/// The outline of a file.
pub fn outline<F: Files>(project: &mut Project<F>, path: &str) -> Vec<Entry> {
    project.analysis(path).ok().and_then(|analysis| analysis.tree()).map(|tree| entries(&tree)).unwrap_or_default()
}

/// What of the project's files has the letters of a query in their order, the nearest first.
pub fn search<F: Files>(project: &mut Project<F>, query: &str) -> Vec<(Entry, Place)> {
    let mut found = Vec::new();
    for file in project.all_files() {
        let mut open: Vec<Entry> = project.tree(&file).map(|tree| entries(&tree)).unwrap_or_default();
        while let Some(mut entry) = open.pop() {
            open.append(&mut entry.inner);
            if let Some(distance) = matches(&entry.name, query) {
                let place = Place { path: file.clone(), range: entry.name_range };
                found.push((distance, entry.name.clone(), place, entry));
            }
        }
    }
    found.sort_by(|a, b| (a.0, &a.1, &a.2).cmp(&(b.0, &b.1, &b.2)));
    found.into_iter().map(|(_, _, place, entry)| (entry, place)).collect()
}

/// How far a name is from a query: none if it lacks a letter.
fn matches(name: &str, query: &str) -> Option<usize> {
    let lower = name.to_lowercase();
    let query = query.to_lowercase();
    if let Some(at) = lower.find(&query) {
        return Some(at);
    }
    let mut letters = lower.chars();
    query.chars().all(|wanted| letters.any(|letter| letter == wanted)).then(|| 100 + name.len())
}

fn range(node: &SyntaxNode) -> (u32, u32) {
    let range = ast::trimmed_range(node);
    (range.start().into(), range.end().into())
}

fn token_range(token: &SyntaxToken) -> (u32, u32) {
    (token.text_range().start().into(), token.text_range().end().into())
}

fn entry(node: &SyntaxNode, name: Option<SyntaxToken>, kind: EntryKind, detail: impl Into<String>) -> Option<Entry> {
    let name = name?;
    Some(Entry {
        name: name.text().to_string(),
        kind,
        detail: detail.into(),
        range: range(node),
        name_range: token_range(&name),
        inner: Vec::new(),
    })
}

fn entries(tree: &SyntaxNode) -> Vec<Entry> {
    match tree.kind() {
        SyntaxKind::SOURCE_FILE => tree.descendants().filter_map(|node| declared(&node)).collect(),
        SyntaxKind::SCENARIO_FILE => ast::ScenarioFile::cast(tree.clone()).map(scenario).unwrap_or_default(),
        SyntaxKind::CHART_FILE => tree.children().filter_map(|node| machine(&node)).collect(),
        _ => Vec::new(),
    }
}

fn declared(node: &SyntaxNode) -> Option<Entry> {
    if let Some(domain) = DomainDecl::cast(node.clone()) {
        let kind = if matches!(domain, DomainDecl::Enum(_)) { EntryKind::Enum } else { EntryKind::Domain };
        let mut found = entry(node, domain.name(), kind, "domain")?;
        if let DomainDecl::Enum(decl) = domain {
            let literal =
                |literal: ast::EnumLiteralDecl| entry(literal.syntax(), literal.name(), EntryKind::Literal, "");
            found.inner = decl.literals().filter_map(literal).collect();
        }
        return Some(found);
    }
    if let Some(function) = ast::FunctionDecl::cast(node.clone()) {
        let kind = function.kind().and_then(SyntaxKind::text).unwrap_or_default();
        return entry(node, function.name(), EntryKind::Function, kind);
    }
    if let Some(rule) = ast::RuleDecl::cast(node.clone()) {
        let is_main = node.parent().is_some_and(|parent| parent.kind() == SyntaxKind::MAIN_RULE);
        let detail = if is_main {
            "main rule"
        } else if rule.is_turbo() {
            "turbo rule"
        } else {
            "rule"
        };
        return entry(node, rule.name(), EntryKind::Rule, detail);
    }
    if let Some(property) = ast::Property::cast(node.clone()) {
        return entry(node, property.name(), EntryKind::Property, "property");
    }
    let init = ast::Init::cast(node.clone())?;
    entry(node, init.name(), EntryKind::Init, if init.is_default() { "default init" } else { "init" })
}

fn scenario(file: ast::ScenarioFile) -> Vec<Entry> {
    let mut found: Vec<Entry> = file
        .invariants()
        .filter_map(|invariant| entry(invariant.syntax(), invariant.name(), EntryKind::Property, "invariant"))
        .collect();
    found.extend(blocks(file.commands()));
    match entry(file.syntax(), file.name(), EntryKind::Machine, "scenario") {
        Some(whole) => vec![Entry { inner: found, ..whole }],
        None => found,
    }
}

fn blocks(commands: impl Iterator<Item = Command>) -> Vec<Entry> {
    let of = |command| match command {
        Command::Block(block) => {
            let found = entry(block.syntax(), block.name(), EntryKind::Block, "block")?;
            // LIMIT: blocks in blocks in blocks are not shown.
            let inner = block.commands().filter_map(|command| match command {
                Command::Block(inner) => entry(inner.syntax(), inner.name(), EntryKind::Block, "block"),
                _ => None,
            });
            Some(Entry { inner: inner.collect(), ..found })
        }
        _ => None,
    };
    commands.filter_map(of).collect()
}

fn machine(node: &SyntaxNode) -> Option<Entry> {
    let detail = match node.kind() {
        SyntaxKind::MACHINE_CHART => "machine",
        SyntaxKind::SYSTEM_CHART => "system",
        _ => return None,
    };
    let found = entry(node, name_of(node), EntryKind::Machine, detail)?;
    Some(Entry { inner: parts(node), ..found })
}

fn name_of(node: &SyntaxNode) -> Option<SyntaxToken> {
    let mut tokens = node.children_with_tokens().filter_map(|element| element.into_token());
    tokens.find(|token| token.kind() == SyntaxKind::GENERIC_ID)
}

/// What a machine, a system or a composite state holds.
fn parts(node: &SyntaxNode) -> Vec<Entry> {
    let of = |child: SyntaxNode| {
        let detail = match child.kind() {
            SyntaxKind::COMPONENT => "component",
            SyntaxKind::CHANNEL => "channel",
            SyntaxKind::DEVICE => "device",
            _ => match Shape::cast(child.clone())? {
                Shape::State(_) => "state",
                Shape::Composite(_) => "composite state",
                Shape::Entry(_) => "entry action",
                Shape::Exit(_) => "exit action",
                Shape::Abort(_) => "action of an abort",
                Shape::Guard(_) => "guard",
                Shape::Action(_) => "action",
                Shape::Instance(_) => "instance",
            },
        };
        let found = entry(&child, name_of(&child), EntryKind::Shape, detail)?;
        let inner = if child.kind() == SyntaxKind::COMPOSITE_STATE { parts(&child) } else { Vec::new() };
        Some(Entry { inner, ..found })
    };
    node.children().filter_map(of).collect()
}
