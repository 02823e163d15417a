//! Finds what is mutated and who judges.
//!
//! In: the paths of the command. Out: paths of texts, models and scenarios, tidied. A folder stands for all files below it.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use groundstate::has_ending;
use groundstate::workspace::tidy;

use crate::failure::Failure;
use crate::files::collect;
use crate::load::another;

/// What was found.
pub struct Found {
    /// The texts to mutate.
    pub mutated: BTreeSet<String>,
    /// The models that judge.
    pub models: Vec<String>,
    /// The scenarios that judge.
    pub scenarios: Vec<String>,
    /// Whoever judges was named: what does not pass as it is ends the command.
    pub strict: bool,
}

impl Found {
    /// What is mutated stands at `paths`, who judges at `by`; without these, the models themselves and the scenarios in their
    /// folders judge.
    pub fn new(paths: &[PathBuf], by: &[PathBuf]) -> Result<Found, Failure> {
        for path in paths.iter().chain(by) {
            if has_ending(path, "chart") {
                return Err(another(path, "chart", "`groundstate chart build` writes its model, which can be mutated"));
            }
        }
        if let Some(path) = paths.iter().chain(by).find(|path| !path.exists()) {
            return Err(Failure::Missing(path.clone()));
        }
        if let Some(path) = paths.iter().find(|path| has_ending(path, "avalla")) {
            return Err(another(path, "scenario", "scenarios judge: name them with --by"));
        }
        let mutated: BTreeSet<String> = collect(paths, &["asm"])?.iter().map(|path| name(path)).collect();
        let judges = if by.is_empty() { paths } else { by };
        let mut files = Vec::new();
        for path in judges {
            // A folder may have models without scenarios, or scenarios alone.
            files.extend(collect(std::slice::from_ref(path), &["asm", "avalla"])?);
            if by.is_empty() && !path.is_dir() {
                let folder = path.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."));
                files.extend(collect(&[folder.to_path_buf()], &["avalla"]).unwrap_or_default());
            }
        }
        let mut seen = BTreeSet::new();
        let names: Vec<String> = files.iter().map(|path| name(path)).filter(|path| seen.insert(path.clone())).collect();
        let (scenarios, models) = names.into_iter().partition(|path| has_ending(Path::new(path), "avalla"));
        let strict = !judges.iter().any(|path| path.is_dir());
        Ok(Found { mutated, models, scenarios, strict })
    }
}

fn name(path: &Path) -> String {
    tidy(&path.to_string_lossy())
}
