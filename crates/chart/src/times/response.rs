//! How long tasks take until they are done, where they share processors: pure arithmetic on ticks.
//!
//! In: what tasks ask of a processor. Out: the longest response, or none if no bound is found. On one processor this is response-time
//! analysis: M. Joseph, P. Pandya, *Finding Response Times in a Real-Time System* (1986); N. Audsley, A. Burns, M. Richardson,
//! K. Tindell, A. Wellings, *Applying New Scheduling Theory to Static Priority Pre-emptive Scheduling* (1993), with blocking and release
//! jitter. On several processors with one queue of ready tasks: M. Bertogna, M. Cirinei, *Response-Time Analysis for Globally
//! Scheduled Symmetric Multiprocessor Platforms* (2007). INVARIANT: no run of preemptive tasks with fixed priorities takes longer than
//! the response given; it must not know charts.

/// What a task asks of its processor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Demand {
    /// The longest execution.
    pub(crate) execution: u64,
    /// The shortest time between two releases that come without jitter.
    pub(crate) period: u64,
    /// How much later than it should a release may come.
    pub(crate) jitter: u64,
}

/// LIMIT: rounds of an iteration; beyond that no bound is found.
const ROUNDS: usize = 10_000;

/// The longest time from the instant at which a task becomes ready until it is done, on one processor. `higher` are the tasks that
/// are more urgent, `blocking` is how long less urgent ones may keep it waiting.
pub(crate) fn on_one(execution: u64, blocking: u64, higher: &[Demand], limit: u64) -> Option<u64> {
    let own = execution.saturating_add(blocking);
    iterated(own, limit, |response| {
        higher.iter().fold(own, |sum, other| {
            let releases = response.saturating_add(other.jitter).div_ceil(other.period.max(1));
            sum.saturating_add(releases.saturating_mul(other.execution))
        })
    })
}

/// The same on several processors, where the most urgent ready tasks run. Each of `higher` stands with its own response, its jitter
/// included; nothing blocks.
pub(crate) fn on_several(processors: u64, execution: u64, higher: &[(Demand, u64)], limit: u64) -> Option<u64> {
    iterated(execution, limit, |response| {
        let most = (response - execution).saturating_add(1);
        let interference = higher.iter().fold(0_u64, |sum, (other, responds)| {
            // The work of a task within a window: the jobs that fit, and the rest of one more.
            let reach = response.saturating_add(*responds).saturating_sub(other.execution);
            let (jobs, rest) = (reach / other.period.max(1), reach % other.period.max(1));
            let work = jobs.saturating_mul(other.execution).saturating_add(rest.min(other.execution));
            sum.saturating_add(work.min(most))
        });
        execution.saturating_add(interference / processors)
    })
}

