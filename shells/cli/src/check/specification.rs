//! Checks `MODEL.report.yaml` and `MODEL.verify.yaml`. Reads the model beside them from the disk; `groundstate` finds
//! the faults.

use std::path::Path;

use groundstate::workspace::Findings;
use groundstate::{check_specification, model_of};
use syntax::SourceFile;

use super::Seen;
use crate::failure::Failure;
use crate::files::Disk;

/// Checks a specification.
pub fn look(path: &Path, root: &SourceFile, disk: &mut Disk) -> Result<Seen, Failure> {
    let model = match disk.root(&model_of(path)) {
        Ok(source) => Some(source),
        Err(Failure::Missing(_)) => None,
        Err(failure) => return Err(failure),
    };
    let Findings { faults, open } = check_specification(root, model, disk);
    // Nothing was found at fault in nothing.
    let is_empty = root.text.lines().all(|line| matches!(line.trim(), "" | "---") || line.trim().starts_with('#'));
    let size = if is_empty { " (it says nothing)".to_string() } else { String::new() };
    Ok(Seen { faults, open, size })
}

/// The name of a YAML file is not that of a specification.
pub fn unnamed(path: &Path) -> Failure {
    Failure::usage_with_help(
        format!("{} does not have the name of a specification", path.display()),
        "specifications are called MODEL.report.yaml and MODEL.verify.yaml, beside MODEL.asm",
    )
}
