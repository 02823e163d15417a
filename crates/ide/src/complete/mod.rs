//! What can be written at a place: names that are seen there, keywords, whole constructs, paths.
//!
//! In: a project, a file and an offset. Out: [`Item`]s, the likely ones first. The tokens before the place decide what may stand
//! there, so that a text with faults is as good as a sound one; `place` reads them, `scope` knows the variables.

mod coupling;
mod item;
mod place;
mod scope;
mod snippet;
mod specification;

use std::path::{Path, PathBuf};

use groundstate::workspace::Files;
use groundstate::{Kind, patterns};
use model::{DomainId, DomainKind, Domains, FunctionKind, Referent};
use syntax::ast::{self, AstNode};

use crate::analysis::Analysis;
use crate::hover::{declaration, rule_signature, signature};
use crate::navigate::stem;
use crate::project::Project;
pub use item::{Item, ItemKind};
use place::{Expected, Place, Where};
use specification::Slot;

/// What can be written, and the bytes that it takes the place of.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Completion {
    /// The word that is there already.
    pub range: (u32, u32),
    /// In the order in which to show them.
    pub items: Vec<Item>,
}

/// What can be written at an offset.
pub fn completion<F: Files>(project: &mut Project<F>, path: &str, offset: u32) -> Completion {
    let nothing = Completion { range: (offset, offset), items: Vec::new() };
    let Ok(analysis) = project.analysis(path) else { return nothing };
    if let Some(kind @ (Kind::Report | Kind::Verification)) = Kind::of(Path::new(path)) {
        return in_specification(project, &analysis, kind, offset).unwrap_or(nothing);
    }
    if Kind::of(Path::new(path)) == Some(Kind::Coupling) {
        let Some((range, mut items)) = coupling::completion(project, &analysis, offset) else { return nothing };
        in_order(&mut items);
        return Completion { range, items };
    }
    let Some(place) = place::at(&analysis, offset) else { return nothing };
    let mut items = match &place.wanted {
        Where::Path { scenario } => paths(project, &analysis, *scenario),
        Where::Header => snippet::header(),
        Where::Declaration => snippet::declarations(),
        Where::Definition => snippet::definitions(),
        Where::Command => snippet::commands(),
        Where::Domain => domains(&analysis),
        Where::Rule => rules(&analysis, &place),
        Where::Call => called(&analysis, 0),
        Where::Target => targets(&analysis, &place),
        Where::Term(expected) => terms(&analysis, &place, *expected),
        Where::Operator => snippet::operators(),
        Where::ChartItem => snippet::chart_items(),
        Where::Machine => machines(project, &analysis),
        Where::Drawn => drawn(&analysis),
        Where::Nothing => Vec::new(),
    };
    in_order(&mut items);
    Completion { range: place.range, items }
}

fn in_order(items: &mut Vec<Item>) {
    items.sort_by(|a, b| (a.rank, &a.label, a.kind, &a.detail).cmp(&(b.rank, &b.label, b.kind, &b.detail)));
    items.dedup_by(|a, b| a.label == b.label && a.kind == b.kind);
}

/// What can be written at an offset of a report or verification specification.
fn in_specification<F: Files>(
    project: &mut Project<F>,
    analysis: &Analysis,
    kind: Kind,
    offset: u32,
) -> Option<Completion> {
    let specification::At { range, slot, has_colon } = specification::at(kind, analysis.text(), offset)?;
    let place = |condition: bool| {
        let expected = Expected(condition.then_some(Domains::BOOLEAN));
        Place { range, wanted: Where::Term(expected), as_environment: false, variables: Vec::new() }
    };
    let words = |words: Vec<&str>, detail: &str| -> Vec<Item> {
        words.into_iter().map(|word| Item::new(word, ItemKind::Keyword, detail, 0)).collect()
    };
    let (mut items, is_key) = match slot {
        Slot::Keys(keys) => (words(keys, "key"), true),
        Slot::Words(all) => (words(all, ""), false),
        Slot::Term { condition } => {
            (terms(analysis, &place(condition), Expected(condition.then_some(Domains::BOOLEAN))), false)
        }
        Slot::TermKey => (terms(analysis, &place(false), Expected(None)), true),
        Slot::Input { is_key } => {
            let takes = |kind: FunctionKind| matches!(kind, FunctionKind::Monitored | FunctionKind::Shared);
            let inputs = functions(analysis).filter(|(id, _)| takes(analysis.model.function(*id).kind));
            (inputs.map(|(_, item)| item).collect(), is_key)
        }
        Slot::Chart => (charts(project, analysis), true),
        Slot::Nothing => return None,
    };
    for item in items.iter_mut().filter(|_| is_key && !has_colon) {
        item.insert.push_str(": ");
    }
    in_order(&mut items);
    Some(Completion { range, items })
}

