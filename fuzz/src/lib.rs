//! What the fuzz targets share: models to import, limits that keep one input short, an environment that answers.
//!
//! In: bytes. Out: texts, a loader over this project's own models, tight limits, inputs and choices. INVARIANT: nothing
//! here depends on anything but the bytes, so an input that fails once fails always.

use machine::{Choice, Environment, Limits, LocationRef, TimeUnit, Value};
use model::Loader;
use program::{DomainId, DomainKind, Program};
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

/// Answers by a small generator seeded from the text, so that the same text runs the same way.
#[derive(Debug)]
pub struct Seeded(pub u64);

impl Seeded {
    fn below(&mut self, bound: u64) -> u64 {
        // Steele, Lea, Flood: SplitMix64.
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        (z ^ (z >> 31)) % bound.max(1)
    }
}

impl Environment for Seeded {
    fn monitored(&mut self, program: &Program, _: LocationRef<'_>, codomain: DomainId) -> Result<Value, String> {
        Ok(match &program.domain(codomain).kind {
            DomainKind::Basic(model::Basic::Boolean) => Value::Boolean(self.below(2) == 0),
            DomainKind::Basic(model::Basic::Integer | model::Basic::Natural) => Value::Integer(self.below(10) as i64),
            DomainKind::Enum { literals } => Value::Enum(codomain, self.below(literals.len() as u64) as u32),
            _ => Value::Undef,
        })
    }

    fn choose(&mut self, _: &Program, choice: &Choice<'_>) -> Result<usize, String> {
        Ok(self.below(choice.candidates() as u64) as usize)
    }

    fn time(&mut self, _: TimeUnit) -> Result<i64, String> {
        Ok(self.below(1000) as i64)
    }
}
