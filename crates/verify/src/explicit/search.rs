//! The explicit search: all reachable states, level by level.
//!
//! In: a program and the targets. Out: a [`Search`] that has ended, with the states by distance and the first state for
//! each target. Each worker ([`crate::explicit::crew`]) owns the states that hash to it. A level is completed before
//! the next begins, so a finding is at the least distance, and of several states the least in canonical order.
//! INVARIANT: the result is the same for any number of workers.

use explore::checkpoint::Keeper;
use std::collections::BTreeSet;
use std::sync::Arc;

use explore::{Explorer, Orbits, Rooms, Unbounded, Widening};
use machine::Cause;
use program::Program;
use syntax::Span;

use crate::again::made_again;
use crate::checkpoint::{Resumed, Unfit, keep, made, resume};
use crate::explicit::anew::packed_anew;
use crate::explicit::crew::Crew;
use crate::explicit::edges::{Edges, OWNERS};
use crate::explicit::shard::{Shard, note};
use crate::explicit::tally::{Decision, Tally};
use crate::explicit::ways::ways;
use crate::explorers::{Initial, Maker, representatives};
use crate::heed::Heed;
use crate::partial_order::{Reduction, Unreduced, reduction};
use crate::plan::Plan;
use crate::progress::{Progress, Stop};
use crate::storage::{Storage, Store};
use crate::symmetry::{Distinct, Interchange, Symmetry};
use crate::table::Table;
use crate::target::Found;
use crate::trace::tell;
use crate::walk::{Walk, WalkedGraph};

/// A search that has ended.
#[derive(Debug)]
pub struct Search {
    pub(crate) explorer: Explorer,
    pub(crate) maker: Maker,
    pub(crate) plan: Plan,
    pub(crate) shards: Vec<Shard>,
    /// The findings, at most one per target.
    pub found: Vec<Found>,
    /// Why it ended early; `None` if all states were explored.
    pub stop: Option<Stop>,
    /// How far it came.
    pub progress: Progress,
    /// What could not be enumerated.
    pub unbounded: BTreeSet<Unbounded>,
    /// Conditions whose truth is unknown in some state.
    pub unknown: BTreeSet<usize>,
    /// For each rule, whether a machine ran it.
    pub executed: Vec<bool>,
    /// The expected number of states that were mistaken for others and omitted.
    pub omission: f64,
    /// The partial-order reduction, if it was used.
    pub(crate) reduction: Option<Arc<Reduction>>,
    /// Why partial-order reduction was not possible, if it was requested.
    pub unreduced: Option<Unreduced>,
    /// The interchangeable elements, if symmetry reduction was requested.
    pub symmetry: Option<Symmetry>,
    pub(crate) orbits: Option<Arc<Orbits>>,
}

impl Search {
    /// Explores all states of a program. With a keeper, continues from its checkpoint, and writes one when a limit ends
    /// the search.
    ///
    /// # Errors
    /// There is no initial state, or the checkpoint does not fit.
    pub(crate) fn run(
        program: &Arc<Program>,
        plan: &Plan,
        mut keeper: Option<&mut dyn Keeper>,
        heed: &mut Heed<'_>,
    ) -> Result<Search, Unfit> {
        let mut resumed = match &mut keeper {
            Some(keeper) => resume(*keeper, program, plan)?,
            None => None,
        };
        let mut widening = Widening::default();
        let mut plan = plan.clone();
        let mut symmetry = plan.symmetry.then(|| Interchange::new(program, &plan));
        let (mut growth, mut anew) = (Growth::default(), None);
        loop {
            plan.settings.unordered = symmetry.as_ref().map(|found| Arc::clone(&found.unordered)).unwrap_or_default();
            let Begun { maker, mut explorer, mut shards, unreduced, starts } = match (anew.take(), resumed.take()) {
                (Some(begun), _) => begun,
                (None, Some(Resumed { widening: before, maker, explorer, shards, unreduced })) => {
                    widening = before;
                    Begun { maker, explorer, shards, unreduced, starts: Initial::NONE }
                }
                (None, None) => begun(program, &plan, keeper.is_some(), &mut widening, &mut symmetry)?,
            };
            if let Some(found) = &symmetry
                && found.unordered.is_empty() != plan.settings.unordered.is_empty()
            {
                // No elements are interchangeable after all, so quantifiers need not look at all elements.
                continue;
            }
            let kept = keeper.as_mut().map(|keeper| (&mut **keeper, &widening));
            let counts = !growth.has_begun && kept.is_none() && may_be_shorter(&explorer, &shards);
            let (stop, progress, mut rooms) =
                search(&maker, &mut explorer, &mut shards, starts, &plan, (kept, counts), heed);
            growth.has_begun |= rooms.is_some();
            if let Some(narrow) = outgrown(&shards) {
                rooms = Some(explorer.more_room(&narrow, growth.hurries_at(progress.states)));
            }
            if let Some(rooms) = rooms {
                widening.settle(rooms);
                anew = Begun { maker, explorer, shards, unreduced, starts: Initial::NONE }.anew(&plan, &widening);
                continue;
            }
            if let Some(span) = ordered(&shards)
                && let Some(found) = symmetry.as_mut().filter(|found| !found.unordered.is_empty())
            {
                found.refuse(Distinct::Ordered(span));
                continue;
            }
            match shards.iter().find(|shard| !shard.widening.is_empty()) {
                Some(shard) => widening.merge(&shard.widening),
                None => {
                    let symmetry = symmetry.map(|found| found.symmetry);
                    let search = Search::gather(maker, explorer, &plan, shards, stop, progress);
                    return Ok(Search { unreduced, symmetry, ..search });
                }
            }
        }
    }

