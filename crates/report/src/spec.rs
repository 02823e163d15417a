//! The report specification: which terms of a model make which lane.
//!
//! Nothing here knows a robot, a task library or a file format. The caller reads the specification from a file,
//! evaluates its [`Spec::terms`] in each state, and hands their values to a [`ReportBuilder`](crate::ReportBuilder) as
//! text. An optional field may be missing; what it would show is then left out.

use crate::tone::Tone;

/// A term of the model, as text.
pub type TermText = String;

/// A whole specification. [`Spec::default`] shows nothing, in steps.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Spec {
    /// The page's title; the model's name when empty.
    pub title: String,
    /// A sentence or two below the title.
    pub note: String,
    /// How long a step is, in nanoseconds; `None`: steps are only counted.
    pub tick_ns: Option<u64>,
    /// How many ticks the first view shows; 0: a fitting number.
    pub window: u64,
    /// What the values of the activity terms mean; values not named here get a tone by order of appearance.
    pub activities: Vec<ActivitySpec>,
    /// One lane each.
    pub tasks: Vec<TaskSpec>,
    /// One lane each.
    pub buffers: Vec<BufferSpec>,
    /// One lane each.
    pub queues: Vec<QueueSpec>,
    /// Values over time, one curve each.
    pub series: Vec<SeriesSpec>,
    /// The way of a datum through the tasks.
    pub flow: Option<FlowSpec>,
    /// Pictures in which the present states are lit.
    pub charts: Vec<ChartSpec>,
    /// The style of these pictures.
    pub chart_style: String,
}

/// A picture of a machine, and what is lit in it.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ChartSpec {
    /// The title.
    pub title: String,
    /// An `svg` element, in which each part that can be lit has its name in `data-shape`.
    pub picture: String,
    /// What goes from part to part.
    pub lights: Vec<LightsSpec>,
    /// Several may be in one part: they are told apart by their names.
    pub named: bool,
}

/// Something that goes from part to part of a picture.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct LightsSpec {
    /// Its name for people.
    pub name: String,
    /// The term whose value says where it is.
    pub term: TermText,
    /// Without it being true, it is nowhere.
    pub when: Option<TermText>,
    /// For each value, the part that is lit, and its name in words.
    pub parts: Vec<PartSpec>,
}

/// A part of a picture.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct PartSpec {
    /// The value, as the model prints it.
    pub value: String,
    /// The name in `data-shape`.
    pub part: String,
    /// In words.
    pub label: String,
}

/// What a value of an activity term means.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ActivitySpec {
    /// The value, as the model prints it.
    pub value: String,
    /// In words.
    pub label: String,
    /// For the eye. Time in [`Tone::Wait`] is counted as waiting.
    pub tone: Tone,
}

/// A task.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct TaskSpec {
    /// Its name for people.
    pub name: String,
    /// A few words on its kind; its period is added when it has one.
    pub caption: String,
    /// What it is doing.
    pub activity: TermText,
    /// Its period in ticks, read in the first state; if it is undef, release and deadlines do not count.
    pub period: Option<TermText>,
    /// Its deadline in ticks from the start of a period, read in the first state; the whole period, if it is undef.
    pub deadline: Option<TermText>,
    /// Whether it may miss deadlines, read in the first state: then a missed one is no trouble, and an invariant says how many may be.
    pub may_miss: Option<TermText>,
    /// The tick at which its present period began.
    pub release: Option<TermText>,
    /// How many cycles it has completed.
    pub cycles: Option<TermText>,
    /// How many of them in time.
    pub met: Option<TermText>,
    /// How many of them too late.
    pub missed: Option<TermText>,
    /// How many actions it gave up.
    pub skipped: Option<TermText>,
}

/// Shared memory of several arrays between a writer and a reader.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct BufferSpec {
    /// Who writes.
    pub from: String,
    /// Who reads.
    pub to: String,
    /// How many arrays it has, read in the first state; without it, as many as are seen.
    pub arrays: Option<TermText>,
    /// The array that is being written just now; undef if none.
    pub writing: Option<TermText>,
    /// The array that is being read just now; undef if none.
    pub reading: Option<TermText>,
    /// The array the next writing goes to.
    pub write_index: Option<TermText>,
    /// The array the next reading comes from.
    pub read_index: Option<TermText>,
    /// The task inside the lock; undef if there is none.
    pub lock: Option<TermText>,
    /// How often the arrays were swapped.
    pub swaps: Option<TermText>,
    /// Further counts, read in the last state.
    pub counters: Vec<CounterSpec>,
}

