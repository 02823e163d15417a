//! The `--max-…` options: how much a model may use.

use std::sync::Once;

use clap::Args;

use crate::interrupt;

/// Limits; the defaults are those of [`machine::Limits`].
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Limits")]
pub struct Limits {
    /// Largest file that is read, in bytes; a program's recording may be 64 times as large
    #[arg(long, global = true, value_name = "BYTES", default_value_t = 16 << 20, hide_short_help = true)]
    pub max_file_size: u64,
    /// Rounds of while, whilerec and iterate in one step, in total
    #[arg(long, global = true, value_name = "N", default_value_t = machine::Limits::default().iterations, hide_short_help = true)]
    max_iterations: u64,
    /// Nested calls of rules and functions, at most 200000
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=200_000), default_value_t = machine::Limits::default().call_depth, hide_short_help = true)]
    max_depth: u64,
    /// Elements of one collection, enumeration or choice
    #[arg(long, global = true, value_name = "N", default_value_t = machine::Limits::default().collection, hide_short_help = true)]
    max_collection: u64,
    /// Updates in one step
    #[arg(long, global = true, value_name = "N", default_value_t = machine::Limits::default().updates, hide_short_help = true)]
    max_updates: u64,
    /// Locations that have a value, and elements made by extend
    #[arg(long, global = true, value_name = "N", default_value_t = machine::Limits::default().locations, hide_short_help = true)]
    max_locations: u64,
    /// Bindings of variables and calls in one step, in total
    #[arg(long, global = true, value_name = "N", default_value_t = machine::Limits::default().work, hide_short_help = true)]
    max_work: u64,
    /// Memory that the program may take while a model runs, in MiB
    #[arg(long, global = true, value_name = "MIB", default_value_t = 4096, hide_short_help = true)]
    max_heap: u64,
}

/// Reads a count of steps or the like.
///
/// # Errors
/// A sentence for the user.
pub fn count(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| "write a whole number, such as 100".to_string())
}

impl Limits {
    /// The largest size of a program's recording, in bytes.
    pub fn recording(&self) -> u64 {
        self.max_file_size.saturating_mul(64)
    }

    /// The machine's limits. They apply to every step from now on.
    pub fn machine(&self) -> machine::Limits {
        // A bound on memory that was set later stays.
        static FIRST: Once = Once::new();
        FIRST.call_once(|| interrupt::bound_memory(self.max_heap));
        machine::Limits {
            iterations: self.max_iterations,
            call_depth: self.max_depth,
            collection: self.max_collection,
            updates: self.max_updates,
            locations: self.max_locations,
            work: self.max_work,
            interrupt: interrupt::request().clone(),
        }
    }

    /// The same limits for steps that signals must not end, because a verdict depends on each of them.
    pub fn uninterrupted(&self) -> machine::Limits {
        machine::Limits { interrupt: machine::Interrupt::default(), ..self.machine() }
    }

    /// The option that raises a limit of the machine.
    pub fn option_for(limit: &str) -> Option<&'static str> {
        let options = [
            ("bindings", "--max-work"),
            ("memory", "--max-heap"),
            ("iterations", "--max-iterations"),
            ("calls", "--max-depth"),
            ("collection", "--max-collection"),
            ("updates", "--max-updates"),
            ("locations", "--max-locations"),
            ("elements", "--max-locations"),
        ];
        options.into_iter().find(|(word, _)| limit.contains(word)).map(|(_, option)| option)
    }
}
