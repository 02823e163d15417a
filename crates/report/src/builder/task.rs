//! Watches one task: its activity, its waiting, its cycles and deadlines.

use super::Moment;
use super::reading::{Reading, Readings, Slot};
use crate::report::Task;
use crate::spec::TaskSpec;
use crate::tally::Tally;
use crate::tone::Tone;
use crate::track::{Kind, Track};

#[derive(Debug)]
pub(super) struct TaskWatch {
    activity: Slot,
    period: Option<Slot>,
    deadline: Option<Slot>,
    may_miss: Option<(Slot, Reading)>,
    release: Option<Slot>,
    cycles: Option<Slot>,
    met: Option<Slot>,
    missed: Option<Slot>,
    skipped: Option<Slot>,
    /// Value → index of its activity.
    known: Vec<(Reading, u16)>,
    /// A period has begun, and its cycle is not completed.
    open: bool,
    /// Ticks waited so far.
    waiting: u64,
    completed_at: Option<u64>,
    /// It has been idle: its cycles begin when it is so no longer.
    idles: bool,
    /// Since when it has not been idle.
    begun_at: Option<u64>,
    task: Task,
}

impl TaskWatch {
    /// `values`: the activities that the specification names.
    pub fn new(spec: &TaskSpec, values: &[Reading], readings: &mut Readings) -> TaskWatch {
        let task = Task {
            name: spec.name.clone(),
            caption: spec.caption.clone(),
            period: None,
            deadline: None,
            may_miss: false,
            track: Track::default(),
            shares: Vec::new(),
            waits: Tally::default(),
            cycles: Tally::default(),
            completed: None,
            met: None,
            missed: None,
            skipped: None,
            overdue: None,
            releases: Vec::new(),
            misses: Vec::new(),
        };
        TaskWatch {
            activity: readings.slot(&spec.activity),
            period: readings.optional(spec.period.as_ref()),
            deadline: readings.optional(spec.deadline.as_ref()),
            may_miss: readings.optional(spec.may_miss.as_ref()).map(|slot| (slot, readings.read("true"))),
            release: readings.optional(spec.release.as_ref()),
            cycles: readings.optional(spec.cycles.as_ref()),
            met: readings.optional(spec.met.as_ref()),
            missed: readings.optional(spec.missed.as_ref()),
            skipped: readings.optional(spec.skipped.as_ref()),
            known: values.iter().enumerate().map(|(index, value)| (*value, index as u16)).collect(),
            open: false,
            waiting: 0,
            completed_at: None,
            idles: false,
            begun_at: None,
            task,
        }
    }

    pub fn begin(&mut self, moment: &Moment) {
        let length = |slot: Option<Slot>| {
            let ticks = slot.and_then(|slot| moment.readings.integer(slot)).and_then(|ticks| u64::try_from(ticks).ok());
            ticks.filter(|ticks| *ticks > 0)
        };
        self.task.period = length(self.period);
        self.task.deadline = length(self.deadline);
        self.task.may_miss = self.may_miss.is_some_and(|(slot, holds)| moment.readings.value(slot) == Some(holds));
        if self.period.is_some() && self.task.period.is_none() {
            // Other tasks of this kind have periods; this one has none, so it has neither releases nor deadlines.
            (self.release, self.met, self.missed) = (None, None, None);
        }
        self.note_release(moment);
    }

    pub fn step(&mut self, moment: &Moment, activities: &mut Vec<Kind>) {
        let kind = self.kind(moment.readings, activities);
        if moment.shown {
            self.task.track.push(moment.tick, kind);
        }
        if let Some(kind) = kind {
            self.task.shares.resize(activities.len(), 0);
            self.task.shares[kind as usize] += 1;
        }
        if kind.is_some_and(|kind| activities[kind as usize].tone == Tone::Wait) {
            self.waiting += 1;
        } else {
            self.end_waiting(moment.tick);
        }
        let begun_at = self.begun_at;
        if kind.is_some_and(|kind| activities[kind as usize].tone == Tone::Idle) {
            (self.idles, self.begun_at) = (true, None);
        } else {
            self.begun_at.get_or_insert(moment.tick);
        }
        self.note_completion(moment, begun_at);
        if self.release.is_some_and(|slot| moment.readings.changed(slot)) {
            self.note_release(moment);
        }
    }

