//! How many deadlines a task may miss among successive cycles, bounded without a search.
//!
//! In: a system, and what is known of its tasks' responses. Out: for each task that may miss some deadlines, the most that it misses in any
//! window of its cycles: G. Bernat, A. Burns, A. Llamosi, *Weakly Hard Real-Time Systems* (2001). On one processor, each cycle of a
//! repetition ends at the latest as if the processor had begun, at some instant, to be busy with nothing but this task and more urgent
//! ones, whose cycles take as long as they may and are released, within their jitter, so that they are in the way. Without jitter that is
//! when it ends; with it, several cycles may not all be that late in one run. INVARIANT: no run misses more than is given.

use super::{Analysis, Verdict, executed, is_apart};
use crate::system::{ChannelKind, Timing, Tolerance};

/// What is known of the deadlines that a task misses.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Missed {
    /// The most of any successive cycles of the stated number; none if nothing is known.
    pub most: Option<u64>,
    /// Some run misses that many.
    pub certain: bool,
    /// Why nothing is known.
    pub reason: Option<String>,
}

/// LIMIT: ends that are computed before the search is given up.
const WORK: u64 = 5_000_000;

/// The cycles of a task: the first one, the next ones, how much later each may be released, and how long it takes.
#[derive(Debug, Clone, Copy)]
struct Lane {
    first: i64,
    period: i64,
    jitter: i64,
    execution: i64,
}

/// The most misses of a component that may miss some.
pub(super) fn missed(analysis: &Analysis<'_>, index: usize, tolerance: &Tolerance, verdict: &Verdict) -> Missed {
    let known = |most, certain| Missed { most: Some(most), certain, reason: None };
    let open = |reason: &str| Missed { most: None, certain: false, reason: Some(reason.to_string()) };
    let (system, platform) = (analysis.system, analysis.platform);
    let component = &system.components[index];
    let Timing::Synchronous { deadline, .. } = component.timing else { return open("it has no deadline") };
    let execution = executed(system, index).1;
    if *verdict == Verdict::Meets {
        return known(0, true);
    }
    if execution + component.timing.jitter() > deadline {
        // It leaves out accesses at locks where it can.
        let uses = |kind: ChannelKind| matches!(kind, ChannelKind::Buffer { .. } | ChannelKind::Queue { .. });
        let waits = system.channels.iter().any(|one| (one.from == index || one.to == index) && uses(one.kind));
        return known(tolerance.cycles, !waits);
    }
    let Ok(blocking) = analysis.blocking[index] else {
        return open("how long others keep it waiting is not known");
    };
    if is_apart(system, platform) {
        return open("it gives up an access rather than its deadline where it waits for long");
    }
    if platform.processors > 1 {
        return open("missed deadlines are not counted on several processors that tasks share");
    }
    let place = analysis.urgency.iter().position(|other| *other == index).unwrap_or(0);
    let rest = u64::from(component.phases.len() == 1);
    let mut lanes = Vec::new();
    for (at, other) in analysis.urgency[..=place].iter().enumerate() {
        let Timing::Synchronous { period, offset, .. } = system.components[*other].timing else {
            return open("more urgent tasks start at any time");
        };
        // A task of a single phase rests for a tick before its next cycle.
        let own = executed(system, *other).1 + if at == place { blocking + rest } else { 0 };
        let jitter = system.components[*other].timing.jitter();
        let [Ok(first), Ok(period), Ok(jitter), Ok(execution)] = [offset, period, jitter, own].map(i64::try_from)
        else {
            return open("its times are too long");
        };
        lanes.push(Lane { first, period, jitter, execution });
    }
    let is_exact = blocking + rest == 0 && lanes.iter().all(|lane| lane.jitter == 0);
    match most(&lanes, deadline, tolerance.cycles) {
        Some(most) => known(most, is_exact),
        None => open("the cycles do not repeat within the ticks that are looked at"),
    }
}

/// The most late cycles of the last lane, in any window of so many of its cycles; the most urgent lane comes first. None if that takes too
/// long to say.
fn most(lanes: &[Lane], deadline: u64, cycles: u64) -> Option<u64> {
    let load: f64 = lanes.iter().map(|lane| lane.execution as f64 / lane.period as f64).sum();
    if load > 1.0 + 1e-9 {
        // More and more is left, until every cycle is late.
        return Some(cycles);
    }
    let late = Ends { lanes, deadline: i64::try_from(deadline).ok()?, work: WORK }.late()?;
    let (every, window) = (late.len(), usize::try_from(cycles).ok()?);
    let total = late.iter().filter(|late| **late).count();
    // Whole repetitions, and the part of one with the most.
    let (whole, part) = (window / every, window % every);
    let mut within = late[..part].iter().filter(|late| **late).count();
    let mut most = within;
    for first in 0..every {
        within += usize::from(late[(first + part) % every]);
        within -= usize::from(late[first]);
        most = most.max(within);
    }
    u64::try_from(whole * total + most).ok()
}

