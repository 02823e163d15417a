//! Finds what is mutated and who judges.
//!
//! In: the paths of the command. Out: paths of texts, models, charts, scenarios and couplings, tidied. A folder stands for all files below it.

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
    /// The charts that judge.
    pub charts: Vec<String>,
    /// The scenarios that judge.
    pub scenarios: Vec<String>,
    /// The couplings that judge.
    pub couplings: Vec<String>,
    /// Whoever judges was named: what does not pass as it is ends the command.
    pub strict: bool,
}

impl Found {
    /// What is mutated stands at `paths`, who judges at `by`; without these, the models themselves, and the scenarios and
    /// couplings in their folders judge.
    pub fn new(paths: &[PathBuf], by: &[PathBuf]) -> Result<Found, Failure> {
        if let Some(path) = paths.iter().chain(by).find(|path| !path.exists()) {
            return Err(Failure::Missing(path.clone()));
        }
        if let Some(path) = paths.iter().find(|path| has_ending(path, "avalla")) {
            return Err(another(path, "scenario", "scenarios judge: name them with --by"));
        }
        let mutated: BTreeSet<String> = texts(paths)?.iter().map(|path| name(path)).collect();
        let judges = if by.is_empty() { paths } else { by };
        if let Some(chart) = by.iter().find(|path| has_ending(path, "chart") && !mutated.contains(&name(path))) {
            let help = "name it before --by as well, or name the models and scenarios that use what is built of it";
            let message = format!("{} judges its own mutants alone", chart.display());
            return Err(Failure::usage_with_help(message, help));
        }
        let mut files = Vec::new();
        for path in judges {
            // A folder may have models without scenarios, or scenarios alone.
            files.extend(collect(std::slice::from_ref(path), &["asm", "avalla", "refine", "chart"])?);
            if by.is_empty() && !path.is_dir() {
                let folder = path.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."));
                files.extend(collect(&[folder.to_path_buf()], &["avalla", "refine"]).unwrap_or_default());
            }
        }
        let mut seen = BTreeSet::new();
        let names: Vec<String> = files.iter().map(|path| name(path)).filter(|path| seen.insert(path.clone())).collect();
        let of_kind = |ending: &str| {
            names.iter().filter(|path| has_ending(Path::new(path), ending)).cloned().collect::<Vec<String>>()
        };
        let (models, scenarios, couplings) = (of_kind("asm"), of_kind("avalla"), of_kind("refine"));
        let charts = of_kind("chart");
        let strict = !judges.iter().any(|path| path.is_dir());
        Ok(Found { mutated, models, charts, scenarios, couplings, strict })
    }
}

/// The texts to mutate. A folder stands for the models below it: that of a chart is mutated, the chart if it is named.
fn texts(paths: &[PathBuf]) -> Result<Vec<PathBuf>, Failure> {
    let mut texts = Vec::new();
    for path in paths {
        let endings: &[&str] = if path.is_dir() { &["asm"] } else { &["asm", "chart"] };
        texts.extend(collect(std::slice::from_ref(path), endings)?);
    }
    Ok(texts)
}

fn name(path: &Path) -> String {
    tidy(&path.to_string_lossy())
}
