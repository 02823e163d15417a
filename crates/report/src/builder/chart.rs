//! A chart: where each machine is in its picture, tick by tick.

use super::Moment;
use super::reading::{Reading, Readings, Slot};
use crate::report::{Chart, Lights};
use crate::spec::{ChartSpec, LightsSpec};
use crate::tone::Tone;
use crate::track::{Kind, Track};

/// Collects a chart.
#[derive(Debug)]
pub(super) struct ChartWatch {
    chart: Chart,
    watches: Vec<Watch>,
}

#[derive(Debug)]
struct Watch {
    term: Slot,
    /// A condition, and what it reads when it holds.
    when: Option<(Slot, Reading)>,
    values: Vec<Reading>,
}

impl ChartWatch {
    pub fn new(spec: &ChartSpec, readings: &mut Readings) -> ChartWatch {
        let watches = spec.lights.iter().map(|lights| Watch {
            term: readings.slot(&lights.term),
            when: lights.when.as_ref().map(|when| (readings.slot(when), readings.read("true"))),
            values: lights.parts.iter().map(|part| readings.read(&part.value)).collect(),
        });
        let watches = watches.collect();
        let chart = Chart {
            title: spec.title.clone(),
            picture: spec.picture.clone(),
            lights: spec.lights.iter().map(lights).collect(),
            named: spec.named,
        };
        ChartWatch { chart, watches }
    }

    pub fn step(&mut self, moment: &Moment) {
        for (watch, lights) in self.watches.iter().zip(&mut self.chart.lights) {
            if watch.when.is_some_and(|(slot, holds)| moment.readings.value(slot) != Some(holds)) {
                continue;
            }
            let Some(value) = moment.readings.value(watch.term) else { continue };
            let Some(part) = watch.values.iter().position(|known| *known == value) else { continue };
            lights.shares[part] += 1;
            if moment.shown {
                lights.track.push(moment.tick, u16::try_from(part).ok());
            }
        }
    }

    pub fn finish(self) -> Chart {
        self.chart
    }
}

fn lights(spec: &LightsSpec) -> Lights {
    let kinds = spec.parts.iter().map(|part| Kind { label: part.label.clone(), tone: Tone::Work }).collect();
    Lights {
        name: spec.name.clone(),
        parts: spec.parts.iter().map(|part| part.part.clone()).collect(),
        track: Track::new(kinds),
        shares: vec![0; spec.parts.len()],
    }
}
