//! Models from a checkout: text files, wherever their imports lead.
//!
//! In: paths relative to the checkout's root. Out: [`SourceFile`]s under such paths. Bytes that are no UTF-8 are
//! replaced, as the peer does, so that an old comment in another encoding is no difference between the two.

use std::path::{Path, PathBuf};

use model::Loader;
use syntax::SourceFile;

use crate::Failure;

/// A checkout of models.
#[derive(Debug, Clone)]
pub struct Checkout {
    /// Its root folder.
    pub root: PathBuf,
}

impl Checkout {
    /// The file of that path.
    ///
    /// # Errors
    /// It cannot be read.
    pub fn source(&self, path: &str) -> Result<SourceFile, Failure> {
        let bytes = std::fs::read(self.root.join(path)).map_err(|error| format!("{path}: {error}"))?;
        Ok(SourceFile::new(path, String::from_utf8_lossy(&bytes).into_owned()))
    }
}

impl Loader for Checkout {
    fn load(&mut self, importer: &SourceFile, path: &str) -> Result<SourceFile, String> {
        let written = path.replace('\\', "/");
        let named = written.ends_with(".asm") || written.ends_with(".avalla");
        let written = if named { written } else { written + ".asm" };
        let folder = Path::new(&importer.name).parent().unwrap_or(Path::new(""));
        let found = tidy(&folder.join(&written));
        self.source(&found.display().to_string())
    }
}

/// `a/b/../c` as `a/c`, so that one file has one name however it is reached.
fn tidy(path: &Path) -> PathBuf {
    use std::path::Component;
    let mut tidied = PathBuf::new();
    for component in path.components() {
        match component {
            Component::CurDir => {}
            Component::ParentDir if matches!(tidied.components().next_back(), Some(Component::Normal(_))) => {
                tidied.pop();
            }
            other => tidied.push(other),
        }
    }
    tidied
}
