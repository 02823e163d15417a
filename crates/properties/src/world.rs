//! The world in which properties are checked: models to import, limits that keep one input short, inputs and choices.

use machine::{Choice, Environment, Limits, LocationRef, TimeUnit, Value};
use model::Loader;
use program::{DomainId, DomainKind, Program};
use syntax::SourceFile;

use crate::mutation::SplitMix;

/// This project's models: file name without ending, text.
const MODELS: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/models.rs"));

/// LIMIT: longer inputs are cut; shorter ones find the same things sooner.
pub(crate) const MAX_BYTES: usize = 16 * 1024;

/// The input as text.
pub(crate) fn text(data: &[u8]) -> String {
    String::from_utf8_lossy(&data[..data.len().min(MAX_BYTES)]).into_owned()
}

/// Limits within which one input takes milliseconds.
pub(crate) fn limits() -> Limits {
    let limits = Limits { iterations: 300, call_depth: 200, collection: 3_000, ..Limits::default() };
    Limits { updates: 3_000, locations: 20_000, work: 100_000, ..limits }
}

/// The text as a file with the name that the text gives: under another name no model checks.
pub(crate) fn source(text: &str) -> SourceFile {
    let mut words = text
        .split(|letter: char| !letter.is_alphanumeric() && letter != '_')
        .skip_while(|word| !["asm", "asyncr", "module"].contains(word));
    let name = words.find(|word| !["", "asm", "asyncr", "module"].contains(word)).unwrap_or("Model");
    SourceFile::new(format!("{name}.asm"), text)
}

/// Finds this project's models by the end of the import's path, and the model under test as `Model.asm`.
#[derive(Debug, Default, Clone)]
pub(crate) struct Models {
    /// The model under test.
    pub(crate) root: String,
}

impl Loader for Models {
    fn load(&mut self, _importer: &SourceFile, path: &str) -> Result<SourceFile, String> {
        let name = path.rsplit(['/', '\\']).next().unwrap_or(path);
        let stem = name.trim_end_matches(".asm");
        if name == "Model.asm" {
            return Ok(source(&self.root));
        }
        let found = MODELS.iter().find(|(model, _)| *model == stem);
        found.map(|(model, text)| SourceFile::new(format!("{model}.asm"), *text)).ok_or_else(|| format!("no {path}"))
    }
}

/// Answers by a small generator seeded from the text, so the same text always runs the same way.
#[derive(Debug)]
pub(crate) struct Seeded(SplitMix);

impl Seeded {
    pub(crate) fn new(seed: u64) -> Seeded {
        Seeded(SplitMix::new(seed))
    }

    fn below(&mut self, bound: u64) -> u64 {
        self.0.below(bound)
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
