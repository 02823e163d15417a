//! What there is to know of a name: its declaration, its meaning, what reads and updates it.
//!
//! In: a project, a file and an offset. Out: Markdown. The meaning is the comment beside the declaration, or, for a function of a
//! library, what spec/standard-library.md says.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::Arc;

use groundstate::Kind;
use groundstate::workspace::Files;
use model::{DomainKind, FunctionId, FunctionKind, Referent, Rule, Use, kind_word};
use syntax::Span;

use crate::analysis::{Analysis, Place, Role};
use crate::coupling;
use crate::navigate::others_that_write;
use crate::project::Project;

/// The page that says what the functions of the libraries mean.
const LIBRARY: &str = include_str!("../../../spec/standard-library.md");

/// What to show of a name, and where that stands.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Hover {
    /// The name.
    pub place: Place,
    /// Markdown.
    pub text: String,
}

/// What there is to know of the name at an offset.
pub fn hover<F: Files>(project: &mut Project<F>, path: &str, offset: u32) -> Option<Hover> {
    let analysis = project.analysis(path).ok()?;
    if Kind::of(Path::new(path)) == Some(Kind::Coupling) {
        let named = coupling::named(project, &analysis, offset)?;
        let mut parts: Vec<String> = named
            .meant
            .iter()
            .map(|(model, referent)| describe(model, *referent, &[]) + &declared_in(model, *referent))
            .collect();
        parts.dedup();
        let place = Place { path: path.to_string(), range: named.range };
        return Some(Hover { place, text: parts.join("\n\n---\n\n") });
    }
    let names = analysis.names_at(offset);
    let first = names.first()?;
    let written = &analysis.text()[first.span.range()];
    let is_shared = |name: &Use| match name.referent {
        Referent::Function(id) => !analysis.model.function(id).library,
        Referent::Rule(_) => true,
        Referent::Domain(_) | Referent::Literal(..) | Referent::Variable(..) => false,
    };
    let others = match names.iter().any(is_shared) {
        true => others_that_write(project, &analysis, &[written]).0,
        false => Vec::new(),
    };
    let mut parts: Vec<String> = names.iter().map(|name| describe(&analysis, name.referent, &others)).collect();
    parts.dedup();
    Some(Hover { place: analysis.place(first.span), text: parts.join("\n\n---\n\n") })
}

/// Which model something is declared in, where its description does not say so.
fn declared_in(model: &Analysis, referent: Referent) -> String {
    let is_own = model.declaration(referent).is_some_and(|span| span.file == model.file);
    if is_own { format!("\n\nDeclared in `{}`.", model.source().name) } else { String::new() }
}

fn describe(analysis: &Analysis, referent: Referent, others: &[Arc<Analysis>]) -> String {
    let mut parts = vec![format!("```asmetal\n{}\n```", declaration(analysis, referent))];
    if let Some(span) = analysis.declaration(referent) {
        parts.extend(comment(&analysis.sources.file(span.file).text, span));
        if span.file != analysis.file {
            parts.push(format!("Declared in `{}`.", analysis.sources.file(span.file).name));
        }
    }
    if let Referent::Function(id) = referent {
        parts.extend(library_meaning(analysis, id));
    }
    parts.extend(used_by(analysis, referent, others));
    parts.join("\n\n")
}

/// How something is declared.
pub(crate) fn declaration(analysis: &Analysis, referent: Referent) -> String {
    let model = &analysis.model;
    let display = |domain| model.domains.display(domain);
    match referent {
        Referent::Function(id) => {
            let function = model.function(id);
            format!("{} {}", kind_word(function.kind), signature(analysis, id))
        }
        Referent::Rule(id) => rule_signature(analysis, model.rule(id)),
        Referent::Variable(span, domain) => {
            let name = analysis.sources.file(span.file).text.get(span.range()).unwrap_or_default();
            format!("{name} in {}", display(domain))
        }
        Referent::Literal(domain, place) => match model.domains.kind(domain) {
            DomainKind::Enum { literals } => {
                let name = literals.get(place as usize).map_or("", String::as_str);
                format!("{name} in {} = {{{}}}", display(domain), literals.join(" | "))
            }
            _ => display(domain),
        },
        Referent::Domain(id) => {
            let name = display(id);
            match model.domains.kind(id) {
                DomainKind::Enum { literals } => format!("enum domain {name} = {{{}}}", literals.join(" | ")),
                DomainKind::Abstract { dynamic: true } => format!("dynamic abstract domain {name}"),
                DomainKind::Abstract { dynamic: false } => format!("abstract domain {name}"),
                DomainKind::Concrete { base, dynamic, .. } => {
                    let dynamic = if *dynamic { "dynamic " } else { "" };
                    format!("{dynamic}domain {name} subsetof {}", display(*base))
                }
                DomainKind::Any => format!("anydomain {name}"),
                _ => format!("basic domain {name}"),
            }
        }
    }
}

/// `f: Prod(A,B) -> C`
pub(crate) fn signature(analysis: &Analysis, id: FunctionId) -> String {
    let model = &analysis.model;
    let function = model.function(id);
    let parts: Vec<String> = function.parameters.iter().map(|domain| model.domains.display(*domain)).collect();
    let codomain = model.domains.display(function.codomain);
    match parts.as_slice() {
        [] => format!("{}: {codomain}", function.name),
        [one] => format!("{}: {one} -> {codomain}", function.name),
        several => format!("{}: Prod({}) -> {codomain}", function.name, several.join(",")),
    }
}

