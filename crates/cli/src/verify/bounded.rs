//! The options that bound a search: how far it goes, and with which inputs.

use clap::Args;
use groundstate::verify::Options;
use program::Program;

use crate::failure::Failure;
use crate::interrupt;
use crate::shell::Shell;
use crate::verify::bound;
use crate::verify::watch::Watch;

/// See the module.
#[derive(Debug, Clone, Args)]
pub struct Bounded {
    /// The values that an input is tried with, as NAME=LOW..HIGH or NAME=VALUE,VALUE; may be repeated
    #[arg(long = "bound", value_name = "BOUND")]
    pub bounds: Vec<String>,
    /// The most states
    #[arg(long, value_name = "N", value_parser = crate::limits::count)]
    pub max_states: Option<u64>,
    /// The most steps from an initial state
    #[arg(long, value_name = "N", value_parser = crate::limits::count)]
    pub depth: Option<u64>,
    /// The most memory for states, in MiB
    #[arg(long, value_name = "MIB", default_value_t = 8192)]
    pub max_memory: u64,
    /// The most time, in seconds
    #[arg(long, value_name = "SECONDS", value_parser = crate::limits::count)]
    pub time: Option<u64>,
}

impl Bounded {
    /// The options of a search, and who watches it.
    pub fn options(&self, shell: &Shell, program: &Program) -> Result<(Options, Watch), Failure> {
        let options = Options {
            limits: shell.global.limits.machine(),
            max_states: self.max_states.unwrap_or(u64::MAX),
            max_depth: self.depth.unwrap_or(u64::MAX),
            max_bytes: self.max_memory.saturating_mul(1 << 20),
            bounds: bound::read(program, &self.bounds)?,
            ..Options::default()
        };
        interrupt::listen();
        Ok((options, Watch::new(self.time, shell.global.quiet || shell.json())))
    }
}
