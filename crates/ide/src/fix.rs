//! Remedies: edits that mend a fault.
//!
//! In: the faults of a file at a range. Out: [`Fix`]es. A remedy is offered only where the fault's own help names one; whether it
//! is what the author wants is for the author to say.

use groundstate::workspace::Files;
use syntax::SyntaxKind;
use syntax::ast::AstNode;

use crate::analysis::{Analysis, previous};
use crate::position::Edit;
use crate::project::Project;
use crate::report::{Fault, Weight, reports};

/// A remedy.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fix {
    /// What it does.
    pub title: String,
    /// The edits of the file.
    pub edits: Vec<Edit>,
    /// The fault that it mends.
    pub fault: Fault,
}

/// The remedies for the faults of a file that touch a range.
pub fn fixes<F: Files>(project: &mut Project<F>, path: &str, range: (u32, u32)) -> Vec<Fix> {
    let Ok(reports) = reports(project, path) else { return Vec::new() };
    let Ok(analysis) = project.analysis(path) else { return Vec::new() };
    let own = reports.into_iter().next().map(|report| report.faults).unwrap_or_default();
    let touched = own.into_iter().filter(|fault| fault.range.0 <= range.1 && range.0 <= fault.range.1);
    let mut found: Vec<Fix> = Vec::new();
    for fault in touched {
        for (title, edits) in remedies(&analysis, &fault) {
            found.push(Fix { title, edits, fault: fault.clone() });
        }
    }
    found
}

fn remedies(analysis: &Analysis, fault: &Fault) -> Vec<(String, Vec<Edit>)> {
    let (start, end) = fault.range;
    let written = analysis.text().get(start as usize..end as usize).unwrap_or_default();
    let replace = |text: &str| (format!("Write `{text}`"), vec![Edit::new(start..end, text)]);
    let mut found = Vec::new();
    if let Some(meant) = fault.help.as_deref().and_then(meant) {
        found.push((format!("Change to `{meant}`"), vec![Edit::new(start..end, meant)]));
    }
    match fault.id {
        "equals-for-assign" if written == "=" => found.push(replace(":=")),
        "assign-in-term" if written == ":=" => found.push(replace("=")),
        "missing-standard-library" => {
            if let Some(at) = end_of_header(analysis) {
                let title = "Import `StandardLibrary`".to_string();
                found.push((title, vec![Edit::insert(at, format!("{}import StandardLibrary", line_end(analysis)))]));
            }
        }
        "missing-end" => found.extend(missing_end(analysis, fault)),
        "stray-end" | "unexpected-text" if fault.help.as_deref().is_some_and(|help| help.starts_with("remove it")) => {
            found.push((format!("Remove `{written}`"), vec![Edit::new(start..end, "")]));
        }
        "static-derived-function" => found.extend(kind_of_declaration(analysis, written, "static")),
        "dynamic-in-static" => found.extend(declared_in_message(analysis, fault, "derived")),
        "update-not-allowed" => {
            found.extend(declared_in_message(analysis, fault, "controlled"));
        }
        "unknown-function" => found.extend(declare(analysis, fault, written)),
        "unknown-rule" => found.extend(define(analysis, written)),
        "unknown-variable" | "name-class" if written.starts_with(|c: char| c.is_ascii_lowercase()) => {
            let variable = format!("${written}");
            if analysis.text().contains(&variable) {
                found.push(replace(&variable));
            }
        }
        "file-name-mismatch" => {
            let stem = analysis.source().name.rsplit(['/', '\\']).next().and_then(|name| name.strip_suffix(".asm"));
            found.extend(stem.map(replace));
        }
        "missing-brackets" if written.starts_with("r_") => {
            let turbo = analysis.model.names.rules(written).iter().any(|id| analysis.model.rule(*id).turbo);
            found.push(replace(&format!("{written}{}", if turbo { "()" } else { "[]" })));
        }
        "missing-section" => found.extend(section(fault, start)),
        "number-form" | "expected-token" => {}
        _ => {}
    }
    found.extend(unused(analysis, fault));
    found.sort();
    found.dedup();
    found
}

/// The name in "did you mean `x`?".
fn meant(help: &str) -> Option<&str> {
    let (_, rest) = help.split_once("did you mean ")?;
    let (_, rest) = rest.split_once('`')?;
    rest.split_once('`').map(|(name, _)| name)
}

/// How the lines of a file end.
pub(crate) fn line_end(analysis: &Analysis) -> &'static str {
    if analysis.text().contains("\r\n") { "\r\n" } else { "\n" }
}

/// Where another import can be put.
fn end_of_header(analysis: &Analysis) -> Option<u32> {
    let machine = analysis.machine()?;
    let last = machine.imports().last().map(|import| import.range().end());
    let name = machine.machine_name().map(|name| name.range().end());
    Some(last.or(name)?.into())
}

