//! From the values of terms, state by state, to a [`Report`].
//!
//! In: a [`Spec`], then in each state the terms whose text changed. Out: the report, to which the shell adds what it
//! knows from elsewhere. A tick is a step. Where steps take time, what the state after step t + 1 shows went on in tick t, and
//! what changed in it happened at the beginning of tick t. Where they are only counted, tick t shows the state after t steps, the initial
//! state among them. The work for a tick does not depend on the number of ticks seen. Memory grows only with the ticks shown, see [`ReportBuilder::show_ticks`].

mod buffer;
mod chart;
mod reading;
mod task;

use crate::flow::Flow;
use crate::levels::Levels;
use crate::report::{Queue, Report, Series};
use crate::spec::{CounterSpec, QueueSpec, SeriesSpec, Spec};
use crate::tally::Tally;
use crate::time::TimeBase;
use crate::track::{Curve, Kind};

use buffer::BufferWatch;
use chart::ChartWatch;
use reading::{Readings, Slot};
use task::TaskWatch;

/// LIMIT: lanes show this many ticks by default; figures always cover the whole run.
pub const SHOWN_TICKS: u64 = 50_000;

/// Collects a run.
#[derive(Debug)]
pub struct ReportBuilder {
    spec: Spec,
    readings: Readings,
    tick: u64,
    shown: u64,
    begun: bool,
    /// The first tick shows the initial state.
    from_initial: bool,
    activities: Vec<Kind>,
    tasks: Vec<TaskWatch>,
    buffers: Vec<BufferWatch>,
    queues: Vec<(Slot, Queue)>,
    series: Vec<(Slot, Series)>,
    flow: Option<(Vec<Slot>, Flow)>,
    charts: Vec<ChartWatch>,
}

/// What all watches share while they look at a state.
struct Moment<'a> {
    readings: &'a Readings,
    tick: u64,
    /// Lanes are still recorded.
    shown: bool,
}

impl ReportBuilder {
    /// A builder for a run that has not begun.
    pub fn new(spec: Spec) -> ReportBuilder {
        let mut readings = Readings::new(spec.terms());
        let activities = spec.activities.iter().map(|a| Kind { label: a.label.clone(), tone: a.tone }).collect();
        let values: Vec<_> = spec.activities.iter().map(|activity| readings.read(&activity.value)).collect();
        let tasks = spec.tasks.iter().map(|task| TaskWatch::new(task, &values, &mut readings)).collect();
        let buffers = spec.buffers.iter().map(|buffer| BufferWatch::new(buffer, &readings)).collect();
        let queues = spec.queues.iter().map(|queue| (readings.slot(&queue.length), new_queue(queue))).collect();
        let series = spec.series.iter().map(|series| (readings.slot(&series.value), new_series(series))).collect();
        let flow = spec.flow.as_ref().map(|flow| {
            let slots = flow.hops.iter().map(|hop| readings.slot(&hop.value)).collect();
            let hops = flow.hops.iter().map(|hop| (hop.task.clone(), hop.event.clone())).collect();
            (slots, Flow::new(flow.noun.clone(), hops))
        });
        let charts = spec.charts.iter().map(|chart| ChartWatch::new(chart, &mut readings)).collect();
        ReportBuilder {
            from_initial: spec.counts_steps(),
            spec,
            readings,
            tick: 0,
            shown: SHOWN_TICKS,
            begun: false,
            activities,
            tasks,
            buffers,
            queues,
            series,
            flow,
            charts,
        }
    }

    /// Lets the lanes show this many ticks of the run.
    pub fn show_ticks(mut self, ticks: u64) -> ReportBuilder {
        self.shown = ticks.max(1);
        self
    }

    /// The terms to be evaluated in each state; [`ReportBuilder::set`] takes their index.
    pub fn terms(&self) -> &[String] {
        self.readings.terms()
    }

    /// From now on a term has this value. A term never set is undef.
    ///
    /// # Panics
    /// An index beyond the [`ReportBuilder::terms`].
    pub fn set(&mut self, term: usize, value: &str) {
        self.readings.set(term, value);
    }

    /// The values set are those of the initial state. Without this call, the first step also counts as the initial
    /// state.
    pub fn begin(&mut self) {
        self.start();
        if self.from_initial {
            self.step();
        }
    }

