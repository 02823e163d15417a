//! Loads a model from a path and shows its faults, as most commands do first.

use std::io::Read;
use std::path::Path;

use groundstate::Loaded;
use syntax::SourceFile;

use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::decode;
use crate::shell::Shell;

/// Loads a model, from standard input if the path is `-`. If it has errors, shows them and returns the exit code. Only
/// `check` shows warnings.
pub fn load(shell: &mut Shell, path: &Path) -> Result<Result<Loaded, Exit>, Failure> {
    match path.extension().and_then(|extension| extension.to_str()) {
        Some("avalla") => return Err(another(path, "scenario", "`groundstate test` runs scenarios")),
        Some("refine") => return Err(another(path, "coupling", "`groundstate refine` decides what it says")),
        Some("chart") => return Err(another(path, "chart", "`groundstate chart build` writes the model of a chart")),
        _ => {}
    }
    let mut disk = shell.disk();
    let root = if path == Path::new("-") { from_stdin(disk.limit)? } else { disk.root(path)? };
    match groundstate::load(root, &mut disk) {
        Ok(loaded) => Ok(Ok(loaded)),
        Err(faulty) => {
            shell.diagnostics(&faulty.sources, &faulty.diagnostics)?;
            if shell.talks() {
                shell.note(&format!("{} has faults and was not run", path.display()))?;
            }
            Ok(Err(Exit::Model))
        }
    }
}

/// Reads the model from standard input; its imports are looked up from the working folder.
fn from_stdin(limit: u64) -> Result<SourceFile, Failure> {
    let path = Path::new("<stdin>");
    let mut bytes = Vec::new();
    let read = std::io::stdin().lock().take(limit.saturating_add(1)).read_to_end(&mut bytes);
    read.map_err(|error| Failure::of_file("read", path, error))?;
    decode(path, bytes, limit)
}

/// The file is of another kind than the command takes.
pub fn another(path: &Path, kind: &str, help: &str) -> Failure {
    Failure::usage_with_help(format!("{} is a {kind}", path.display()), help)
}