/// Charts, as a specification names them.
fn charts<F: Files>(project: &mut Project<F>, analysis: &Analysis) -> Vec<Item> {
    let folder = Path::new(&analysis.source().name).parent().unwrap_or(Path::new("")).to_path_buf();
    let all = project.all_files().into_iter().filter(|file| Kind::of(Path::new(file)) == Some(Kind::Chart));
    all.map(|file| Item::new(&relative(&folder, Path::new(&file)), ItemKind::File, "", 0)).collect()
}

/// Modules that can be imported, or models that a scenario can load.
fn paths<F: Files>(project: &mut Project<F>, analysis: &Analysis, scenario: bool) -> Vec<Item> {
    let own = analysis.source().name.clone();
    let mut items = Vec::new();
    if !scenario {
        items.extend(model::libraries().map(|name| Item::new(name, ItemKind::File, "built in", 1)));
        items.extend(patterns::modules().map(|name| Item::new(&name, ItemKind::File, "built in", 2)));
    }
    let folder = Path::new(&own).parent().unwrap_or(Path::new("")).to_path_buf();
    for file in project.all_files() {
        if file != own && Kind::of(Path::new(&file)) == Some(Kind::Model) {
            let written = relative(&folder, Path::new(&file));
            let written = if scenario { written.as_str() } else { written.trim_end_matches(".asm") };
            items.push(Item::new(written, ItemKind::File, "", 0));
        }
    }
    items
}

/// Machines that an elaboration can name: those beside the chart, and those that it imports.
fn machines<F: Files>(project: &mut Project<F>, analysis: &Analysis) -> Vec<Item> {
    let own = analysis.source().name.clone();
    let folder = Path::new(&own).parent().unwrap_or(Path::new("")).to_path_buf();
    let imports = analysis.tree().into_iter().flat_map(|tree| tree.children().filter_map(ast::Import::cast));
    let imported = imports.filter_map(|import| import.path()).collect::<Vec<String>>();
    let mut files: Vec<String> =
        imported.iter().filter_map(|import| project.target(analysis.source(), import)).collect();
    let beside =
        |file: &String| Path::new(file).parent() == Some(&folder) && Kind::of(Path::new(file)) == Some(Kind::Model);
    files.extend(project.all_files().into_iter().filter(beside));
    let mut items = Vec::new();
    for file in files {
        let Ok(source) = project.text(&file) else { continue };
        let parse = syntax::parse_asmetal(syntax::FileId(0), &source.text);
        let model = ast::SourceFile::cast(parse.syntax());
        // What is imported by the name of a library, or has no main rule, is no machine.
        if model.is_some_and(|model| model.main_rule().is_some()) {
            items.push(Item::new(stem(&file), ItemKind::File, "machine", 0));
        }
    }
    items
}

/// The machines that the chart itself draws.
fn drawn(analysis: &Analysis) -> Vec<Item> {
    let chart = analysis.tree().and_then(ast::ChartFile::cast);
    let machines = chart.into_iter().flat_map(|chart| chart.machines().filter_map(|machine| machine.name()));
    machines.map(|name| Item::new(name.text(), ItemKind::Rule, "machine of this chart", 0)).collect()
}

/// A path as it is written in a file of a folder.
fn relative(folder: &Path, file: &Path) -> String {
    let (mut from, mut to) = (folder.components().peekable(), file.components().peekable());
    while from.peek().is_some() && from.peek() == to.peek() {
        from.next();
        to.next();
    }
    let up = from.map(|_| "..");
    let path: PathBuf = up.map(PathBuf::from).chain([to.collect::<PathBuf>()]).collect();
    path.to_string_lossy().replace('\\', "/")
}

fn domains(analysis: &Analysis) -> Vec<Item> {
    let names = analysis.model.names.all_domains();
    let declared = names.filter(|(_, id)| *id != Domains::ERROR).map(|(name, id)| {
        let declared = analysis.declaration(Referent::Domain(id));
        let of_library = declared.is_none_or(|span| analysis.sources.file(span.file).name.starts_with("<std>"));
        let rank = match analysis.model.domains.kind(id) {
            DomainKind::Any => 3,
            _ if of_library => 1,
            _ => 0,
        };
        Item::new(name, ItemKind::Domain, declaration(analysis, Referent::Domain(id)), rank)
    });
    let basic = ["Boolean", "Integer", "Natural", "Real", "String", "Char", "Complex", "Agent"];
    let basic = basic.into_iter().map(|name| Item::new(name, ItemKind::Domain, "basic domain", 1));
    declared.chain(basic).chain(snippet::structured_domains()).collect()
}