/// When cycles end at the latest.
struct Ends<'l> {
    lanes: &'l [Lane],
    deadline: i64,
    work: u64,
}

impl Ends<'_> {
    /// Which cycles of the last lane may be late, for all of a repetition.
    fn late(mut self) -> Option<Vec<bool>> {
        let own = *self.lanes.last()?;
        let every =
            self.lanes.iter().try_fold(1_i64, |all, lane| (all / gcd(all, lane.period)).checked_mul(lane.period))?;
        let cycles = every / own.period;
        // Without jitter a processor that has no time left over is done at the end of a repetition; with it, maybe never.
        let Some(busy) = self.busy(every.checked_mul(2)?) else { return Some(vec![true]) };
        (0..cycles).map(|cycle| self.is_late(own.first.checked_add(cycle.checked_mul(own.period)?)?, busy)).collect()
    }

    /// The longest time for which the processor has nothing to do but these tasks.
    fn busy(&mut self, limit: i64) -> Option<i64> {
        let mut busy = 1;
        loop {
            let jobs = |lane: &Lane| ceiling(busy + lane.jitter, lane.period) * lane.execution;
            let next: i64 = self.lanes.iter().map(jobs).sum();
            if next == busy || next > limit {
                return (next == busy).then_some(busy);
            }
            busy = next;
        }
    }

    /// Whether the cycle that should be released at this instant may end after its deadline.
    fn is_late(&mut self, due: i64, busy: i64) -> Option<bool> {
        let own = *self.lanes.last()?;
        let last = due.checked_add(own.jitter)?;
        for lane in self.lanes {
            // It was busy since a cycle was released as late as may be: a later instant would leave that one out.
            let mut since =
                lane.first + ceiling(due - busy - lane.jitter - lane.first, lane.period) * lane.period + lane.jitter;
            while since <= last {
                if self.ends_late(since, due)? {
                    return Some(true);
                }
                since += lane.period;
            }
        }
        Some(false)
    }

    /// Whether it may end late where the processor is busy since an instant.
    fn ends_late(&mut self, since: i64, due: i64) -> Option<bool> {
        let (own, urgent) = self.lanes.split_last()?;
        // Of each lane, the cycles that may be released from then on.
        let first = |lane: &Lane| ceiling(since - lane.jitter - lane.first, lane.period);
        let before = (due - own.first) / own.period - first(own) + 1;
        let mut end = since + before * own.execution;
        loop {
            self.work = self.work.checked_sub(1)?;
            let released = |lane: &Lane| (ceiling(end - lane.first, lane.period) - first(lane)).max(0);
            let next =
                since + before * own.execution + urgent.iter().map(|lane| released(lane) * lane.execution).sum::<i64>();
            if next - due > self.deadline || next == end {
                return Some(next - due > self.deadline);
            }
            end = next;
        }
    }
}

/// The least number of wholes that is no less than the quotient.
fn ceiling(a: i64, b: i64) -> i64 {
    -(-a).div_euclid(b)
}

fn gcd(a: i64, b: i64) -> i64 {
    if b == 0 { a } else { gcd(b, a % b) }
}

#[cfg(test)]
mod tests {
    use std::collections::VecDeque;

    use testkit::Random;

    use super::*;

    /// Tasks as period, offset, execution, the most urgent first; the last one is judged.
    fn most(tasks: &[(u64, u64, u64)], deadline: u64, cycles: u64) -> Option<u64> {
        most_late(&tasks.iter().map(|task| (*task, 0)).collect::<Vec<_>>(), deadline, cycles)
    }

    /// The same with the jitter of each task.
    fn most_late(tasks: &[((u64, u64, u64), u64)], deadline: u64, cycles: u64) -> Option<u64> {
        let lane = |&((period, first, execution), jitter): &((u64, u64, u64), u64)| {
            let [first, period, jitter, execution] = [first, period, jitter, execution].map(|one| one as i64);
            Lane { first, period, jitter, execution }
        };
        super::most(&tasks.iter().map(lane).collect::<Vec<_>>(), deadline, cycles)
    }

    #[test]
    fn cycles_laid_out() {
        // Released with the more urgent one in each second cycle only.
        assert_eq!(most(&[(20, 0, 6), (10, 0, 5)], 10, 4), Some(2));
        assert_eq!(most(&[(20, 0, 6), (10, 0, 5)], 11, 4), Some(0));
        assert_eq!(most(&[(20, 0, 6), (10, 0, 5)], 10, 3), Some(2));
        assert_eq!(most(&[(20, 0, 6), (10, 0, 4)], 10, 2), Some(0));
        // An offset keeps them apart.
        assert_eq!(most(&[(20, 4, 6), (20, 10, 5)], 5, 3), Some(0));
        assert_eq!(most(&[(20, 6, 6), (20, 10, 5)], 5, 3), Some(3));
        // More than there is time for.
        assert_eq!(most(&[(10, 0, 6), (20, 0, 9)], 20, 7), Some(7));
        // A cycle that is late lets the next one begin late.
        assert_eq!(most(&[(40, 0, 8), (10, 0, 8)], 10, 4), Some(3));
        assert_eq!(most(&[(50, 0, 8), (10, 0, 8)], 10, 5), Some(3));
    }