/// The word that ends what is open, on a line of its own with the indentation of the word that opens it.
fn missing_end(analysis: &Analysis, fault: &Fault) -> Option<(String, Vec<Edit>)> {
    let word =
        fault.message.split('`').find(|part| part.starts_with("end") && part.chars().all(char::is_alphabetic))?;
    let (opener, _) = fault.related.first()?;
    let text = analysis.text();
    let line_start = text.get(..opener.range.0 as usize)?.rfind('\n').map_or(0, |at| at + 1);
    let indentation: String = text[line_start..].chars().take_while(|c| *c == ' ' || *c == '\t').collect();
    let before = analysis.token_at(fault.range.0)?;
    let before = if u32::from(before.text_range().start()) >= fault.range.0 || before.kind().is_trivia() {
        previous(&before)?
    } else {
        before
    };
    let at = u32::from(before.text_range().end());
    Some((format!("Write `{word}`"), vec![Edit::insert(at, format!("{}{indentation}{word}", line_end(analysis)))]))
}

/// Declares a function of the other kind.
fn kind_of_declaration(analysis: &Analysis, name: &str, kind: &str) -> Option<(String, Vec<Edit>)> {
    let signature = analysis.machine()?.signature()?;
    let declared = signature.functions().find(|one| one.name().is_some_and(|token| token.text() == name))?;
    let keyword = declared.kind()?;
    let tokens = declared.syntax().children_with_tokens().filter_map(|element| element.into_token());
    let token = tokens.into_iter().find(|token| token.kind() == keyword)?;
    let range: (u32, u32) = (token.text_range().start().into(), token.text_range().end().into());
    Some((format!("Declare `{name}` {kind}"), vec![Edit::new(range.0..range.1, kind)]))
}

/// The same for the function that the fault's help names.
fn declared_in_message(analysis: &Analysis, fault: &Fault, kind: &str) -> Option<(String, Vec<Edit>)> {
    if !fault.help.as_deref().is_some_and(|help| help.contains(kind)) {
        return None;
    }
    let name = fault.message.split('`').nth(1)?;
    kind_of_declaration(analysis, name, kind)
}

/// Declares a function from its use.
fn declare(analysis: &Analysis, fault: &Fault, name: &str) -> Option<(String, Vec<Edit>)> {
    if !name.starts_with(|c: char| c.is_ascii_lowercase()) || meant(fault.help.as_deref()?).is_some() {
        return None;
    }
    let token = analysis.token_at(fault.range.0)?;
    let term = token.parent()?;
    if term.children().any(|child| child.kind() == SyntaxKind::ARGUMENT_LIST) {
        // The domains of its arguments would be guessed.
        return None;
    }
    let in_update = term.parent().filter(|parent| parent.kind() == SyntaxKind::UPDATE_RULE);
    let is_target = in_update.as_ref().and_then(|update| update.children().next()).as_ref() == Some(&term);
    let (kind, domain) = match (is_target, in_update.and_then(|update| update.children().nth(1))) {
        (true, Some(value)) => ("controlled", domain_of_literal(analysis, &value)),
        _ => ("monitored", "Boolean".to_string()),
    };
    let signature = analysis.machine()?.signature()?;
    let at = u32::from(signature.range().end());
    let text = format!("{}\t{kind} {name}: {domain}", line_end(analysis));
    Some((format!("Declare `{kind} {name}: {domain}`"), vec![Edit::insert(at, text)]))
}

fn domain_of_literal(analysis: &Analysis, value: &syntax::SyntaxNode) -> String {
    let first = value.first_token();
    let domain = match first.as_ref().map(|token| token.kind()) {
        Some(SyntaxKind::TRUE_KW | SyntaxKind::FALSE_KW) => Some("Boolean".to_string()),
        Some(SyntaxKind::STRING) => Some("String".to_string()),
        Some(SyntaxKind::REAL) => Some("Real".to_string()),
        Some(SyntaxKind::ENUM_ID) => {
            let literal = first.and_then(|token| analysis.model.names.literal(token.text()));
            literal.map(|(domain, _)| analysis.model.domains.display(domain))
        }
        _ => None,
    };
    domain.unwrap_or_else(|| "Integer".to_string())
}

/// Defines a rule that does nothing yet.
fn define(analysis: &Analysis, name: &str) -> Option<(String, Vec<Edit>)> {
    let main = analysis.machine()?.main_rule()?;
    let end = line_end(analysis);
    let at = u32::from(main.range().start());
    Some((format!("Define `rule {name}`"), vec![Edit::insert(at, format!("rule {name} ={end}\t\tskip{end}{end}\t"))]))
}

/// The section that is missing.
fn section(fault: &Fault, at: u32) -> Option<(String, Vec<Edit>)> {
    let section = fault.help.as_deref()?.strip_prefix("write `")?.split_once(":`")?.0;
    Some((format!("Write `{section}:`"), vec![Edit::insert(at, format!("{section}:\n\n"))]))
}

/// Removes what nothing names.
fn unused(analysis: &Analysis, fault: &Fault) -> Option<(String, Vec<Edit>)> {
    if fault.weight != Weight::Unused {
        return None;
    }
    let token = analysis.token_at(fault.range.0)?;
    let declared = |kind| matches!(kind, SyntaxKind::FUNCTION_DECL | SyntaxKind::RULE_DECL);
    let node = token.parent().filter(|node| declared(node.kind()))?;
    let range = node.text_range();
    let text = analysis.text();
    let before = text[..usize::from(range.start())].trim_end_matches([' ', '\t']).len();
    let start = text[..before].trim_end_matches(['\n', '\r']).len().max(before.saturating_sub(2)) as u32;
    let end: u32 = range.end().into();
    Some((format!("Remove `{}`", token.text()), vec![Edit::new(start..end, "")]))
}
