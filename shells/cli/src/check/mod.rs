//! `groundstate check PATH…`: reports faults only, for every kind of file in a project.
//!
//! The ending tells what a file is: a model, a scenario, a chart, a report specification, a verification specification, a coupling.
//! INVARIANT: *no faults* is printed only for files that were checked completely. If a part could not be checked, that
//! is printed instead, and the command ends with *not known*.

mod chart;
mod specification;

use std::collections::BTreeSet;
use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use groundstate::workspace::Findings;
use groundstate::{Kind, Located, Suite, has_ending};
use model::Model;
use syntax::{Diagnostic, Severity, SourceFile, Sources};
use wire::Answer;

pub use groundstate::tell::plural;

use crate::exit::Exit;
use crate::failure::Failure;
use crate::shell::Shell;

/// Arguments of `check`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Models (.asm), scenarios (.avalla), charts (.chart), specifications of reports (.report.yaml) or of
    /// verifications (.verify.yaml), couplings (.refine), or folders of them
    #[arg(required = true, value_name = "PATH")]
    paths: Vec<PathBuf>,
    /// Treat warnings as errors
    #[arg(long)]
    strict: bool,
}

/// How many files had which result.
#[derive(Debug, Default, Clone, Copy)]
struct Summary {
    files: usize,
    errors: usize,
    warnings: usize,
    /// Files that could not be checked completely.
    open: usize,
}

/// The result for a file.
#[derive(Default)]
struct Seen {
    faults: Vec<Located>,
    /// The file's size, in parentheses.
    size: String,
    /// What could not be checked, and why.
    open: Option<String>,
}

impl Seen {
    fn of(sources: Sources, diagnostics: Vec<Diagnostic>) -> Seen {
        Seen { faults: vec![(sources, diagnostics)], ..Seen::default() }
    }
}

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    let mut summary = Summary::default();
    let mut seen = BTreeSet::new();
    let mut suite = Suite::new();
    for path in crate::files::collect(&arguments.paths, &Kind::ENDINGS)? {
        check_one(shell, &path, &mut summary, &mut seen, &mut suite)?;
    }
    if shell.json() {
        let Summary { files, errors, warnings, .. } = summary;
        shell.object(&Answer::Checked { files, errors, warnings })?;
    }
    let bad = summary.errors > 0 || arguments.strict && summary.warnings > 0;
    Ok(match (bad, summary.open) {
        (true, _) => Exit::Model,
        (false, 0) => Exit::Good,
        (false, _) => Exit::Unknown,
    })
}

fn look(shell: &Shell, path: &Path, root: SourceFile, suite: &mut Suite) -> Result<Seen, Failure> {
    let mut disk = shell.disk();
    match Kind::of(path) {
        Some(Kind::Scenario) => {
            let checked = suite.check(root, &mut disk);
            return Ok(Seen::of(checked.sources, checked.diagnostics));
        }
        Some(Kind::Chart) => return chart::look(path, root, &mut disk),
        Some(Kind::Report | Kind::Verification) => return specification::look(path, &root, &mut disk),
        Some(Kind::Coupling) => {
            let Findings { faults, open } = groundstate::check_coupling(&root, &mut disk);
            return Ok(Seen { faults, open, ..Seen::default() });
        }
        None if has_ending(path, "yaml") || has_ending(path, "yml") => return Err(specification::unnamed(path)),
        Some(Kind::Model) | None => {}
    }
    let checked = groundstate::check(root, &mut disk);
    let size = size(&checked.model);
    Ok(Seen { size, ..Seen::of(checked.sources, checked.diagnostics) })
}

fn check_one(
    shell: &mut Shell,
    path: &Path,
    summary: &mut Summary,
    seen: &mut BTreeSet<String>,
    suite: &mut Suite,
) -> Result<(), Failure> {
    let root = shell.disk().root(path)?;
    let own = root.name.clone();
    let Seen { faults, size, open } = look(shell, path, root, suite)?;
    let (mut errors, mut warnings) = (0, 0);
    // What rests on a file with errors was not looked at.
    let mut faulty: Vec<String> = Vec::new();
    for (sources, diagnostics) in faults {
        let wrong = diagnostics.iter().filter(|found| found.severity == Severity::Error);
        faulty.extend(wrong.map(|found| sources.file(found.primary.span.file).name.clone()));
        // A module with faults that several files import is reported once.
        let new: Vec<Diagnostic> = diagnostics.into_iter().filter(|found| seen.insert(key(&sources, found))).collect();
        let count = |severity| new.iter().filter(|diagnostic| diagnostic.severity == severity).count();
        errors += count(Severity::Error);
        warnings += count(Severity::Warning);
        shell.diagnostics(&sources, &new)?;
    }
    summary.files += 1;
    summary.errors += errors;
    summary.warnings += warnings;
    summary.open += usize::from(open.is_some());
    if let (Some(open), true) = (&open, shell.json()) {
        shell.note(&format!("{}: {open}", path.display()))?;
    }
    if shell.talks() {
        let is_beside = !matches!(Kind::of(path), Some(Kind::Model | Kind::Chart) | None);
        let other = faulty.first().filter(|_| !faulty.contains(&own) && (errors == 0 || is_beside));
        let open = open.or_else(|| other.map(|other| format!("not checked: {other} has errors")));
        let verdict = match (errors, warnings, open) {
            (_, _, Some(open)) if other.is_some() => open,
            (0, 0, Some(open)) => open,
            (0, 0, None) => "no faults".to_string(),
            (0, _, _) => plural(warnings, "warning"),
            (_, 0, _) => plural(errors, "error"),
            _ => format!("{}, {}", plural(errors, "error"), plural(warnings, "warning")),
        };
        writeln!(shell.out(), "{}: {verdict}{size}", path.display())?;
    }
    Ok(())
}

fn key(sources: &Sources, diagnostic: &Diagnostic) -> String {
    format!("{} {} {}", sources.position(diagnostic.primary.span), diagnostic.id, diagnostic.message)
}

fn size(model: &Model) -> String {
    let functions = model.functions.iter().filter(|function| !function.library).count();
    let rules = model.rules.len();
    let invariants = model.properties.iter().filter(|p| p.kind == model::PropertyKind::Invariant).count();
    format!(" ({}, {}, {})", plural(functions, "function"), plural(rules, "rule"), plural(invariants, "invariant"))
}