    fn gather(
        maker: Maker,
        mut explorer: Explorer,
        plan: &Plan,
        mut shards: Vec<Shard>,
        stop: Option<Stop>,
        progress: Progress,
    ) -> Search {
        let mut found: Vec<Found> = Vec::new();
        for one in shards.iter_mut().flat_map(|shard| std::mem::take(&mut shard.found)) {
            note(&mut found, one, &mut explorer);
        }
        found.sort_by_key(|found| found.target);
        let unbounded = shards.iter().flat_map(|shard| &shard.unbounded).copied().collect();
        let unknown = shards.iter().flat_map(|shard| &shard.unknown).copied().collect();
        let rules = maker.program.rules.len();
        let ran = |rule: usize| shards.iter().any(|shard| shard.executed[rule] > 0);
        let executed = (0..rules).map(ran).collect();
        let omission = shards.iter().map(|shard| shard.store.omission()).sum();
        let (plan, reduction, orbits) = (plan.clone(), shards[0].reduction.clone(), shards[0].orbits.clone());
        Search {
            explorer,
            maker,
            plan,
            shards,
            found,
            stop,
            progress,
            unbounded,
            unknown,
            executed,
            omission,
            reduction,
            unreduced: None,
            symmetry: None,
            orbits,
        }
    }

    /// What it has walked, if that was kept.
    pub(crate) fn walk(self) -> Option<Walk> {
        let Search { maker, explorer, stop, shards, .. } = self;
        if stop.is_some() && shards.len() > 1 {
            return None;
        }
        let shards: Option<Vec<(&Table, &Edges)>> = shards
            .iter()
            .map(|shard| match (&shard.store, &shard.edges) {
                (Store::Exact(table), Some(edges)) => Some((table, edges)),
                _ => None,
            })
            .collect();
        let graph = WalkedGraph::of(explorer.words(), &shards?);
        Some(Walk { maker, explorer, stop, graph })
    }

    /// How many words a state has, and how many bits of them are used.
    pub fn width(&self) -> (usize, usize) {
        (self.explorer.words(), self.explorer.bits())
    }
}

/// The parts of a search.
struct Begun {
    maker: Maker,
    explorer: Explorer,
    shards: Vec<Shard>,
    unreduced: Option<Unreduced>,
    /// The states that it begins with.
    starts: Initial,
}

/// A search at its beginning, with its initial states.
fn begun(
    program: &Arc<Program>,
    plan: &Plan,
    is_kept: bool,
    widening: &mut Widening,
    symmetry: &mut Option<Interchange>,
) -> Result<Begun, Unfit> {
    let (mut maker, mut explorer) = made(program, plan, widening)?;
    if is_kept {
        // A checkpoint needs complete results: each state with its conditions.
        maker = maker.tireless();
        explorer.ignore_interrupts();
    }
    let orbits = symmetry.as_mut().and_then(|found| found.orbits(program, &explorer));
    let count = plan.workers.max(1);
    let (reduction, unreduced) = reduction(program, plan, &mut explorer);
    let store = || match &plan.disk {
        Some(disk) => Store::with_disk(explorer.words(), disk, plan.max_bytes / count as u64),
        None => Store::new(explorer.words(), plan.storage, plan.seed, count),
    };
    let mut shards: Vec<Shard> = (0..count).map(|_| Shard::new(store(), &reduction)).collect();
    shards.iter_mut().for_each(|shard| shard.orbits.clone_from(&orbits));
    let whole = plan.storage == Storage::Exact && plan.disk.is_none() && reduction.is_none() && orbits.is_none();
    // LIMIT: a state of one word has no index in its table, and a checkpoint keeps no edges.
    if plan.edges && whole && !is_kept && explorer.words() > 1 && count <= OWNERS {
        shards.iter_mut().for_each(|shard| shard.edges = Some(Edges::default()));
    }
    let starts = representatives(&mut explorer, orbits.as_deref());
    Ok(Begun { maker, explorer, shards, unreduced, starts })
}