/// A queue of messages.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct QueueSpec {
    /// Who sends.
    pub from: String,
    /// Who receives.
    pub to: String,
    /// What it is: a queue, if this is empty; or a shared value, which holds one datum until it is read.
    pub kind: String,
    /// How many messages are in it.
    pub length: TermText,
    /// How many it can hold, read in the first state.
    pub capacity: Option<TermText>,
    /// Further counts, read in the last state.
    pub counters: Vec<CounterSpec>,
}

/// A count of the model, shown in a table.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CounterSpec {
    /// In words.
    pub label: String,
    /// The term.
    pub term: TermText,
}

/// A value over time.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct SeriesSpec {
    /// Its name for people.
    pub name: String,
    /// What it says.
    pub caption: String,
    /// The term, an Integer or undef.
    pub value: TermText,
    /// The value is a number of ticks, to be shown as time.
    pub ticks: bool,
    /// What it must never exceed, read in the first state.
    pub bound: Option<TermText>,
}

/// The way of a datum through the tasks: each hop shows the identity (an Integer, unique in a run) of the datum it
/// works on.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct FlowSpec {
    /// What travels, singular and plural: `frame`, `frames`.
    pub noun: (String, String),
    /// From the source to the sink.
    pub hops: Vec<HopSpec>,
}

/// A hop of a flow.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct HopSpec {
    /// The name of its task's lane.
    pub task: String,
    /// What happens there, in the past tense: `captured`, `read`.
    pub event: String,
    /// The identity of the datum that the task got last.
    pub value: TermText,
}

impl Spec {
    /// Steps are only counted: a tick is then the state after so many steps, the initial state among them. Otherwise, and where a task's
    /// releases are told in ticks, a step takes a tick, and what went on in a tick is seen in the state after it.
    pub fn counts_steps(&self) -> bool {
        self.tick_ns.is_none() && self.tasks.iter().all(|task| task.release.is_none())
    }

    /// Every term that must be evaluated, each text once, in the order of the specification.
    pub fn terms(&self) -> Vec<TermText> {
        let mut terms: Vec<&TermText> = Vec::new();
        for task in &self.tasks {
            terms.push(&task.activity);
            terms.extend(
                [
                    &task.period,
                    &task.deadline,
                    &task.may_miss,
                    &task.release,
                    &task.cycles,
                    &task.met,
                    &task.missed,
                    &task.skipped,
                ]
                .into_iter()
                .flatten(),
            );
        }
        for buffer in &self.buffers {
            let BufferSpec { arrays, writing, reading, write_index, read_index, lock, swaps, counters, .. } = buffer;
            terms.extend([arrays, writing, reading, write_index, read_index, lock, swaps].into_iter().flatten());
            terms.extend(counters.iter().map(|counter| &counter.term));
        }
        for queue in &self.queues {
            terms.push(&queue.length);
            terms.extend(&queue.capacity);
            terms.extend(queue.counters.iter().map(|counter| &counter.term));
        }
        for series in &self.series {
            terms.push(&series.value);
            terms.extend(&series.bound);
        }
        terms.extend(self.flow.iter().flat_map(|flow| flow.hops.iter().map(|hop| &hop.value)));
        for lights in self.charts.iter().flat_map(|chart| &chart.lights) {
            terms.push(&lights.term);
            terms.extend(&lights.when);
        }
        let mut distinct: Vec<TermText> = Vec::new();
        for term in terms {
            if !distinct.contains(term) {
                distinct.push(term.clone());
            }
        }
        distinct
    }

    /// What cannot be right in the specification itself, one sentence each.
    pub fn faults(&self) -> Vec<String> {
        let mut faults = Vec::new();
        let mut names: Vec<&str> = Vec::new();
        for task in &self.tasks {
            if names.contains(&task.name.as_str()) {
                faults.push(format!("two tasks are called `{}`: give each lane a name of its own", task.name));
            }
            names.push(&task.name);
            if task.activity.trim().is_empty() {
                faults
                    .push(format!("task `{}` has no `activity`: name the term that says what it is doing", task.name));
            }
        }
        for hop in self.flow.iter().flat_map(|flow| &flow.hops) {
            if !names.contains(&hop.task.as_str()) {
                faults.push(format!(
                    "the flow passes `{}`, which is no task: it must be one of {}",
                    hop.task,
                    names.join(", ")
                ));
            }
        }
        if self.flow.as_ref().is_some_and(|flow| flow.hops.len() < 2) {
            faults.push("a flow needs two hops at least: a source and a sink".to_owned());
        }
        faults
    }
}
