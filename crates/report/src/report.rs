//! A validated run, ready to be shown: lanes, figures, verdicts.
//!
//! In: what [`ReportBuilder`](crate::ReportBuilder) saw of a run, and data that a shell adds: scenarios, coverage,
//! invariants, facts of the run. Out: the one type that every drawing, table and summary reads. Plain data: nothing
//! here knows how it is shown.

use crate::flow::Flow;
use crate::levels::Levels;
use crate::tally::Tally;
use crate::time::TimeBase;
use crate::track::{Curve, Kind, Track};

/// Everything a report shows.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Report {
    /// The title.
    pub title: String,
    /// A sentence or two below it.
    pub note: String,
    /// The model's name.
    pub model: String,
    /// What a tick is.
    pub time: TimeBase,
    /// How many ticks the run has.
    pub ticks: u64,
    /// Whether the first of them shows the initial state, so that the run has one step less.
    pub from_initial: bool,
    /// How many of them the lanes show; the figures are of the whole run.
    pub shown: u64,
    /// How many ticks the first view shows.
    pub window: u64,
    /// The activities of tasks, in the order of the legend.
    pub activities: Vec<Kind>,
    /// The tasks.
    pub tasks: Vec<Task>,
    /// The buffers.
    pub buffers: Vec<Buffer>,
    /// The queues.
    pub queues: Vec<Queue>,
    /// The values over time.
    pub series: Vec<Series>,
    /// The way of data through the tasks.
    pub flow: Option<Flow>,
    /// Pictures in which the present states are lit.
    pub charts: Vec<Chart>,
    /// The style of these pictures.
    pub chart_style: String,
    /// The invariants, and whether each held in every state. Added by the shell.
    pub invariants: Vec<Invariant>,
    /// Why the run ended early, if it did. Added by the shell.
    pub stopped: Option<String>,
    /// The scenarios run beside it. Added by the shell.
    pub scenarios: Vec<Scenario>,
    /// What run and scenarios executed. Added by the shell.
    pub coverage: Option<Coverage>,
    /// Seed, versions, files. Added by the shell.
    pub facts: Vec<Fact>,
}

/// A task's lane and figures.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Task {
    /// Its name.
    pub name: String,
    /// A few words on it.
    pub caption: String,
    /// Ticks of its period.
    pub period: Option<u64>,
    /// Its deadline in ticks from the start of a period, if it is not the whole period.
    pub deadline: Option<u64>,
    /// It may miss deadlines; an invariant says how many.
    pub may_miss: bool,
    /// What it did; its kinds are [`Report::activities`].
    pub track: Track,
    /// Ticks spent in each activity, in the whole run.
    pub shares: Vec<u64>,
    /// Every waiting, by its length.
    pub waits: Tally,
    /// Release to completion, for every completed cycle of a task with releases; of one without periods from when it was no longer idle;
    /// otherwise completion to completion.
    pub cycles: Tally,
    /// Cycles completed.
    pub completed: Option<u64>,
    /// Cycles completed in time.
    pub met: Option<u64>,
    /// Cycles completed too late.
    pub missed: Option<u64>,
    /// Actions given up.
    pub skipped: Option<u64>,
    /// Ticks by which the last cycle, not completed at the end of the run, is late.
    pub overdue: Option<u64>,
    /// The ticks at which its periods begin.
    pub releases: Vec<u64>,
    /// The ticks at which it completed too late.
    pub misses: Vec<u64>,
}

/// A buffer's lane and figures.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Buffer {
    /// Who writes.
    pub from: String,
    /// Who reads.
    pub to: String,
    /// What is done with each array.
    pub rows: Vec<Track>,
    /// Who is inside the lock.
    pub lock: Option<Track>,
    /// Every stay inside the lock, by its length.
    pub held: Tally,
    /// The ticks at which arrays were swapped.
    pub swaps: Vec<u64>,
    /// How many swaps there were in the whole run.
    pub swapped: Option<u64>,
    /// Further counts: words and number.
    pub counters: Vec<(String, Option<i64>)>,
}

