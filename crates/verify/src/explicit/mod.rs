//! The explicit engine: explores all reachable states one after another, level by level.
//!
//! [`search`] directs the workers of [`crew`], each with a [`shard`], whose states are packed [`anew`] where they turn out to take few values; [`traces`] makes shortest runs to the findings, by [`ways`], or by
//! [`ancestors`] if states were not stored.

mod ancestors;
mod anew;
mod crew;
pub(crate) mod edges;
mod lineage;
pub(crate) mod search;
pub(crate) mod shard;
mod tally;
mod traces;
mod ways;

use crate::checkpoint::Unfit;
use crate::engine::{Ended, Engine, Task};
use crate::explicit::search::Search;
use crate::options::EngineKind;
use crate::plan::Plan;
use crate::report::NoStart;
use crate::storage::Storage;

/// The explicit engine.
pub(crate) struct Explicit;

impl Engine for Explicit {
    fn run(&self, task: Task<'_, '_, '_>) -> Result<Ended, NoStart> {
        let Task { program, plan, keeper, heed, .. } = task;
        // LIMIT: a search with checkpoints keeps its states in memory.
        let spills = plan.storage == Storage::Exact && keeper.is_none();
        let symmetry = plan.symmetry && !plan.partial_order && keeper.is_none();
        let plan = &Plan { disk: plan.disk.clone().filter(|_| spills), symmetry, ..plan.clone() };
        let mut search = Search::run(program, plan, keeper, heed).map_err(|unfit| match unfit {
            Unfit::Refused(refusal) => NoStart::Refused(refusal),
            Unfit::Trouble(trouble) => NoStart::from(trouble),
        })?;
        let traces = search.traces(heed);
        let ended = Ended {
            found: search.found.iter().map(|found| found.target).zip(traces).collect(),
            stop: search.stop,
            omission: (plan.storage != Storage::Exact).then_some(search.omission),
            unreduced: search.unreduced,
            symmetry: search.symmetry.take(),
            progress: search.progress,
            width: search.width(),
            executed: std::mem::take(&mut search.executed),
            unbounded: std::mem::take(&mut search.unbounded),
            unknown: std::mem::take(&mut search.unknown),
            walk: search.walk(),
            ..Ended::without_states(EngineKind::Explicit)
        };
        Ok(ended.judged(program, plan))
    }
}
