//! Reads `MODEL.verify.yaml`, or the file of `--spec`: what to verify in a model, and with which inputs.
//!
//! In: the file, if it exists. Out: a [`Verification`]. Options for inputs, `--terminal`, `--fair` and assumptions
//! override the file; properties are added to those of the model.

use std::path::{Path, PathBuf};

use groundstate::inputs::verification::{self, Verification};
use syntax::{SourceFile, Sources};

use crate::failure::Failure;
use crate::files::read_text;
use crate::shell::Shell;

/// The path of the file of a model or a chart.
pub fn path_of(model: &Path) -> PathBuf {
    model.with_extension("verify.yaml")
}

/// Reads the named file, or the one beside the model if it exists. If it has faults, shows them and returns `None`.
pub fn beside(
    shell: &mut Shell,
    sources: &mut Sources,
    named: Option<&Path>,
    model: &Path,
) -> Result<Option<Verification>, Failure> {
    let path = named.map_or_else(|| path_of(model), Path::to_path_buf);
    let text = match read_text(&path, shell.global.limits.max_file_size) {
        // A link to nowhere was meant to be something.
        Err(Failure::Missing(_)) if named.is_none() && !path.is_symlink() => return Ok(Some(Verification::default())),
        read => read?,
    };
    let file = sources.add(SourceFile::new(path.display().to_string(), text.as_str()));
    match verification::read(file, &text) {
        Ok(verification) => Ok(Some(verification)),
        Err(fault) => {
            shell.diagnostic(sources, &fault)?;
            Ok(None)
        }
    }
}