/// What a rule can begin with.
fn rules(analysis: &Analysis, place: &place::Place) -> Vec<Item> {
    let mut items = snippet::rules();
    items.extend(called(analysis, 1));
    items.extend(targets(analysis, place));
    items
}

fn called(analysis: &Analysis, rank: u8) -> Vec<Item> {
    let called = analysis.model.names.all_rules().map(|(name, id)| {
        let rule = analysis.model.rule(id);
        let (open, close) = if rule.turbo { ("(", ")") } else { ("[", "]") };
        let holes: Vec<String> = rule
            .parameters
            .iter()
            .enumerate()
            .map(|(index, id)| {
                let name = rule.variables[id.0 as usize].name.trim_start_matches('$');
                format!("${{{}:{name}}}", index + 1)
            })
            .collect();
        let insert = format!("{name}{open}{}{close}", holes.join(", "));
        let is_snippet = !holes.is_empty();
        let detail = rule_signature(analysis, rule);
        Item { label: name.to_string(), kind: ItemKind::Rule, detail, insert, is_snippet, rank }
    });
    called.collect()
}

/// Functions that may be updated here.
fn targets(analysis: &Analysis, place: &place::Place) -> Vec<Item> {
    let may = |kind: FunctionKind| match (kind, place.as_environment) {
        (FunctionKind::Shared, _) | (FunctionKind::Monitored, true) => true,
        (FunctionKind::Controlled | FunctionKind::Out | FunctionKind::Local, false) => true,
        (FunctionKind::Static | FunctionKind::Derived, _) => false,
        (FunctionKind::Monitored, false) => false,
        (FunctionKind::Controlled | FunctionKind::Out | FunctionKind::Local, true) => false,
    };
    functions(analysis).filter(|(id, _)| may(analysis.model.function(*id).kind)).map(|(_, item)| item).collect()
}

fn functions(analysis: &Analysis) -> impl Iterator<Item = (model::FunctionId, Item)> {
    let is_word = |(name, _): &(&str, model::FunctionId)| name.starts_with(|c: char| c.is_ascii_lowercase());
    analysis.model.names.all_functions().filter(is_word).map(|(name, id)| {
        let function = analysis.model.function(id);
        let rank = if function.library { 3 } else { 1 };
        let mut item = Item::new(name, ItemKind::Function, signature(analysis, id), rank);
        if !function.parameters.is_empty() {
            let holes: Vec<String> = (1..=function.parameters.len()).map(|n| format!("${{{n}}}")).collect();
            item.insert = format!("{name}({})", holes.join(", "));
            item.is_snippet = true;
        }
        (id, item)
    })
}

/// What a term can begin with; what is of the expected domain comes first.
fn terms(analysis: &Analysis, place: &place::Place, expected: Expected) -> Vec<Item> {
    let model = &analysis.model;
    let Expected(expected) = expected;
    let fits = |domain: DomainId| {
        expected.is_some_and(|wanted| model.domains.type_domain(wanted) == model.domains.type_domain(domain))
    };
    let mut items = Vec::new();
    for (name, domain) in model.names.all_literals() {
        let rank = if fits(domain) { 0 } else { 3 };
        items.push(Item::new(name, ItemKind::Literal, model.domains.display(domain), rank));
    }
    for (name, domain, shown) in &place.variables {
        let rank = if domain.is_none_or(fits) || expected.is_none() { 0 } else { 1 };
        items.push(Item::new(name, ItemKind::Variable, shown.clone(), rank));
    }
    for (id, mut item) in functions(analysis) {
        let codomain = model.function(id).codomain;
        if fits(codomain) && !model.function(id).library {
            item.rank = 1;
        } else if expected.is_some() {
            item.rank = item.rank.max(2);
        }
        items.push(item);
    }
    for (name, id) in model.names.all_domains() {
        items.push(Item::new(name, ItemKind::Domain, declaration(analysis, Referent::Domain(id)), 4));
    }
    let truth = if expected == Some(Domains::BOOLEAN) { 0 } else { 4 };
    items.extend(["true", "false"].map(|word| Item::new(word, ItemKind::Keyword, "Boolean", truth)));
    items.push(Item::new("undef", ItemKind::Keyword, "no value", 4));
    items.extend(snippet::terms());
    items
}