    /// The index of the present activity; a value seen for the first time becomes an activity.
    fn kind(&mut self, readings: &Readings, activities: &mut Vec<Kind>) -> Option<u16> {
        let Some(value) = readings.value(self.activity) else {
            return Some(undef(activities));
        };
        if let Some((_, index)) = self.known.iter().find(|(known, _)| *known == value) {
            return Some(*index);
        }
        let label = readings.text(self.activity).to_lowercase().replace('_', " ");
        let index = activities.iter().position(|kind| kind.label == label).unwrap_or_else(|| {
            activities.push(Kind { label, tone: Tone::by_order(activities.len()) });
            activities.len() - 1
        });
        self.known.push((value, index as u16));
        Some(index as u16)
    }

    fn end_waiting(&mut self, tick: u64) {
        if self.waiting > 0 {
            self.task.waits.add(self.waiting, tick - self.waiting);
            self.waiting = 0;
        }
    }

    /// A cycle ends in the step that counts it; when it was released, or had begun, is that of the state before.
    fn note_completion(&mut self, moment: &Moment, begun_at: Option<u64>) {
        let grew = |slot: Option<Slot>| {
            slot.is_some_and(|slot| {
                let readings = moment.readings;
                readings.integer(slot) > readings.integer_before(slot) && readings.integer_before(slot).is_some()
            })
        };
        let late = grew(self.missed);
        if late && moment.shown {
            self.task.misses.push(moment.tick);
        }
        if !late && !grew(self.met) && !grew(self.cycles) {
            return;
        }
        let begin = match self.release {
            Some(release) => moment.readings.integer_before(release).and_then(|tick| u64::try_from(tick).ok()),
            None if self.idles && self.task.period.is_none() => begun_at.or(self.completed_at),
            None => self.completed_at,
        };
        if let Some(begin) = begin.filter(|begin| *begin <= moment.tick) {
            self.task.cycles.add(moment.tick - begin, begin);
        }
        self.completed_at = Some(moment.tick);
        self.open = false;
    }

    fn note_release(&mut self, moment: &Moment) {
        let release = self.release.and_then(|slot| moment.readings.integer(slot));
        let Some(release) = release.and_then(|tick| u64::try_from(tick).ok()) else { return };
        self.open = true;
        if moment.shown {
            self.task.releases.push(release);
        }
    }

    pub fn finish(mut self, moment: &Moment, activities: &[Kind]) -> Task {
        self.end_waiting(moment.tick);
        let natural = |slot: Option<Slot>| slot.and_then(|slot| moment.readings.integer(slot)).map(|n| n.max(0) as u64);
        if let (Some(release), Some(allowed), true) = (natural(self.release), self.task.allowed(), self.open) {
            self.task.overdue = moment.tick.checked_sub(release + allowed).filter(|late| *late > 0);
        }
        self.task.completed = natural(self.cycles);
        self.task.met = natural(self.met);
        self.task.missed = natural(self.missed);
        self.task.skipped = natural(self.skipped);
        self.task.shares.resize(activities.len(), 0);
        self.task.track.kinds = activities.to_vec();
        self.task
    }
}

/// The index of the activity that stands for no value.
fn undef(activities: &mut Vec<Kind>) -> u16 {
    let known = activities.iter().position(|kind| kind.tone == Tone::Undef);
    let index = known.unwrap_or_else(|| {
        activities.push(Kind { label: "undef".to_owned(), tone: Tone::Undef });
        activities.len() - 1
    });
    index as u16
}
