//! `--engine`: which engine makes the steps.

use clap::ValueEnum;
use machine::EngineChoice;

/// An engine that makes steps. All make the same steps and report the same faults.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub enum Engine {
    /// The interpreter, then machine code once the run is long enough to pay for it
    #[default]
    Automatic,
    /// The interpreter alone
    Interpreted,
    /// Machine code from the first step on
    Compiled,
}

impl Engine {
    /// The machine's name for it.
    pub fn choice(self) -> EngineChoice {
        match self {
            Engine::Automatic => EngineChoice::Automatic,
            Engine::Interpreted => EngineChoice::Interpreted,
            Engine::Compiled => EngineChoice::Compiled,
        }
    }
}
