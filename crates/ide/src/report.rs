//! What is wrong with a file and with what it imports, and what of it is of no use.
//!
//! In: a project and a file. Out: [`Report`]s, one for each file that has faults; that of the file itself comes first, empty if
//! nothing is wrong with it.

use std::collections::BTreeMap;

use groundstate::workspace::{Absent, Files, Findings};
use model::{FunctionKind, Referent};
use syntax::ast::AstNode;
use syntax::{Diagnostic, Severity, Sources, Span};

use crate::analysis::{Analysis, Place};
use crate::project::{Project, library_text};

/// LIMIT: so many names that nothing names are told.
const UNUSED: usize = 200;

/// How bad a fault is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Weight {
    /// The text means nothing, or not what its author thinks.
    Error,
    /// Likely not what its author thinks.
    Warning,
    /// A remark.
    Note,
    /// Of no use: shown faded.
    Unused,
}

/// A fault at its place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    /// The bytes.
    pub range: (u32, u32),
    /// How bad.
    pub weight: Weight,
    /// The name of its page; empty if it has none.
    pub id: &'static str,
    /// What is wrong, and what is seen there.
    pub message: String,
    /// What to do.
    pub help: Option<String>,
    /// Other places that matter.
    pub related: Vec<(Place, String)>,
}

/// What is wrong with a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Report {
    /// The file.
    pub path: String,
    /// Its faults, in the order of their places.
    pub faults: Vec<Fault>,
}

/// What is wrong with a file, and with the files that it reads.
///
/// # Errors
/// There is no such file.
pub fn reports<F: Files>(project: &mut Project<F>, path: &str) -> Result<Vec<Report>, Absent> {
    let findings = project.findings(path)?;
    let analysis = project.analysis(path)?;
    let own = analysis.source().name.clone();
    let mut reports = vec![Report { path: own.clone(), faults: Vec::new() }];
    for (sources, fault) in all(&findings) {
        let file = sources.file(fault.primary.span.file).name.clone();
        // What is wrong with a library would be our fault, and nobody could mend it.
        if library_text(&file).is_some() {
            continue;
        }
        let found = reported(sources, fault);
        match reports.iter_mut().find(|report| report.path == file) {
            Some(report) => report.faults.push(found),
            None => reports.push(Report { path: file, faults: vec![found] }),
        }
    }
    if let Some(reason) = &findings.open {
        let (range, id) = ((0, 0), "");
        let note = Fault { range, weight: Weight::Note, id, message: reason.clone(), help: None, related: Vec::new() };
        reports[0].faults.push(note);
    }
    reports[0].faults.extend(unused(&analysis));
    for report in &mut reports {
        report.faults.sort_by(|a, b| (a.range, a.weight, &a.message).cmp(&(b.range, b.weight, &b.message)));
        report.faults.dedup();
    }
    Ok(reports)
}

fn all(findings: &Findings) -> impl Iterator<Item = (&Sources, &Diagnostic)> {
    findings.faults.iter().flat_map(|(sources, faults)| faults.iter().map(move |fault| (sources, fault)))
}

fn reported(sources: &Sources, fault: &Diagnostic) -> Fault {
    let weight = match fault.severity {
        Severity::Error => Weight::Error,
        Severity::Warning => Weight::Warning,
        Severity::Note => Weight::Note,
    };
    let place = |span: Span| Place { path: sources.file(span.file).name.clone(), range: (span.start, span.end) };
    let seen = &fault.primary.text;
    let message = if seen.is_empty() { fault.message.clone() } else { format!("{}: {seen}", fault.message) };
    Fault {
        range: (fault.primary.span.start, fault.primary.span.end),
        weight,
        id: fault.id,
        message,
        help: fault.help.clone(),
        related: fault.secondary.iter().map(|label| (place(label.span), label.text.clone())).collect(),
    }
}

/// Functions and rules of a model that nothing in it names. A file that lets others import it is not asked, nor one with errors:
/// what is of no use there cannot be known.
fn unused(analysis: &Analysis) -> Vec<Fault> {
    let Some(machine) = analysis.machine() else { return Vec::new() };
    let Some(main) = machine.main_rule() else { return Vec::new() };
    let has_errors = analysis.findings.diagnostics().any(|fault| fault.severity == Severity::Error);
    if machine.export().is_some() || has_errors {
        return Vec::new();
    }
    let main = main.range();
    let mut places: BTreeMap<Referent, Vec<Span>> = BTreeMap::new();
    for name in &analysis.names {
        places.entry(name.referent).or_default().push(name.span);
    }
    let mut found = Vec::new();
    for name in analysis.names.iter().filter(|name| name.declares) {
        if found.len() == UNUSED {
            break;
        }
        let what = match name.referent {
            Referent::Function(id) if analysis.model.function(id).kind != FunctionKind::Local => "function",
            Referent::Rule(_) if name.span.start < main.start().into() || name.span.start >= main.end().into() => {
                "rule"
            }
            Referent::Function(_)
            | Referent::Rule(_)
            | Referent::Domain(_)
            | Referent::Literal(..)
            | Referent::Variable(..) => continue,
        };
        if places[&name.referent].iter().any(|span| *span != name.span) {
            continue;
        }
        let written = &analysis.text()[name.span.range()];
        let message = format!("nothing in the model names the {what} `{written}`");
        let range = (name.span.start, name.span.end);
        found.push(Fault { range, weight: Weight::Unused, id: "", message, help: None, related: Vec::new() });
    }
    found
}