/// Where the order of elements was found to matter, or what could not be enumerated; perhaps only because a quantifier
/// looked at more elements than it must.
fn ordered(shards: &[Shard]) -> Option<Span> {
    let unbounded = shards.iter().flat_map(|shard| &shard.unbounded).map(|unbounded| unbounded.span);
    shards.iter().find_map(|shard| shard.order_mattered).or(unbounded.min())
}

/// LIMIT: when states take so many bytes, it is counted how many values their locations have. To pack them anew costs what
/// explorers have learned, which is soon learned again compared with what a search of that size takes.
const CENSUS: u64 = 1 << 26;
/// LIMIT: states of fewer words are short enough.
const LONG: usize = 3;

/// How the room of locations that take few values has grown.
#[derive(Debug, Default)]
struct Growth {
    /// A census has given them room.
    has_begun: bool,
    /// How many states there were when it last did not suffice.
    states: u64,
    /// How often that was before there were twice as many as the last time.
    hurries: u8,
}

impl Growth {
    /// How many hurries there were, now that room does not suffice at so many states.
    fn hurries_at(&mut self, states: u64) -> u8 {
        self.hurries += u8::from(states < 2 * self.states);
        self.states = self.states.max(states);
        self.hurries
    }
}

/// Whether a census can tell how states become shorter: it needs them all, as they are.
fn may_be_shorter(explorer: &Explorer, shards: &[Shard]) -> bool {
    let as_they_are =
        |shard: &Shard| matches!(shard.store, Store::Exact(_)) && shard.orbits.is_none() && shard.reduction.is_none();
    explorer.words() >= LONG && shards.iter().all(as_they_are)
}

/// The room that the locations of these states need, if states become much shorter with it.
fn shorter(explorer: &mut Explorer, shards: &[Shard]) -> Option<Rooms> {
    let words = explorer.words();
    let tables = shards.iter().filter_map(|shard| match &shard.store {
        Store::Exact(table) => Some(table),
        Store::Spilled(_) | Store::Compact(_) => None,
    });
    explorer.census(tables.flat_map(Table::chunks).flat_map(|chunk| chunk.chunks_exact(words)))
}

/// What did not fit, if that is values of locations that had room for few, and the search can go on with more of it.
fn outgrown(shards: &[Shard]) -> Option<Vec<&Widening>> {
    let narrow = shards.iter().filter(|shard| !shard.widening.is_empty());
    let narrow: Option<Vec<_>> = narrow.map(|shard| shard.is_retried.then_some(&shard.widening)).collect();
    narrow.filter(|narrow| !narrow.is_empty())
}

impl Begun {
    /// The same with states that have as much room as this gives them; none where the search has to begin again for that.
    fn anew(self, plan: &Plan, widening: &Widening) -> Option<Begun> {
        let maker = self.maker.with_room(widening);
        let mut tireless = maker.clone().tireless();
        let mut explorer = tireless.first().ok()?;
        explorer.mind_interrupts(plan.settings.interrupt.clone());
        let mut shards = packed_anew(&self.explorer, &mut explorer, self.shards).ok()?;
        for shard in &mut shards {
            (shard.widening, shard.is_retried) = (Widening::default(), false);
        }
        let maker = maker.beginning_with(&explorer);
        Some(Begun { maker, explorer, shards, ..self })
    }
}