/// `rule r_x($a in A)`
pub(crate) fn rule_signature(analysis: &Analysis, rule: &Rule) -> String {
    let domains = &analysis.model.domains;
    let parameters = parameters(analysis, rule);
    let list = if parameters.is_empty() { String::new() } else { format!("({})", parameters.join(", ")) };
    let result = rule.result.map(|domain| format!(" in {}", domains.display(domain))).unwrap_or_default();
    format!("{}rule {}{list}{result}", if rule.turbo { "turbo " } else { "" }, rule.name)
}

/// `$a in A` for each parameter.
pub(crate) fn parameters(analysis: &Analysis, rule: &Rule) -> Vec<String> {
    let of = |id: &model::VariableId| {
        let variable = &rule.variables[id.0 as usize];
        format!("{} in {}", variable.name, analysis.model.domains.display(variable.domain))
    };
    rule.parameters.iter().map(of).collect()
}

/// The comment before a declaration, or behind it in its line.
pub(crate) fn comment(text: &str, span: Span) -> Option<String> {
    let at = span.start as usize;
    let line_start = text.get(..at)?.rfind('\n').map_or(0, |end| end + 1);
    let line = text[line_start..].lines().next().unwrap_or_default();
    let mut found: Vec<&str> = Vec::new();
    let mut in_block = false;
    for before in text[..line_start].lines().rev() {
        let trimmed = before.trim();
        if in_block {
            in_block = !trimmed.starts_with("/*");
            found.push(trimmed.trim_start_matches("/*").trim_start_matches('*').trim());
            continue;
        }
        if let Some(comment) = trimmed.strip_prefix("//") {
            found.push(comment.trim());
        } else if let Some(comment) = trimmed.strip_suffix("*/") {
            in_block = !comment.starts_with("/*");
            if !in_block && !trimmed.starts_with("/*") {
                break;
            }
            found.push(comment.trim_start_matches("/*").trim_start_matches('*').trim());
        } else {
            break;
        }
    }
    found.reverse();
    found.extend(line.split_once("//").map(|(_, comment)| comment.trim()));
    let text = found.join("\n").trim().to_string();
    (!text.is_empty()).then_some(text)
}

/// What the page of the libraries says of a function.
fn library_meaning(analysis: &Analysis, id: FunctionId) -> Option<String> {
    let function = analysis.model.function(id);
    if !function.library {
        return None;
    }
    let meant = signature(analysis, id);
    let (_, meant) = meant.split_once(": ")?;
    let named = format!("| `{}` |", function.name);
    let rows: Vec<&str> = LIBRARY.lines().filter(|line| line.starts_with(&named)).collect();
    let row = rows.iter().find(|row| row.replace(", ", ",").contains(meant)).or(rows.first())?;
    let columns: Vec<&str> = row.trim_matches('|').split(" | ").map(str::trim).collect();
    let [_, _, meaning, rest @ ..] = columns.as_slice() else { return None };
    let undef = rest.first().filter(|text| !text.is_empty());
    Some(undef.map_or_else(|| meaning.to_string(), |undef| format!("{meaning}\n\nundef and errors: {undef}")))
}

/// What of the file, and of others, updates, calls and reads it.
fn used_by(analysis: &Analysis, referent: Referent, others: &[Arc<Analysis>]) -> Option<String> {
    let symbol = analysis.symbol(referent);
    let by = |wanted: Role| -> BTreeSet<String> {
        let names = analysis.names.iter().filter(|name| name.referent == referent && analysis.role(name) == wanted);
        let here = names.filter_map(|name| analysis.enclosing_rule(name.span)).map(|rule| format!("`{}`", rule.text()));
        let mut found: BTreeSet<String> = here.collect();
        for other in others {
            let path = &other.source().name;
            let file = path.rsplit(['/', '\\']).next().unwrap_or(path);
            let named = |name: &&Use| other.role(name) == wanted && other.symbol(name.referent) == symbol;
            for name in other.names.iter().filter(named) {
                found.insert(match other.enclosing_rule(name.span) {
                    Some(rule) => format!("`{}` in `{file}`", rule.text()),
                    None => format!("`{file}`"),
                });
            }
        }
        found
    };
    let listed = |words: &str, rules: BTreeSet<String>| {
        (!rules.is_empty()).then(|| format!("{words} {}.", rules.into_iter().collect::<Vec<_>>().join(", ")))
    };
    let parts: Vec<String> = match referent {
        Referent::Function(id) if !analysis.model.function(id).library => {
            let who = match analysis.model.function(id).kind {
                FunctionKind::Monitored => Some("Written by the environment.".to_string()),
                _ => None,
            };
            who.into_iter()
                .chain(listed("Updated by", by(Role::Write)))
                .chain(listed("Read by", by(Role::Read)))
                .collect()
        }
        Referent::Rule(_) => listed("Called by", by(Role::Call)).into_iter().collect(),
        _ => Vec::new(),
    };
    (!parts.is_empty()).then(|| parts.join(" "))
}
