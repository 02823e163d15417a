//! The recorded results: tables and traces → jobs.
//!
//! In: the folder with `parse.csv`, `avalla.csv` and the traces, packed (`traces.tar.xz`) or not (`traces/`). Out: jobs
//! in the order of the tables, the traces by name.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::job::Job;
use super::trace;
use crate::Failure;

/// The kinds of trace, in the order of the report.
pub const KINDS: [&str; 3] = ["det", "mon", "choose"];

/// The recorded results.
#[derive(Debug)]
pub struct Recorded {
    /// What there is to compare.
    pub jobs: Vec<Job>,
    /// Where the traces were unpacked to; removed when this goes.
    _unpacked: Option<tempfile::TempDir>,
}

/// Reads all recorded results of a folder; `scripts` is the folder that runs are written to.
///
/// # Errors
/// A table is missing or not as it should be; the traces cannot be unpacked.
pub fn read(folder: &Path, scripts: Option<&str>) -> Result<Recorded, Failure> {
    let mut jobs = Vec::new();
    for row in rows(&folder.join("parse.csv"), 3)? {
        let [path, status, message] = &row[..3] else { continue };
        jobs.push(Job::Accept { path: path.clone(), accepted: status == "OK", message: message.clone() });
    }
    let (traces, unpacked) = traces(folder)?;
    for kind in KINDS {
        let mut files: Vec<PathBuf> = std::fs::read_dir(traces.join(kind))
            .map_err(|error| format!("{}: {error}", traces.join(kind).display()))?
            .filter_map(|entry| entry.ok().map(|entry| entry.path()))
            .collect();
        files.sort();
        for file in files {
            let text = std::fs::read_to_string(&file).map_err(|error| format!("{}: {error}", file.display()))?;
            let path = trace::read(&text)?.path;
            let (kind, file, scripts) = (kind.to_string(), file.display().to_string(), scripts.map(String::from));
            jobs.push(Job::Replay { kind, file, path, scripts });
        }
    }
    for row in rows(&folder.join("avalla.csv"), 3)? {
        let [path, status, message] = &row[..3] else { continue };
        let checks = row.get(3).and_then(|count| count.parse().ok()).unwrap_or(0);
        let (path, status, message) = (path.clone(), status.clone(), message.clone());
        jobs.push(Job::Scenario { path, status, message, checks });
    }
    Ok(Recorded { jobs, _unpacked: unpacked })
}

/// All models and scenarios of a checkout as jobs to run, in the order of their paths.
///
/// # Errors
/// A folder cannot be read.
pub fn everything(checkout: &Path, recorded: &[Job]) -> Result<Vec<Job>, Failure> {
    let known: BTreeSet<String> = recorded.iter().map(|job| job.subject().to_string()).collect();
    let mut paths = Vec::new();
    let mut open = vec![checkout.to_path_buf()];
    while let Some(folder) = open.pop() {
        let wrap = |error: std::io::Error| format!("{}: {error}", folder.display());
        for entry in std::fs::read_dir(&folder).map_err(wrap)? {
            let entry = entry.map_err(wrap)?;
            let path = entry.path();
            let kind = entry.file_type().map_err(wrap)?;
            if kind.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|extension| extension == "asm" || extension == "avalla") {
                paths.extend(path.strip_prefix(checkout).ok().map(|path| path.display().to_string()));
            }
        }
    }
    paths.sort();
    let job = |path: String| Job::Explore { recorded: known.contains(&path), path };
    Ok(paths.into_iter().map(job).collect())
}

fn rows(path: &Path, columns: usize) -> Result<Vec<Vec<String>>, Failure> {
    let wrap = |error: csv::Error| format!("{}: {error}", path.display());
    let mut reader = csv::ReaderBuilder::new().flexible(true).from_path(path).map_err(wrap)?;
    let rows: Result<Vec<_>, _> = reader.records().collect();
    let rows = rows.map_err(wrap)?.into_iter().map(|row| row.iter().map(String::from).collect::<Vec<_>>());
    Ok(rows.filter(|row| row.len() >= columns).collect())
}

fn traces(folder: &Path) -> Result<(PathBuf, Option<tempfile::TempDir>), Failure> {
    if folder.join("traces").is_dir() {
        return Ok((folder.join("traces"), None));
    }
    let target = tempfile::tempdir().map_err(|error| format!("no temporary folder: {error}"))?;
    let archive = folder.join("traces.tar.xz");
    let status = Command::new("tar").arg("-xf").arg(&archive).arg("-C").arg(target.path()).status();
    match status {
        Ok(status) if status.success() => {}
        Ok(_) => return Err(format!("{} cannot be unpacked", archive.display())),
        Err(error) => return Err(format!("tar cannot be run: {error}")),
    }
    let inner = target.path().join("traces");
    let root = if inner.is_dir() { inner } else { target.path().to_path_buf() };
    Ok((root, Some(target)))
}