    /// Tick by tick, over a long time. `delay` says how much later than it should a cycle of a task is released.
    fn ticked(tasks: &[(u64, u64, u64)], deadline: u64, cycles: usize, mut delay: impl FnMut(usize) -> u64) -> u64 {
        let last = tasks.len() - 1;
        let mut open: Vec<VecDeque<(u64, u64, u64)>> = vec![VecDeque::new(); tasks.len()];
        let mut late = Vec::new();
        for now in 0..20_000 {
            for (at, (period, offset, execution)) in tasks.iter().enumerate() {
                if now >= *offset && (now - offset) % period == 0 {
                    open[at].push_back((now, now + delay(at), *execution));
                }
            }
            let ready = |jobs: &VecDeque<(u64, u64, u64)>| jobs.front().is_some_and(|(_, ready, _)| *ready <= now);
            let Some(at) = open.iter().position(ready) else { continue };
            let job = &mut open[at][0];
            job.2 -= 1;
            if job.2 == 0 {
                let (due, ..) = open[at].pop_front().expect("it is there");
                if at == last {
                    late.push(now + 1 - due > deadline);
                }
            }
        }
        let count = |window: &[bool]| window.iter().filter(|late| **late).count() as u64;
        late.windows(cycles).map(count).max().unwrap_or(0)
    }

    #[test]
    fn jitter_lets_cycles_be_late() {
        // Alone: late if it is released too late.
        assert_eq!(most_late(&[((10, 0, 4), 3)], 7, 5), Some(0));
        assert_eq!(most_late(&[((10, 0, 4), 4)], 7, 5), Some(5));
        // The more urgent one, which has an offset, may come late into every second cycle only.
        assert_eq!(most_late(&[((20, 6, 3), 0), ((10, 0, 6), 0)], 8, 4), Some(0));
        assert_eq!(most_late(&[((20, 6, 3), 3), ((10, 0, 6), 0)], 8, 4), Some(0));
        assert_eq!(most_late(&[((20, 6, 3), 4), ((10, 0, 6), 0)], 8, 4), Some(2));
        assert_eq!(most_late(&[((20, 4, 3), 0), ((10, 0, 6), 0)], 8, 4), Some(2));
        assert_eq!(most_late(&[((20, 18, 3), 4), ((10, 0, 6), 0)], 8, 4), Some(2));
        assert_eq!(most_late(&[((20, 18, 3), 1), ((10, 0, 6), 0)], 8, 4), Some(0));
        // No time is left over, and releases come late: nothing is sure.
        assert_eq!(most_late(&[((4, 0, 2), 1), ((8, 0, 4), 0)], 8, 3), Some(3));
    }

    #[test]
    fn random_tasks_miss_as_many_as_laid_out() {
        let mut random = Random(5);
        let (mut some, mut all, mut jittered) = (0, 0, 0);
        for round in 0..500 {
            let mut draw = |least: u64, most: u64| least + random.below(most - least + 1);
            let count = draw(2, 3);
            let mut tasks: Vec<(u64, u64, u64)> = (0..count)
                .map(|_| {
                    let period = draw(3, 12);
                    (period, draw(0, period), draw(1, 4))
                })
                .collect();
            tasks.sort();
            let load: f64 = tasks.iter().map(|(period, _, execution)| *execution as f64 / *period as f64).sum();
            if load > 1.0 {
                continue;
            }
            let deadline = draw(2, tasks.last().map_or(2, |task| task.0));
            let cycles = draw(2, 9);
            let laid = most(&tasks, deadline, cycles).expect("it repeats");
            assert_eq!(laid, ticked(&tasks, deadline, cycles as usize, |_| 0), "{tasks:?} {deadline} {cycles}");
            all += 1;
            some += usize::from(laid > 0 && laid < cycles);
            // With jitter no run misses more; what is released in time always may be, so none of these bounds is less.
            let jitters: Vec<u64> = tasks.iter().map(|(period, ..)| draw(0, (*period - 1).min(3))).collect();
            let with: Vec<_> = tasks.iter().copied().zip(jitters.iter().copied()).collect();
            let bound = most_late(&with, deadline, cycles).expect("it repeats");
            assert!(bound >= laid, "{with:?} {deadline} {cycles}: {bound} < {laid}");
            for way in 0..4 {
                let delay = |task: usize| match way {
                    0 => jitters[task],
                    1 => jitters[task] * random.below(2),
                    _ => random.below(jitters[task] + 1),
                };
                let seen = ticked(&tasks, deadline, cycles as usize, delay);
                assert!(seen <= bound, "{round}: {with:?} {deadline} {cycles}: {seen} > {bound}");
            }
            jittered += usize::from(bound > 0 && bound < cycles);
        }
        assert!(all > 250 && some > 30 && jittered > 30, "{all} {some} {jittered}");
    }
}
