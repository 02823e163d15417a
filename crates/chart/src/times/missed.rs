//! How many deadlines a task may miss among successive cycles, bounded without a search.
//!
//! In: a system, and what is known of its tasks' responses. Out: for each task that may miss some deadlines, the most that it misses in any
//! window of its cycles: G. Bernat, A. Burns, A. Llamosi, *Weakly Hard Real-Time Systems* (2001). On one processor, the cycles of the task and
//! of the more urgent ones are laid out one by one, each as long as it may take, released as the chart says, until the layout repeats.
//! Shorter cycles end no later, since tasks are preempted by more urgent ones alone. INVARIANT: no run misses more than is given.

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

/// LIMIT: cycles that are laid out before the search for a repetition is given up.
const CYCLES: usize = 100_000;

/// The cycles of a task as they are released, and what is left of them.
struct Lane {
    next: u64,
    period: u64,
    execution: u64,
    /// The work that was released and is not done.
    left: u64,
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
    if system.components.iter().any(|component| component.timing.jitter() > 0) {
        return open("missed deadlines are not counted where releases have jitter");
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
        lanes.push(Lane { next: offset, period, execution: own, left: 0 });
    }
    match Layout::new(lanes, deadline, tolerance.cycles).most() {
        Some(most) => known(most, blocking + rest == 0),
        None => open("the cycles do not repeat within the ticks that are looked at"),
    }
}

/// Cycles on one processor, the most urgent lane first; those of the last one are judged.
struct Layout {
    lanes: Vec<Lane>,
    deadline: u64,
    cycles: u64,
    now: u64,
    /// The releases of the judged lane whose cycles are not done.
    open: std::collections::VecDeque<u64>,
    /// Whether each of its cycles was late.
    late: Vec<bool>,
}

impl Layout {
    fn new(lanes: Vec<Lane>, deadline: u64, cycles: u64) -> Layout {
        Layout { lanes, deadline, cycles, now: 0, open: Default::default(), late: Vec::new() }
    }

    fn most(mut self) -> Option<u64> {
        let every = self.lanes.iter().try_fold(1_u64, |all, lane| {
            let common = gcd(all, lane.period);
            (all / common).checked_mul(lane.period)
        })?;
        let load: f64 = self.lanes.iter().map(|lane| lane.execution as f64 / lane.period as f64).sum();
        if load > 1.0 + 1e-9 {
            // More and more is left, until every cycle is late.
            return Some(self.cycles);
        }
        let first = self.lanes.iter().map(|lane| lane.next).max()?;
        let mut at = first;
        let mut before: Option<Vec<u64>> = None;
        loop {
            self.run_until(at)?;
            let state: Vec<u64> = self.lanes.iter().map(|lane| lane.left).collect();
            if before.as_ref() == Some(&state) {
                break;
            }
            before = Some(state);
            at = at.checked_add(every)?;
        }
        // From here on all repeats: a whole repetition, and a window more.
        let period = self.lanes.last()?.period;
        let window = self.cycles.checked_mul(period)?;
        let end = at.checked_add(every)?.checked_add(window)?.checked_add(window)?;
        self.run_until(end)?;
        let window = usize::try_from(self.cycles).ok()?;
        let mut within: u64 = 0;
        let mut most = 0;
        for (cycle, late) in self.late.iter().enumerate() {
            within += u64::from(*late);
            if cycle >= window && self.late[cycle - window] {
                within -= 1;
            }
            most = most.max(within);
        }
        Some(most)
    }

    /// Lays cycles out up to this tick; none if there are too many.
    fn run_until(&mut self, end: u64) -> Option<()> {
        while self.now < end {
            let last = self.lanes.len() - 1;
            for (at, lane) in self.lanes.iter_mut().enumerate() {
                while lane.next <= self.now {
                    lane.left += lane.execution;
                    if at == last {
                        self.open.push_back(lane.next);
                    }
                    lane.next += lane.period;
                }
            }
            let release = self.lanes.iter().map(|lane| lane.next).min()?.min(end);
            let Some(at) = self.lanes.iter().position(|lane| lane.left > 0) else {
                self.now = release;
                continue;
            };
            // The judged lane is looked at after each of its cycles.
            let lane = &mut self.lanes[at];
            let cycle = if at == last { (lane.left - 1) % lane.execution + 1 } else { lane.left };
            let spent = cycle.min(release - self.now);
            lane.left -= spent;
            self.now += spent;
            if at == last && spent == cycle {
                let released = self.open.pop_front()?;
                self.late.push(self.now - released > self.deadline);
                if self.late.len() > CYCLES {
                    return None;
                }
            }
        }
        Some(())
    }
}

fn gcd(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { gcd(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Tasks as period, offset, execution, the most urgent first; the last one is judged.
    fn most(tasks: &[(u64, u64, u64)], deadline: u64, cycles: u64) -> Option<u64> {
        let lane = |&(period, next, execution): &(u64, u64, u64)| Lane { next, period, execution, left: 0 };
        Layout::new(tasks.iter().map(lane).collect(), deadline, cycles).most()
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

    /// Tick by tick, over a long time.
    fn ticked(tasks: &[(u64, u64, u64)], deadline: u64, cycles: usize) -> u64 {
        let last = tasks.len() - 1;
        let mut open: Vec<std::collections::VecDeque<(u64, u64)>> = vec![Default::default(); tasks.len()];
        let mut late = Vec::new();
        for now in 0..20_000 {
            for (at, (period, offset, execution)) in tasks.iter().enumerate() {
                if now >= *offset && (now - offset) % period == 0 {
                    open[at].push_back((now, *execution));
                }
            }
            let Some(at) = open.iter().position(|jobs| !jobs.is_empty()) else { continue };
            let job = &mut open[at][0];
            job.1 -= 1;
            if job.1 == 0 {
                let (released, _) = open[at].pop_front().expect("it is there");
                if at == last {
                    late.push(now + 1 - released > deadline);
                }
            }
        }
        let count = |window: &[bool]| window.iter().filter(|late| **late).count() as u64;
        late.windows(cycles).map(count).max().unwrap_or(0)
    }

    #[test]
    fn random_tasks_miss_as_many_as_laid_out() {
        let mut state = 0x2545_f491_4f6c_dd1d_u64;
        let mut draw = |least: u64, most: u64| {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            least + state % (most - least + 1)
        };
        let (mut some, mut all) = (0, 0);
        for _ in 0..300 {
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
            assert_eq!(laid, ticked(&tasks, deadline, cycles as usize), "{tasks:?} {deadline} {cycles}");
            all += 1;
            some += usize::from(laid > 0 && laid < cycles);
        }
        assert!(all > 150 && some > 20, "{all} {some}");
    }
}