/// A queue's lane and figures.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Queue {
    /// Who sends.
    pub from: String,
    /// Who receives.
    pub to: String,
    /// What it is: a queue, unless the specification says something else.
    pub kind: String,
    /// Messages in it.
    pub length: Curve,
    /// Its length, weighed by ticks.
    pub lengths: Tally,
    /// How many it can hold.
    pub capacity: Option<u64>,
    /// Further counts: words and number.
    pub counters: Vec<(String, Option<i64>)>,
}

/// A value over time.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Series {
    /// Its name.
    pub name: String,
    /// What it says.
    pub caption: String,
    /// The value.
    pub curve: Curve,
    /// Its values, weighed by ticks.
    pub values: Levels,
    /// The value is a number of ticks.
    pub ticks: bool,
    /// What it must never exceed.
    pub bound: Option<i64>,
}

/// A picture of a machine, and what was lit in it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Chart {
    /// The title.
    pub title: String,
    /// An `svg` element, in which each part that can be lit has its name in `data-shape`.
    pub picture: String,
    /// What goes from part to part.
    pub lights: Vec<Lights>,
    /// Several may be in one part: they are told apart by their names.
    pub named: bool,
}

/// Where something was in a picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Lights {
    /// Its name.
    pub name: String,
    /// The names of the parts in `data-shape`; the kinds of the track, in their order.
    pub parts: Vec<String>,
    /// Where it was.
    pub track: Track,
    /// Ticks spent in each part, in the whole run.
    pub shares: Vec<u64>,
}

/// An invariant of the model.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Invariant {
    /// Its name.
    pub name: String,
    /// Where it is declared.
    pub position: String,
    /// `None`: it held in every state; otherwise where it did not.
    pub violated: Option<String>,
}

/// How a scenario ended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Verdict {
    /// Every check held.
    Passed,
    /// It had to fail, and did: a seeded fault was caught.
    FailedAsExpected,
    /// A check did not hold, or the run broke: why, and where.
    Failed(String),
}

/// A scenario that was run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Scenario {
    /// Its name.
    pub name: String,
    /// Its file, relative to the project.
    pub file: String,
    /// Steps it made.
    pub steps: u64,
    /// Checks it made.
    pub checks: u64,
    /// How it ended.
    pub verdict: Verdict,
}

/// What was executed.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Coverage {
    /// Of what: a sentence on the runs it adds up.
    pub scope: String,
    /// One for each kind of thing: rules, branches, updates, forall.
    pub measures: Vec<Measure>,
}

/// One kind of thing to be covered.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Measure {
    /// Of what, plural.
    pub what: String,
    /// How many were.
    pub covered: u64,
    /// Of how many.
    pub total: u64,
    /// Those that were not: name and position.
    pub missed: Vec<(String, String)>,
}

/// Something worth knowing about the run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fact {
    /// What.
    pub label: String,
    /// How much.
    pub value: String,
}

impl Report {
    /// How many steps the run has.
    pub fn steps(&self) -> u64 {
        self.ticks - u64::from(self.from_initial)
    }

    /// Whether there is anything to be seen over time.
    pub fn has_lanes(&self) -> bool {
        let lanes = self.tasks.len() + self.buffers.len() + self.queues.len() + self.series.len() + self.charts.len();
        lanes > 0
    }

    /// Cycles of synchronous tasks that ended in time, and too late (those overdue at the end included).
    pub fn deadlines(&self) -> (u64, u64) {
        let met = self.tasks.iter().filter_map(|task| task.met).sum();
        let missed: u64 = self.tasks.iter().filter_map(|task| task.missed).sum();
        (met, missed + self.tasks.iter().filter(|task| task.overdue.is_some()).count() as u64)
    }

    /// The longest waiting: its ticks, its start and its task.
    pub fn longest_wait(&self) -> Option<(u64, u64, &Task)> {
        let longest = |task: &Task| task.waits.greatest().map_or(0, |(ticks, _)| ticks);
        let mut found: Option<&Task> = None;
        for task in self.tasks.iter().filter(|task| !task.waits.is_empty()) {
            if found.is_none_or(|best| longest(task) > longest(best)) {
                found = Some(task);
            }
        }
        found.and_then(|task| task.waits.greatest().map(|(ticks, at)| (ticks, at, task)))
    }

