//! What most commands begin with: a model from a path, its faults shown.

use std::path::Path;

use groundstate::Loaded;

use crate::exit::Exit;
use crate::failure::Failure;
use crate::shell::Shell;

/// Loads a model; where it has errors they are shown and there is none. Warnings are `check`'s business.
pub fn load(shell: &mut Shell, path: &Path) -> Result<Result<Loaded, Exit>, Failure> {
    let mut disk = shell.disk();
    let root = disk.root(path)?;
    match groundstate::load(root, &mut disk) {
        Ok(loaded) => Ok(Ok(loaded)),
        Err(faulty) => {
            shell.diagnostics(&faulty.sources, &faulty.diagnostics)?;
            if shell.talks() {
                shell.note(&format!("{} has faults; it was not run", path.display()))?;
            }
            Ok(Err(Exit::Model))
        }
    }
}
