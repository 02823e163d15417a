//! What the fuzz targets share: models to import, and limits that keep one input short.
//!
//! In: bytes. Out: texts, a loader over this project's own models, tight limits. INVARIANT: nothing here depends on
//! anything but the bytes, so an input that fails once fails always.

use machine::Limits;
use model::Loader;
use syntax::SourceFile;

/// This project's models: file name without ending, text.
const MODELS: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/models.rs"));

/// LIMIT: longer inputs are cut; what they find, shorter ones find sooner.
pub const MAX_BYTES: usize = 16 * 1024;

/// Parts an input for a scenario: the model before it, the scenario after it.
pub const DIVIDER: &str = "\n%%%%\n";

/// The input as text.
pub fn text(data: &[u8]) -> String {
    String::from_utf8_lossy(&data[..data.len().min(MAX_BYTES)]).into_owned()
}

/// Limits within which one input takes milliseconds.
pub fn limits() -> Limits {
    Limits { iterations: 300, call_depth: 200, collection: 3_000, updates: 3_000, locations: 20_000, ..Limits::default() }
}

/// Finds this project's models by the end of the import's path, and the model under test as `Model.asm`.
#[derive(Debug, Default, Clone)]
pub struct Models {
    /// The model under test.
    pub root: String,
}

impl Loader for Models {
    fn load(&mut self, _importer: &SourceFile, path: &str) -> Result<SourceFile, String> {
        let name = path.rsplit(['/', '\\']).next().unwrap_or(path);
        let stem = name.trim_end_matches(".asm");
        if name == "Model.asm" {
            return Ok(SourceFile::new("Model.asm", self.root.as_str()));
        }
        let found = MODELS.iter().find(|(model, _)| *model == stem);
        found.map(|(model, text)| SourceFile::new(format!("{model}.asm"), *text)).ok_or_else(|| format!("no {path}"))
    }
}