/// The least fixed point from `start` on, if it is at most `limit`.
fn iterated(start: u64, limit: u64, next: impl Fn(u64) -> u64) -> Option<u64> {
    let mut response = start;
    for _ in 0..ROUNDS {
        if response > limit {
            return None;
        }
        let following = next(response);
        if following == response {
            return Some(response);
        }
        response = following;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The responses of tasks on one processor, the most urgent first: execution, period, blocking, jitter.
    fn responses(tasks: &[(u64, u64, u64, u64)]) -> Vec<Option<u64>> {
        let demand = |&(execution, period, _, jitter): &(u64, u64, u64, u64)| Demand { execution, period, jitter };
        let higher: Vec<Demand> = tasks.iter().map(demand).collect();
        let respond = |index: usize| {
            let (execution, _, blocking, jitter) = tasks[index];
            on_one(execution, blocking, &higher[..index], 10_000).map(|response| response + jitter)
        };
        (0..tasks.len()).map(respond).collect()
    }

    /// A. Burns, A. Wellings, *Real-Time Systems and Programming Languages*: the task sets of the chapter on scheduling.
    #[test]
    fn published_task_sets() {
        // Task set C: utilisation 1, and all deadlines are met.
        assert_eq!(responses(&[(5, 20, 0, 0), (10, 40, 0, 0), (40, 80, 0, 0)]), [Some(5), Some(15), Some(80)]);
        // The example of response-time analysis: periods 7, 12, 20.
        assert_eq!(responses(&[(3, 7, 0, 0), (3, 12, 0, 0), (5, 20, 0, 0)]), [Some(3), Some(6), Some(20)]);
        // Task set A cannot hold: 12 of 50, 10 of 40, 10 of 30. The least urgent one comes too late.
        assert_eq!(responses(&[(10, 30, 0, 0), (10, 40, 0, 0), (12, 50, 0, 0)]), [Some(10), Some(20), Some(52)]);
        // Deadline-monotonic order: a, b, c, d with the deadlines 5, 7, 10, 20.
        assert_eq!(
            responses(&[(3, 20, 0, 0), (3, 15, 0, 0), (4, 10, 0, 0), (3, 20, 0, 0)]),
            [Some(3), Some(6), Some(10), Some(20)]
        );
    }

    #[test]
    fn blocking_and_jitter() {
        // Both delay a task itself; the jitter of a more urgent task lets it come once more.
        assert_eq!(responses(&[(3, 7, 2, 0), (3, 12, 1, 0)]), [Some(5), Some(7)]);
        assert_eq!(responses(&[(3, 7, 0, 1), (3, 12, 0, 2)]), [Some(4), Some(8)]);
        assert_eq!(responses(&[(3, 7, 0, 2), (3, 12, 0, 0)]), [Some(5), Some(9)]);
        assert_eq!(responses(&[(3, 3, 0, 0), (1, 12, 0, 0)]), [Some(3), None]);
    }

    struct Numbers(u64);

    impl Numbers {
        fn below(&mut self, bound: u64) -> u64 {
            self.0 ^= self.0 << 13;
            self.0 ^= self.0 >> 7;
            self.0 ^= self.0 << 17;
            self.0 % bound
        }
    }

    /// The longest response of each task in a run, tick by tick: the most urgent ready jobs run. The jobs of a task run one after the
    /// other. `released` says when each task is released.
    fn simulated(processors: usize, executions: &[u64], released: &[Vec<u64>], ticks: u64) -> Vec<u64> {
        let mut open: Vec<Vec<(u64, u64)>> = vec![Vec::new(); executions.len()];
        let mut longest = vec![0; executions.len()];
        for now in 0..ticks {
            for (task, releases) in released.iter().enumerate() {
                open[task].extend(releases.iter().filter(|at| **at == now).map(|at| (*at, executions[task])));
            }
            let ready: Vec<usize> = (0..executions.len()).filter(|task| !open[*task].is_empty()).collect();
            for task in ready.into_iter().take(processors) {
                open[task][0].1 -= 1;
                if open[task][0].1 == 0 {
                    let (at, _) = open[task].remove(0);
                    longest[task] = longest[task].max(now + 1 - at);
                }
            }
        }
        longest
    }

    fn drawn(numbers: &mut Numbers) -> Vec<(u64, u64)> {
        let count = 2 + numbers.below(3);
        let mut tasks: Vec<(u64, u64)> = (0..count).map(|_| (1 + numbers.below(4), 4 + numbers.below(9))).collect();
        tasks.sort_by_key(|(_, period)| *period);
        tasks
    }

    #[test]
    fn random_task_sets_take_no_longer_than_analysed() {
        let mut numbers = Numbers(0x9e37_79b9_7f4a_7c15);
        let mut bounded = 0;
        for _ in 0..400 {
            let tasks = drawn(&mut numbers);
            let demands: Vec<Demand> =
                tasks.iter().map(|&(execution, period)| Demand { execution, period, jitter: 0 }).collect();
            let executions: Vec<u64> = tasks.iter().map(|(execution, _)| *execution).collect();
            let analysed = |index: usize| on_one(executions[index], 0, &demands[..index], tasks[index].1);
            let hyperperiod = tasks.iter().fold(1, |all, (_, period)| all / gcd(all, *period) * period);
            let ticks = (2 * hyperperiod).min(6_000);
            let every = |start: u64, period: u64| {
                (0..ticks).filter(|at| *at >= start && (*at - start).is_multiple_of(period)).collect()
            };
            // Released at once, as at the critical instant: the longest response is the analysed one.
            let at_once: Vec<Vec<u64>> = tasks.iter().map(|(_, period)| every(0, *period)).collect();
            let longest = simulated(1, &executions, &at_once, ticks);
            let offset: Vec<Vec<u64>> =
                tasks.iter().map(|(_, period)| every(numbers.below(*period), *period)).collect();
            let shifted = simulated(1, &executions, &offset, ticks);
            for index in 0..tasks.len() {
                if (0..=index).all(|task| analysed(task).is_some()) {
                    let response = analysed(index).expect("it was asked");
                    assert_eq!(longest[index], response, "{tasks:?}, task {index}");
                    assert!(shifted[index] <= response, "{tasks:?}, task {index}");
                    bounded += 1;
                }
            }
        }
        assert!(bounded > 400, "{bounded}");
    }

    #[test]
    fn releases_with_jitter_take_no_longer_than_analysed() {
        let mut numbers = Numbers(77);
        let (mut bounded, mut tight) = (0, 0);
        for _ in 0..400 {
            let tasks = drawn(&mut numbers);
            let jitters: Vec<u64> = tasks.iter().map(|_| numbers.below(3)).collect();
            let demands: Vec<Demand> = tasks
                .iter()
                .zip(&jitters)
                .map(|(&(execution, period), jitter)| Demand { execution, period, jitter: *jitter })
                .collect();
            let executions: Vec<u64> = tasks.iter().map(|(execution, _)| *execution).collect();
            for late in 0..3 {
                // The first releases come as late as they may, all others at random, or in time.
                let mut releases = |task: usize| -> Vec<u64> {
                    let (period, jitter) = (tasks[task].1, jitters[task]);
                    let one = |number: u64| {
                        let delay = match (late, number) {
                            (0, 0) => jitter,
                            (0, _) => 0,
                            _ => numbers.below(jitter + 1),
                        };
                        number * period + 10 - jitters[task] + delay
                    };
                    (0..600 / period).map(one).collect()
                };
                let released: Vec<Vec<u64>> = (0..tasks.len()).map(&mut releases).collect();
                let longest = simulated(1, &executions, &released, 700);
                for (index, longest) in longest.iter().enumerate() {
                    let all = |task: usize| {
                        let limit = tasks[task].1 - jitters[task];
                        on_one(executions[task], 0, &demands[..task], limit)
                    };
                    if (0..=index).all(|task| all(task).is_some()) {
                        let response = all(index).expect("it was asked");
                        assert!(*longest <= response, "{tasks:?} {jitters:?}, task {index}");
                        bounded += 1;
                        tight += usize::from(*longest == response);
                    }
                }
            }
        }
        assert!(bounded > 1000 && tight > 500, "{bounded} {tight}");
    }

    #[test]
    fn several_processors_take_no_longer_than_analysed() {
        let mut numbers = Numbers(4711);
        let mut bounded = 0;
        for _ in 0..600 {
            let mut tasks = drawn(&mut numbers);
            tasks.extend(drawn(&mut numbers));
            tasks.sort_by_key(|(_, period)| *period);
            let executions: Vec<u64> = tasks.iter().map(|(execution, _)| *execution).collect();
            let mut higher: Vec<(Demand, u64)> = Vec::new();
            let mut analysed = Vec::new();
            for &(execution, period) in &tasks {
                let Some(response) = on_several(2, execution, &higher, period) else { break };
                higher.push((Demand { execution, period, jitter: 0 }, response));
                analysed.push(response);
            }
            for _ in 0..4 {
                let released: Vec<Vec<u64>> = tasks
                    .iter()
                    .map(|(_, period)| {
                        let offset = numbers.below(*period);
                        (0..600 / period).map(|number| number * period + offset).collect()
                    })
                    .collect();
                let longest = simulated(2, &executions, &released, 700);
                for (index, response) in analysed.iter().enumerate() {
                    assert!(longest[index] <= *response, "{tasks:?}, task {index}: {} > {response}", longest[index]);
                    bounded += 1;
                }
            }
        }
        assert!(bounded > 2000, "{bounded}");
    }

    fn gcd(a: u64, b: u64) -> u64 {
        if b == 0 { a } else { gcd(b, a % b) }
    }
}
