//! Runs the scenarios of a report, with progress, until interrupted.
//!
//! In: paths. Out: what they contribute to the report, by `groundstate::reporting`.

use std::path::{Path, PathBuf};

use ::report::Report;
use groundstate::reporting::{reported_coverage, reported_scenario};
use groundstate::scenario::Options;
use groundstate::{SeededChoices, Suite};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::collect;
use crate::interrupt;
use crate::progress::Progress;
use crate::shell::Shell;

/// Runs the scenarios below these paths as `test` does, and adds their results.
pub fn add(shell: &Shell, report: &mut Report, model: &Path, paths: &[PathBuf], seed: u64) -> Result<Exit, Failure> {
    if paths.is_empty() {
        return Ok(Exit::Good);
    }
    let files = collect(paths, &["avalla"])?;
    let mut suite = Suite::new();
    let options = Options { limits: shell.global.limits.uninterrupted(), coverage: true, ..Options::default() };
    let mut progress = Progress::new(Some(files.len() as u64), shell.global.quiet);
    for (index, path) in files.iter().enumerate() {
        if interrupt::asked() {
            return Ok(Exit::Unknown);
        }
        let mut disk = shell.disk();
        let source = disk.root(path)?;
        let tested = suite.test(source, &mut disk, options.clone(), &mut SeededChoices::new(seed));
        report.scenarios.push(reported_scenario(path.display().to_string(), &tested));
        progress.at(index as u64 + 1);
    }
    progress.done();
    report.coverage = reported_coverage(&suite, &|name| same(Path::new(name), model), files.len());
    Ok(if report.passed() == files.len() { Exit::Good } else { Exit::Model })
}

/// Whether two paths name the same file.
fn same(one: &Path, other: &Path) -> bool {
    let whole = |path: &Path| path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
    whole(one) == whole(other)
}
