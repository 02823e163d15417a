//! Tells the kind of a project's file from its name.
//!
//! In: a path. Out: its [`Kind`], and for a specification the paths of its model and of its chart. No file is read.

use std::path::{Path, PathBuf};

/// The kind of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// `.asm`: a model or a module.
    Model,
    /// `.avalla`.
    Scenario,
    /// `.chart`.
    Chart,
    /// `.report.yaml`: what a report of a model shows.
    Report,
    /// `.verify.yaml`: what to verify in a model.
    Verification,
    /// `.refine`: how two models correspond.
    Coupling,
}

impl Kind {
    /// The endings, without the leading dot.
    pub const ENDINGS: [&str; 6] = ["asm", "avalla", "chart", "report.yaml", "verify.yaml", "refine"];

    /// The kind of a file by its name; `None` if the ending is unknown.
    pub fn of(path: &Path) -> Option<Kind> {
        let kinds = [Kind::Model, Kind::Scenario, Kind::Chart, Kind::Report, Kind::Verification, Kind::Coupling];
        let found = Kind::ENDINGS.iter().position(|ending| has_ending(path, ending))?;
        Some(kinds[found])
    }
}

/// Whether a file's name ends with `.ENDING`.
pub fn has_ending(path: &Path, ending: &str) -> bool {
    let name = path.file_name().and_then(|name| name.to_str()).and_then(|name| name.strip_suffix(ending));
    name.is_some_and(|rest| rest.len() > 1 && rest.ends_with('.'))
}

/// The model of a specification: `Model.asm` for both `Model.report.yaml` and `Model.verify.yaml`.
pub fn model_of(specification: &Path) -> PathBuf {
    specification.with_extension("").with_extension("asm")
}

/// The chart that a verification specification is about if it draws a system: `Model.chart` for `Model.verify.yaml`.
pub fn chart_of(specification: &Path) -> PathBuf {
    specification.with_extension("").with_extension("chart")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_name_says_the_kind() {
        let check = |path: &str, expected: Option<Kind>| assert_eq!(Kind::of(Path::new(path)), expected, "{path}");
        check("a.b/Lamp.asm", Some(Kind::Model));
        check("Lamp.report.yaml", Some(Kind::Report));
        check("Lamp.verify.yaml", Some(Kind::Verification));
        check("Lamp.refine", Some(Kind::Coupling));
        for path in ["Lamp.yaml", "report.yaml", ".asm", "asm", "Lamp.asm.txt", "Lamp.report.yml"] {
            check(path, None);
        }
        assert_eq!(model_of(Path::new("a/Lamp.report.yaml")), Path::new("a/Lamp.asm"));
        assert_eq!(chart_of(Path::new("a/Lamp.verify.yaml")), Path::new("a/Lamp.chart"));
    }
}
