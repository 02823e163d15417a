//! States one after the other: the engine that goes through all that can be reached, level by level.
//!
//! [`search`] leads the workers of [`shard`]; [`traces`] tells shortest runs to what was found, by
//! [`ways`] or, where states were not kept, by [`ancestors`].

mod ancestors;
mod lineage;
pub(crate) mod search;
pub(crate) mod shard;
mod traces;
mod ways;

use crate::checkpoint::Unfit;
use crate::engine::{Ended, Engine, Task};
use crate::explicit::search::Search;
use crate::options::EngineKind;
use crate::plan::Plan;
use crate::report::NoStart;
use crate::storage::Storage;

/// See the module.
pub(crate) struct Explicit;

impl Engine for Explicit {
    fn run(&self, task: Task<'_, '_, '_>) -> Result<Ended, NoStart> {
        let Task { program, plan, keeper, heed, .. } = task;
        // LIMIT: a search that is kept has its states in memory.
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
            executed: search.executed,
            unbounded: search.unbounded,
            unknown: search.unknown,
            ..Ended::without_states(EngineKind::Explicit)
        };
        Ok(ended.judged(program, plan))
    }
}
