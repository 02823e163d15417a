//! What is to be shown of a model, `MODEL.report.yaml`, and what is to be verified of it, `MODEL.verify.yaml`: the model beside
//! it is read from the disk; what is wrong, `groundstate` says.

use std::path::Path;

use groundstate::workspace::Findings;
use groundstate::{check_specification, model_of};
use syntax::SourceFile;

use super::Seen;
use crate::failure::Failure;
use crate::files::Disk;

/// Looks at a specification.
pub fn look(path: &Path, root: &SourceFile, disk: &mut Disk) -> Result<Seen, Failure> {
    let model = match disk.root(&model_of(path)) {
        Ok(source) => Some(source),
        Err(Failure::Missing(_)) => None,
        Err(failure) => return Err(failure),
    };
    let Findings { faults, open } = check_specification(root, model, disk);
    Ok(Seen { faults, open, ..Seen::default() })
}

/// That a file of YAML is no specification.
pub fn unnamed(path: &Path) -> Failure {
    Failure::usage_with_help(
        format!("{} is no specification by its name", path.display()),
        "what a report shows is called MODEL.report.yaml, what is verified MODEL.verify.yaml, beside MODEL.asm",
    )
}