/// Searches until all states are explored or something ends it, with pauses for checkpoints, and one for a census if it `counts`:
/// then it is to go on with this room.
fn search<'k>(
    maker: &Maker,
    explorer: &mut Explorer,
    shards: &mut [Shard],
    mut starts: Initial,
    plan: &Plan,
    (mut kept, mut counts): (Option<(&mut (dyn Keeper + 'k), &Widening)>, bool),
    heed: &mut Heed<'_>,
) -> (Option<Stop>, Progress, Option<Rooms>) {
    let mut progress = Progress::default();
    let crew = Crew { plan, explore: &|| maker.explorer() };
    let words = explorer.words();
    // Before memory ends the search.
    let census = plan.census.unwrap_or(CENSUS.min(plan.max_bytes / 2));
    // LIMIT: with lossy storage or symmetry reduction, findings are reported at the end.
    let tells = plan.storage == Storage::Exact && shards[0].orbits.is_none();
    let mut heard = 0;
    loop {
        let (mut paused, mut news, mut counted) = (false, 0, false);
        let mut decide = |reports: &[Tally], depth: u64| {
            let decision = decide(reports, depth, plan, &mut progress, &mut |progress| heed.at(progress));
            let goes_on = !matches!(decision, Decision::Stop(_));
            let certain: usize = reports.iter().map(|report| report.certain).sum();
            if goes_on && tells && certain > heard && heed.listener.wants() {
                news = certain;
            }
            paused = goes_on && kept.as_mut().is_some_and(|(keeper, _)| keeper.is_due());
            counted = goes_on && counts && reports.iter().map(|report| report.bytes).sum::<u64>() >= census;
            if paused || counted || news > 0 { Decision::Stop(None) } else { decision }
        };
        let stop = crew.work(explorer, shards, &starts, words, &mut decide);
        starts = Initial::NONE;
        if counted {
            counts = false;
            match shorter(explorer, shards) {
                Some(rooms) => return (stop, progress, Some(rooms)),
                None => continue,
            }
        }
        if news > 0 {
            heard = news;
            tell_news(maker, plan, explorer, shards, heed);
            if !paused {
                continue;
            }
        }
        let Some((keeper, widening)) = &mut kept else { return (stop, progress, None) };
        if shards.iter().any(|shard| !shard.widening.is_empty() || shard.store.is_full()) {
            return (stop, progress, None);
        }
        if paused || stop.is_some() {
            keep(*keeper, &maker.program, plan, explorer, (widening, &maker.interner), shards);
        } else {
            keeper.remove();
        }
        if !paused {
            return (stop, progress, None);
        }
    }
}

/// Reports findings at distances that were explored completely, if the machine confirms the run.
fn tell_news(maker: &Maker, plan: &Plan, explorer: &mut Explorer, shards: &mut [Shard], heed: &mut Heed<'_>) {
    let mut found = Vec::new();
    for one in shards.iter().flat_map(Shard::certain) {
        note(&mut found, one.clone(), explorer);
    }
    found.retain(|one| heed.is_news(one));
    found.sort_by_key(|one| one.target);
    let interrupt = explorer.ignore_interrupts();
    // Runs are missing only if files cannot be read, which ends the search.
    let ways = ways(explorer, shards, None, &found).unwrap_or_default();
    for (one, way) in found.iter().zip(&ways) {
        let trace = tell(explorer, way, one);
        if made_again(&maker.program, &plan.settings, &trace, Some(one.target)) {
            heed.tell(one, trace);
        }
    }
    explorer.mind_interrupts(interrupt);
}

fn decide(
    reports: &[Tally],
    depth: u64,
    plan: &Plan,
    progress: &mut Progress,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Decision {
    let sum = |of: fn(&Tally) -> u64| reports.iter().map(of).sum::<u64>();
    let any = |of: fn(&Tally) -> bool| reports.iter().any(of);
    let (left, fresh, pending) = (sum(|report| report.left), sum(|report| report.fresh), sum(|report| report.pending));
    *progress = Tally::progress(reports, depth);
    let go_on = watch(progress);
    if any(|report| report.narrow || report.broken) {
        return Decision::Stop(None);
    }
    if any(|report| report.lost) {
        return Decision::Stop(Some(Stop::Disk));
    }
    // The cause that cut a round short may be gone, such as a lack of memory, but the round is still incomplete.
    let cut = any(|report| report.cut).then(|| plan.settings.interrupt.cause().unwrap_or(Cause::Memory));
    if let Some(cause) = cut {
        return Decision::Stop(Some(cause.into()));
    }
    // What a store had no room for is in none of these counts.
    if any(|report| report.full) {
        return Decision::Stop(Some(Stop::Memory));
    }
    if left + fresh + pending == 0 {
        return Decision::Stop(None);
    }
    // With a disk, storage observes its own limit.
    if progress.bytes > plan.max_bytes && plan.disk.is_none() {
        return Decision::Stop(Some(Stop::Memory));
    }
    if let Some(cause) = plan.settings.interrupt.cause() {
        return Decision::Stop(Some(cause.into()));
    }
    if !go_on {
        return Decision::Stop(Some(Stop::Asked));
    }
    if progress.states >= plan.max_states {
        return Decision::Stop(Some(Stop::States));
    }
    // Other limits are checked between levels, where they do not depend on how the work is shared.
    if left > 0 {
        return Decision::Round;
    }
    if pending > 0 {
        return Decision::Settle;
    }
    if plan.first && any(|report| report.found) {
        return Decision::Stop(Some(Stop::Found));
    }
    if depth >= plan.max_depth {
        return Decision::Stop(Some(Stop::Depth));
    }
    Decision::Level
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A state that there was no room for is neither left nor fresh: the search is not complete without it.
    #[test]
    fn a_search_with_a_full_store_is_not_complete() {
        let decided = |full: bool| {
            let reports = [Tally::default(), Tally { states: 7, full, ..Tally::default() }];
            decide(&reports, 3, &Plan::default(), &mut Progress::default(), &mut |_| true)
        };
        assert_eq!(decided(false), Decision::Stop(None));
        assert_eq!(decided(true), Decision::Stop(Some(Stop::Memory)));
    }
}
