//! Merges a chart's parts into an existing file: replaces what the chart determines, adds what is missing, keeps the
//! rest.
//!
//! In: the file's text, without errors. Out: the new text; bytes outside the replaced items do not change.

use std::collections::BTreeSet;

use syntax::ast::trimmed_range;
use syntax::{Diagnostic, FileId, Severity, SyntaxKind, SyntaxKind::*, SyntaxNode};

use super::edit::{Edit, apply};
use super::module::{Item, Parts, quoted};
use super::{observed, running};
use crate::chart::Chart;

/// Merges the parts into a text; also returns the names that the text declared before.
pub(super) fn into(text: &str, chart: &Chart, parts: &Parts) -> Result<(String, Vec<String>), Vec<Diagnostic>> {
    let parse = syntax::parse_asmetal(FileId(0), text);
    if parse.diagnostics.iter().any(|fault| fault.severity == Severity::Error) {
        return Err(parse.diagnostics);
    }
    let root = parse.syntax();
    let Some(signature) = section(&root, SIGNATURE) else {
        return Ok((super::module::fresh(chart, parts), Vec::new()));
    };
    let definitions = section(&root, DEFINITIONS);
    let mut edits = Vec::new();
    imports(&root, chart, parts, &mut edits);
    items(&signature, &parts.declarations, &mut edits);
    if parts.owns {
        forgotten(&signature, parts, &mut edits);
        for (kind, new) in [(MAIN_RULE, &parts.main), (INIT, &parts.init)] {
            if let (Some(node), Some(new)) = (section(&root, kind), new) {
                edits.push(Edit::replacing(&node, new.trim_end().to_string()));
            }
        }
    } else {
        running::calls(&root, &parts.running, &mut edits);
        running::starts(&root, &parts.starts, &mut edits);
    }
    if let Some(definitions) = &definitions {
        if parts.owns {
            unbounded(definitions, parts, &mut edits);
        }
        items(definitions, &parts.definitions, &mut edits);
    }
    if section(&root, MAIN_RULE).is_some() && section(&root, INIT).is_none() {
        edits.extend(parts.init.iter().map(|init| Edit {
            start: text.len(),
            end: text.len(),
            text: format!("\n{init}"),
        }));
    }
    if section(&root, MAIN_RULE).is_none() {
        // The initial states come behind it.
        let init = section(&root, INIT);
        let before_init = definitions.as_ref().filter(|_| init.is_some()).map(|node| trimmed_range(node).end().into());
        let at = before_init.unwrap_or(text.len());
        let mut end: String = parts.main.iter().map(|main| format!("\n{main}")).collect();
        if init.is_none() {
            end.extend(parts.init.iter().map(|init| format!("\n{init}")));
        }
        let text = if before_init.is_some() { format!("\n{}", end.trim_end()) } else { end };
        edits.push(Edit { start: at, end: at, text });
    }
    let sections = root.children().filter(|node| matches!(node.kind(), SIGNATURE | DEFINITIONS));
    let there = sections.flat_map(|section| section.children()).filter_map(|node| declared(&node)).collect();
    Ok((apply(text, edits), there))
}

fn section(root: &SyntaxNode, kind: SyntaxKind) -> Option<SyntaxNode> {
    root.children().find(|node| node.kind() == kind)
}

/// If the model to build into is among the chart's imports, as after an extraction, it does not import itself.
fn imports(root: &SyntaxNode, chart: &Chart, parts: &Parts, edits: &mut Vec<Edit>) {
    let there: Vec<SyntaxNode> = root.children().filter(|node| node.kind() == IMPORT).collect();
    let has = |path: &String| there.iter().any(|node| node.text().to_string().trim_end().ends_with(path.as_str()));
    let own = |path: &String| path.trim_start_matches("./").trim_end_matches(".asm") == chart.name;
    let missing = parts.imports.iter().filter(|path| !has(path) && !own(path));
    let text: String = missing.map(|path| format!("\nimport {}", quoted(path))).collect();
    let name = root.children().find(|node| node.kind() == MACHINE_NAME);
    if let Some(before) = there.last().or(name.as_ref()) {
        let at = usize::from(trimmed_range(before).end());
        edits.push(Edit { start: at, end: at, text });
    }
}

/// The name that an item declares: the first name in it.
fn declared(node: &SyntaxNode) -> Option<String> {
    let names = [FUNCTION_ID, DOMAIN_ID, ENUM_ID, RULE_ID, INVARIANT_ID];
    let tokens = node.descendants_with_tokens().filter_map(|element| element.into_token());
    tokens.into_iter().find(|token| names.contains(&token.kind())).map(|token| token.text().to_string())
}

fn items(section: &SyntaxNode, wanted: &[Item], edits: &mut Vec<Edit>) {
    let mut there = BTreeSet::new();
    for node in section.children() {
        let Some(name) = declared(&node) else { continue };
        let is_new = |item: &&Item| item.decided || observed::is_outdated(&node.text().to_string(), &item.text);
        if let Some(item) = wanted.iter().filter(|item| item.name == name).find(is_new) {
            edits.push(Edit::replacing(&node, without_note(&item.text).trim_end().to_string()));
        }
        there.insert(name);
    }
    let missing = wanted.iter().filter(|item| !there.contains(&item.name));
    let text: String = missing.map(|item| format!("\n\n{}", item.text.trim_end())).collect();
    let at = usize::from(trimmed_range(section).end());
    edits.push(Edit { start: at, end: at, text });
}

/// Removes elements of the system's domains that are no longer in the chart.
fn forgotten(signature: &SyntaxNode, parts: &Parts, edits: &mut Vec<Edit>) {
    for node in signature.children().filter(|node| node.kind() == FUNCTION_DECL) {
        let text = node.text().to_string();
        let of = text.rsplit(':').next().unwrap_or_default().trim();
        let element = text.starts_with("static") && super::known::OWNED.contains(&of);
        let name = declared(&node).unwrap_or_default();
        if element && !parts.declarations.iter().any(|item| item.name == name) {
            edits.push(Edit::replacing(&node, String::new()));
        }
    }
}

/// Removes the invariants of bounds that are no longer in the chart: what they speak of is gone.
fn unbounded(definitions: &SyntaxNode, parts: &Parts, edits: &mut Vec<Edit>) {
    for node in definitions.children().filter(|node| node.kind() == INVARIANT) {
        let name = declared(&node).unwrap_or_default();
        let text = node.text().to_string();
        let is_age = name.starts_with("inv_age") && text.contains("way_tooOld(bound");
        if (is_age || observed::is_made(&name, &text)) && !parts.definitions.iter().any(|item| item.name == name) {
            edits.push(Edit::replacing(&node, String::new()));
        }
    }
}

/// The text without its leading comment: the file has its own.
fn without_note(text: &str) -> &str {
    let mut rest = text;
    while let Some(("", behind)) = rest.split_once("//").map(|(before, behind)| (before.trim(), behind)) {
        rest = behind.split_once('\n').map_or("", |(_, rest)| rest);
    }
    rest
}
