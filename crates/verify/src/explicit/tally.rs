//! What workers report at the end of a round, and how the search continues.
//!
//! In: shards. Out: sums over them. It must not know who works on a shard.

use crate::progress::{Progress, Stop};

/// What a worker reports to the leader.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Tally {
    pub states: u64,
    pub transitions: u64,
    pub compiled: u64,
    pub blocked: u64,
    /// States of this level that still have to be expanded.
    pub left: u64,
    /// States of the next level.
    pub fresh: u64,
    /// States that may turn out not to be new on the next level.
    pub pending: u64,
    pub bytes: u64,
    /// Bytes of files.
    pub spilled: u64,
    pub full: bool,
    /// A file could not be read or written.
    pub lost: bool,
    /// A state did not fit, so the search starts again.
    pub narrow: bool,
    pub found: bool,
    /// The number of findings at distances that were explored completely.
    pub certain: usize,
    /// Some of the round was left undone because the caller asked to stop.
    pub cut: bool,
    /// The worker has panicked.
    pub broken: bool,
}

impl Tally {
    /// The progress of a search, from its workers' reports.
    pub fn progress(reports: &[Tally], depth: u64) -> Progress {
        let sum = |of: fn(&Tally) -> u64| reports.iter().map(of).sum::<u64>();
        let fresh = sum(|report| report.fresh);
        Progress {
            states: sum(|report| report.states),
            transitions: sum(|report| report.transitions),
            queue: sum(|report| report.left + report.pending) + fresh,
            depth: if fresh > 0 { depth } else { depth.saturating_sub(1) },
            bytes: sum(|report| report.bytes),
            spilled: sum(|report| report.spilled),
            compiled: sum(|report| report.compiled),
            blocked: sum(|report| report.blocked),
        }
    }
}

/// How to continue.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Decision {
    /// Continue the level.
    Round,
    /// The level has ended: settle pending states.
    Settle,
    /// Begin the next level.
    Level,
    /// Stop all workers.
    Stop(Option<Stop>),
}

/// Decides how to continue, from the reports of all workers and the depth of the incoming states.
pub(crate) type Leader<'a> = dyn FnMut(&[Tally], u64) -> Decision + 'a;