    /// Scenarios that ended as they should.
    pub fn passed(&self) -> usize {
        self.scenarios.iter().filter(|scenario| !matches!(scenario.verdict, Verdict::Failed(_))).count()
    }

    /// Whether there was anything that could have gone wrong: invariants, deadlines, bounds or scenarios.
    pub fn is_checked(&self) -> bool {
        let (met, missed) = self.deadlines();
        let bounded = self.series.iter().any(|series| series.bound.is_some());
        met + missed > 0 || bounded || !self.invariants.is_empty() || !self.scenarios.is_empty()
    }

    /// Whether its lanes are tasks, which have cycles and wait; else they are functions of a model, which just have values.
    pub fn has_tasks(&self) -> bool {
        self.tasks.iter().any(|task| {
            let counts = [task.period, task.completed, task.met, task.missed, task.skipped];
            counts.iter().any(Option::is_some) || !task.waits.is_empty()
        })
    }

    /// What went wrong, one sentence each; none: the run is as it should be.
    pub fn troubles(&self) -> Vec<String> {
        let mut troubles = Vec::new();
        troubles.extend(self.stopped.clone());
        for task in self.tasks.iter().filter(|task| !task.may_miss) {
            match task.missed.unwrap_or(0) {
                0 => {}
                1 => troubles.push(format!("{} missed a deadline", task.name)),
                n => troubles.push(format!("{} missed {} deadlines", task.name, crate::time::count(n))),
            }
            if let Some(late) = task.overdue {
                troubles.push(format!(
                    "{} was {} late with the cycle it was in at the end",
                    task.name,
                    self.time.show(late)
                ));
            }
        }
        for series in &self.series {
            let greatest = series.values.greatest().map(|(value, _)| value);
            if let (Some(bound), Some(greatest)) = (series.bound, greatest)
                && greatest > bound
            {
                let by = series.show(self.time, greatest);
                troubles.push(format!(
                    "{} reached {by}, above its bound {}",
                    series.name,
                    series.show(self.time, bound)
                ));
            }
        }
        for invariant in &self.invariants {
            if let Some(place) = &invariant.violated {
                troubles.push(format!("invariant {} was violated: {place}", invariant.name));
            }
        }
        let failed = self.scenarios.len() - self.passed();
        if failed > 0 {
            troubles.push(format!("{failed} of {} scenarios failed", self.scenarios.len()));
        }
        troubles
    }
}

/// What is said of a run in which nothing could go wrong.
pub(crate) const UNCHECKED: &str =
    "Nothing was checked: the run has no invariants, no deadlines, no bounds and no scenarios.";

impl Task {
    /// Whether it missed a deadline, or was late at the end.
    pub fn is_late(&self) -> bool {
        self.missed.is_some_and(|missed| missed > 0) || self.overdue.is_some()
    }

    /// The ticks that a cycle may take: up to its deadline.
    pub fn allowed(&self) -> Option<u64> {
        self.deadline.or(self.period)
    }

    /// Its deadline, if that is not the end of its period.
    pub(crate) fn early_deadline(&self) -> Option<u64> {
        self.deadline.filter(|deadline| Some(*deadline) != self.period)
    }

    /// Its period and its caption.
    pub fn describe(&self, time: TimeBase) -> String {
        match self.period {
            None => self.caption.clone(),
            Some(period) if self.caption.is_empty() => format!("every {}", time.short(period)),
            Some(period) => format!("every {}, {}", time.short(period), self.caption),
        }
    }
}

impl Series {
    /// A value of this series in words.
    pub fn show(&self, time: TimeBase, value: i64) -> String {
        if self.ticks { format!("{}\u{202f}{}", time.bare(value), time.unit()) } else { value.to_string() }
    }

    /// A mean of its values in words.
    pub fn show_mean(&self, time: TimeBase) -> String {
        if self.ticks { time.mean(self.values.mean()) } else { format!("{:.2}", self.values.mean()) }
    }
}

impl Measure {
    /// The share that was covered, in percent; nothing to cover is covered. Less than all is less than 100.0, however it is rounded.
    pub fn percent(&self) -> f64 {
        if self.covered >= self.total { 100.0 } else { (self.covered as f64 * 100.0 / self.total as f64).min(99.9) }
    }
}
