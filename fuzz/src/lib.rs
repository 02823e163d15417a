//! What the fuzz targets share: a loader without files, and an environment that answers from the input's bytes.
//!
//! In: bytes of the fuzzer. Out: texts, inputs and choices made of them, the same for the same bytes.

use machine::{Choice, Environment, Limits, Location, TimeUnit, Value};
use program::{DomainId, DomainKind, Program};
use syntax::SourceFile;

/// Finds no file: built-in libraries alone can be imported.
pub struct NoFiles;

impl model::Loader for NoFiles {
    fn load(&mut self, _importer: &SourceFile, path: &str) -> Result<SourceFile, String> {
        Err(format!("no file {path}"))
    }
}

/// Limits that keep one input short.
pub fn limits() -> Limits {
    Limits { iterations: 200, call_depth: 60, collection: 2_000, updates: 2_000, locations: 20_000 }
}

/// Answers by a small generator seeded from the text, so that the same text runs the same way.
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
    fn monitored(&mut self, program: &Program, _: &Location, codomain: DomainId) -> Result<Value, String> {
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