    fn start(&mut self) {
        let moment = Moment { readings: &self.readings, tick: 0, shown: true };
        self.tasks.iter_mut().for_each(|task| task.begin(&moment));
        self.buffers.iter_mut().for_each(|buffer| buffer.begin(&moment));
        for ((_, queue), spec) in self.queues.iter_mut().zip(&self.spec.queues) {
            queue.capacity = self.readings.number(spec.capacity.as_ref()).and_then(|n| u64::try_from(n).ok());
        }
        for ((_, series), spec) in self.series.iter_mut().zip(&self.spec.series) {
            series.bound = self.readings.number(spec.bound.as_ref());
        }
        self.readings.settle();
        self.begun = true;
    }

    /// The values set are those of the state after the next step.
    pub fn step(&mut self) {
        if !self.begun {
            self.from_initial = false;
            self.start();
        }
        let (tick, shown) = (self.tick, self.tick < self.shown);
        for task in &mut self.tasks {
            task.step(&Moment { readings: &self.readings, tick, shown }, &mut self.activities);
        }
        let moment = Moment { readings: &self.readings, tick, shown };
        self.buffers.iter_mut().for_each(|buffer| buffer.step(&moment));
        self.charts.iter_mut().for_each(|chart| chart.step(&moment));
        for (slot, queue) in &mut self.queues {
            let length = moment.readings.integer(*slot);
            if moment.shown {
                queue.length.push(tick, length);
            }
            if let Some(length) = length {
                queue.lengths.add(length.max(0) as u64, tick);
            }
        }
        for (slot, series) in &mut self.series {
            let value = moment.readings.level(*slot);
            if moment.shown {
                series.curve.push(tick, value);
            }
            if let Some(value) = value {
                series.values.add(value, tick);
            }
        }
        if let Some((slots, flow)) = &mut self.flow {
            // From the sink backwards: in the step in which a hop gets a new datum, it hands on the old one.
            for (hop, slot) in slots.iter().enumerate().rev() {
                if let Some(datum) = self.readings.changed(*slot).then(|| self.readings.integer(*slot)).flatten() {
                    flow.reach(hop, datum, tick, self.shown);
                }
            }
        }
        self.readings.settle();
        self.tick += 1;
    }

    /// The run is over.
    pub fn finish(self, model: &str) -> Report {
        let ReportBuilder {
            spec,
            readings,
            tick,
            shown,
            from_initial,
            activities,
            tasks,
            buffers,
            queues,
            series,
            flow,
            charts,
            ..
        } = self;
        let now = |counters: &[CounterSpec]| -> Vec<(String, Option<i64>)> {
            counters.iter().map(|c| (c.label.clone(), readings.number(Some(&c.term)))).collect()
        };
        let moment = Moment { readings: &readings, tick, shown: false };
        let time = spec.tick_ns.map_or(TimeBase::steps(), TimeBase::new);
        let window = if spec.window == 0 { tick.min(400) } else { spec.window.min(tick) };
        Report {
            title: if spec.title.is_empty() { model.to_owned() } else { spec.title.clone() },
            note: spec.note.clone(),
            model: model.to_owned(),
            time,
            ticks: tick,
            from_initial: from_initial && tick > 0,
            shown: shown.min(tick),
            window: window.clamp(1, shown.max(1)),
            tasks: tasks.into_iter().map(|task| task.finish(&moment, &activities)).collect(),
            activities,
            buffers: buffers
                .into_iter()
                .zip(&spec.buffers)
                .map(|(buffer, spec)| buffer.finish(&moment, now(&spec.counters)))
                .collect(),
            queues: queues
                .into_iter()
                .zip(&spec.queues)
                .map(|((_, queue), spec)| Queue { counters: now(&spec.counters), ..queue })
                .collect(),
            series: series.into_iter().map(|(_, series)| series).collect(),
            flow: flow.map(|(_, mut flow)| {
                flow.finish(shown);
                flow
            }),
            charts: charts.into_iter().map(ChartWatch::finish).collect(),
            chart_style: spec.chart_style,
            invariants: Vec::new(),
            stopped: None,
            scenarios: Vec::new(),
            coverage: None,
            facts: Vec::new(),
        }
    }
}

fn new_queue(spec: &QueueSpec) -> Queue {
    Queue {
        from: spec.from.clone(),
        to: spec.to.clone(),
        kind: if spec.kind.is_empty() { "queue".to_owned() } else { spec.kind.clone() },
        length: Curve::default(),
        lengths: Tally::default(),
        capacity: None,
        counters: Vec::new(),
    }
}

fn new_series(spec: &SeriesSpec) -> Series {
    Series {
        name: spec.name.clone(),
        caption: spec.caption.clone(),
        curve: if spec.ticks { Curve::of_time() } else { Curve::default() },
        values: Levels::default(),
        ticks: spec.ticks,
        bound: None,
    }
}
