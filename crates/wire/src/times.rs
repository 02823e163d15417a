//! What `chart times` tells of a system: its tasks and the ages of its data. Times are in nanoseconds.
//!
//! In: a system and its [`Times`]. Out: an object for programs, of the command line and of the language server.

use chart::system::{Component, System, Timing};
use chart::times::{Order, TaskTimes, Times, Verdict, bounded};
use serde::Serialize;

/// The times of a system.
#[derive(Debug, Serialize)]
#[serde(tag = "type", rename_all = "lowercase")]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub enum TimesTold<'a> {
    /// The result of `chart times`.
    Times {
        /// The system's name.
        system: &'a str,
        /// How many processors the tasks share.
        processors: u64,
        /// `rate` or `deadline`: which synchronous tasks are more urgent.
        priorities: &'a str,
        /// What all tasks together need, as a number of processors; without tasks that may start at any time.
        load: f64,
        /// The synchronous tasks need more processors than there are.
        overloaded: bool,
        /// In the order of the chart.
        tasks: Vec<TaskTime<'a>>,
        /// The age bounds, in the order of the chart.
        ages: Vec<AgeOfData<'a>>,
        /// The readings that have to bring something new now and then, in the order of the chart.
        fresh: Vec<NewData<'a>>,
    },
}

/// How many deadlines a task may miss.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct MissedDeadlines<'a> {
    /// So many may be missed,
    pub allowed: u64,
    /// of so many successive cycles.
    pub cycles: u64,
    /// The most that the analysis allows; null if it gives none.
    pub most: Option<u64>,
    /// True if it is shown that no more are missed, false if some run misses more; otherwise null.
    pub within: Option<bool>,
    /// Why no number is given.
    pub reason: Option<&'a str>,
}

/// How often a reader gets something new.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct NewData<'a> {
    /// The reading component.
    pub reader: &'a str,
    /// The channel, as it is drawn.
    pub channel: &'a str,
    /// The longest time between two readings that bring something new which is allowed.
    pub limit_ns: u64,
    /// The longest time that the analysis allows; null if it gives none.
    pub most_ns: Option<u64>,
    /// True if the time is shown to be within its limit; otherwise null: it is not known.
    pub within: Option<bool>,
    /// Why no longest time is given.
    pub reason: Option<&'a str>,
}

/// The times of a task.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct TaskTime<'a> {
    /// The component's name.
    pub name: &'a str,
    /// 1 is the most urgent.
    pub priority: usize,
    /// Null for an asynchronous task.
    pub period_ns: Option<u64>,
    /// How much later than its period a cycle may be released; null for an asynchronous task.
    pub jitter_ns: Option<u64>,
    /// The shortest time between two cycles without jitter; null if it may start at any time.
    pub interval_ns: Option<u64>,
    /// The shortest and the longest time of a cycle that never waits.
    pub execution_ns: [u64; 2],
    /// The part of a processor that it needs; null if it may start at any time.
    pub load: Option<f64>,
    /// How long others keep it from locks, at most; null if that is not analysed.
    pub blocking_ns: Option<u64>,
    /// The longest time from the start of its period until the end of the cycle, so its jitter is part of it; of an asynchronous task from
    /// when its cycle could begin; null if none is known.
    pub response_ns: Option<u64>,
    /// Null for an asynchronous task.
    pub deadline_ns: Option<u64>,
    /// `meets`, `misses`, `unknown`; null for an asynchronous task.
    pub verdict: Option<&'a str>,
    /// Why it is not known.
    pub reason: Option<&'a str>,
    /// How many deadlines it misses, if it may miss some; otherwise null.
    pub missed: Option<MissedDeadlines<'a>>,
}

/// The age of data on their way.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct AgeOfData<'a> {
    /// The component or sensor that they come from.
    pub from: &'a str,
    /// The component or actuator that gets what rests on them.
    pub to: &'a str,
    /// The greatest age that is allowed.
    pub limit_ns: u64,
    /// The greatest age that the analysis allows; null if it gives none.
    pub most_ns: Option<u64>,
    /// True if the age is shown to be within its limit; otherwise null: it is not known.
    pub within: Option<bool>,
    /// Why no greatest age is given.
    pub reason: Option<&'a str>,
}

impl<'a> TimesTold<'a> {
    /// The times of a system.
    pub fn of(system: &'a System, times: &'a Times) -> TimesTold<'a> {
        let ns = |ticks: u64| ticks.saturating_mul(system.tick_ns);
        let task = |(component, task): (&'a Component, &'a TaskTimes)| {
            let (period, deadline) = match component.timing {
                Timing::Synchronous { period, deadline, .. } => (Some(period), Some(deadline)),
                Timing::Asynchronous { .. } => (None, None),
            };
            let (verdict, reason) = match &task.verdict {
                Verdict::Meets => (Some("meets"), None),
                Verdict::Misses => (Some("misses"), None),
                Verdict::Open(reason) => (Some("unknown"), Some(reason.as_str())),
                Verdict::None => (None, None),
            };
            TaskTime {
                name: &component.name,
                priority: task.priority,
                period_ns: period.map(ns),
                jitter_ns: period.map(|_| ns(component.timing.jitter())),
                interval_ns: task.interval.map(ns),
                execution_ns: [ns(task.execution.0), ns(task.execution.1)],
                load: task.load,
                blocking_ns: task.blocking.map(ns),
                response_ns: task.response.map(ns),
                deadline_ns: deadline.map(ns),
                verdict,
                reason,
                missed: component.tolerance.zip(task.missed.as_ref()).map(|(tolerance, missed)| MissedDeadlines {
                    allowed: tolerance.missed,
                    cycles: tolerance.cycles,
                    most: missed.most,
                    within: task.keeps(Some(&tolerance)),
                    reason: missed.reason.as_deref(),
                }),
            }
        };
        let fresh = bounded(system).zip(&times.fresh).map(|((phase, bound), one)| NewData {
            reader: &system.components[one.component].name,
            channel: &phase.subject,
            limit_ns: ns(bound.limit),
            most_ns: one.most.map(ns),
            within: one.most.map(|most| most <= bound.limit).filter(|within| *within),
            reason: one.reason.as_deref(),
        });
        let ages = system.bounds.iter().zip(&times.ages).map(|(bound, age)| AgeOfData {
            from: &bound.from.text,
            to: &bound.to.text,
            limit_ns: ns(bound.limit),
            most_ns: age.most.map(ns),
            within: age.most.map(|most| most <= bound.limit).filter(|within| *within),
            reason: age.ways.iter().find_map(|way| way.reason.as_deref()),
        });
        TimesTold::Times {
            system: &system.name,
            processors: times.platform.processors,
            priorities: match times.platform.order {
                Order::Rate => "rate",
                Order::Deadline => "deadline",
            },
            load: times.load,
            overloaded: times.overloaded,
            tasks: system.components.iter().zip(&times.tasks).map(task).collect(),
            ages: ages.collect(),
            fresh: fresh.collect(),
        }
    }
}
