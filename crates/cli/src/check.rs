//! `groundstate check FILE…`: faults only.

use std::collections::BTreeSet;
use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use groundstate::Suite;
use model::Model;
use syntax::{Diagnostic, Severity, Sources};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::shell::Shell;
use crate::wire::Answer;

/// Arguments of `check`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Models (.asm) and scenarios (.avalla), or folders of them
    #[arg(required = true, value_name = "PATH")]
    paths: Vec<PathBuf>,
    /// Treat warnings as errors
    #[arg(long)]
    strict: bool,
}

/// How many files had what.
#[derive(Debug, Default, Clone, Copy)]
struct Summary {
    files: usize,
    errors: usize,
    warnings: usize,
}

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    let mut summary = Summary::default();
    let mut seen = BTreeSet::new();
    let mut suite = Suite::new();
    for path in crate::files::collect(&arguments.paths, &["asm", "avalla"])? {
        check_one(shell, &path, &mut summary, &mut seen, &mut suite)?;
    }
    if shell.json() {
        let Summary { files, errors, warnings } = summary;
        shell.object(&Answer::Checked { files, errors, warnings })?;
    }
    let bad = summary.errors > 0 || arguments.strict && summary.warnings > 0;
    Ok(if bad { Exit::Model } else { Exit::Good })
}

fn check_one(
    shell: &mut Shell,
    path: &Path,
    summary: &mut Summary,
    seen: &mut BTreeSet<String>,
    suite: &mut Suite,
) -> Result<(), Failure> {
    let mut disk = shell.disk();
    let root = disk.root(path)?;
    let scenario = path.extension().is_some_and(|extension| extension == "avalla");
    let (sources, diagnostics, size) = if scenario {
        let checked = suite.check(root, &mut disk);
        (checked.sources, checked.diagnostics, String::new())
    } else {
        let checked = groundstate::check(root, &mut disk);
        (checked.sources, checked.diagnostics, size(&checked.model))
    };
    // A module with faults that several files import is reported once.
    let new: Vec<Diagnostic> = diagnostics.into_iter().filter(|found| seen.insert(key(&sources, found))).collect();
    let count = |severity| new.iter().filter(|diagnostic| diagnostic.severity == severity).count();
    let (errors, warnings) = (count(Severity::Error), count(Severity::Warning));
    shell.diagnostics(&sources, &new)?;
    summary.files += 1;
    summary.errors += errors;
    summary.warnings += warnings;
    if shell.talks() {
        let verdict = match (errors, warnings) {
            (0, 0) => "no faults".to_string(),
            (0, _) => plural(warnings, "warning"),
            (_, 0) => plural(errors, "error"),
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

/// `1 rule`, `2 rules`.
pub fn plural(count: usize, word: &str) -> String {
    if count == 1 { format!("1 {word}") } else { format!("{count} {word}s") }
}
