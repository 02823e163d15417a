//! MP7: controlled locations that no rule updates, and locations that no rule reads.
//!
//! Properties do not count as readers: what only they read does not affect runs; what initial values read does. Output functions (`out`) need not be
//! read. Functions with few locations are reported location by location, others as a whole.

use std::collections::BTreeSet;

use explore::UnboundedKind;
use machine::{Location, Observation, Value};
use model::FunctionKind;
use program::FunctionId;

use crate::review::{Matter, Meta, Reviewer};

/// LIMIT: functions with more locations are treated as a whole.
const LOCATIONS: usize = 1 << 12;

/// How the locations of one function were accessed.
#[derive(Default)]
struct Touched {
    any: bool,
    locations: BTreeSet<Location>,
}

impl Touched {
    fn add(&mut self, location: Option<Location>) {
        self.any = true;
        self.locations.extend(location);
    }
}

impl Reviewer<'_> {
    pub(super) fn locations(&mut self) {
        let count = self.program.functions.len();
        let (mut read, mut written): (Vec<Touched>, Vec<Touched>) =
            (0..count).map(|_| (Touched::default(), Touched::default())).unzip();
        for sighting in &self.survey.sightings {
            let location = |index: Option<u32>| index.map(|index| self.survey.location(index));
            match sighting.observation {
                Observation::Read(function, index) => read[function.0 as usize].add(location(index)),
                Observation::Wrote(function, index) if sighting.made => {
                    written[function.0 as usize].add(location(index))
                }
                _ => {}
            }
        }
        // A step that cannot be made for want of an input's values has read it.
        let unlisted: BTreeSet<FunctionId> = self
            .survey
            .unbounded()
            .iter()
            .filter_map(|one| match one.kind {
                UnboundedKind::Input(function) => Some(function),
                UnboundedKind::Choice | UnboundedKind::Clock | UnboundedKind::Limit | UnboundedKind::Assumption => None,
            })
            .collect();
        let decide_beginnings = self.read_by_initials();
        for index in 0..count {
            let (id, function) = (FunctionId(index as u32), &self.program.functions[index]);
            if function.library || function.element.is_some() || !self.is_own(function.span) {
                continue;
            }
            use FunctionKind::{Controlled, Monitored, Out, Shared};
            let (span, kind) = (function.span, function.kind);
            let all = self.all_locations(id);
            let numbered = !all.is_empty() && all.iter().all(|location| self.survey.is_numbered(location));
            if matches!(kind, Controlled | Out)
                && let Some(never) = never(&all, numbered, &written[index])
            {
                self.find(Meta::LocationUsed, Matter::NeverUpdated(id, never), span);
            }
            if matches!(kind, Controlled | Monitored | Shared)
                && !decide_beginnings.contains(&id)
                && !unlisted.contains(&id)
                && let Some(never) = never(&all, numbered, &read[index])
            {
                self.find(Meta::LocationUsed, Matter::NeverRead(id, never), span);
            }
        }
    }

    /// The locations of a function, if they are few.
    pub(super) fn all_locations(&mut self, function: FunctionId) -> Vec<Location> {
        let mut tuples: Vec<Vec<Value>> = vec![Vec::new()];
        for parameter in &self.program.function(function).parameters {
            let Some(elements) = self.survey.elements(*parameter, LOCATIONS) else { return Vec::new() };
            if tuples.len() * elements.len() > LOCATIONS {
                return Vec::new();
            }
            let longer = |tuple: &Vec<Value>| {
                let tuple = tuple.clone();
                elements.clone().into_iter().map(move |element| tuple.iter().cloned().chain([element]).collect())
            };
            tuples = tuples.iter().flat_map(longer).collect();
        }
        tuples.into_iter().map(|arguments| Location { function, arguments }).collect()
    }
}

/// The locations that were not accessed; `None` if there are none. An empty list stands for all. Those without a permanent number are not told
/// apart; where all that are declared have one, they are none of these.
fn never(all: &[Location], numbered: bool, touched: &Touched) -> Option<Vec<Location>> {
    if !touched.any {
        return Some(Vec::new());
    }
    if touched.locations.is_empty() && !numbered {
        return None;
    }
    let never: Vec<Location> = all.iter().filter(|location| !touched.locations.contains(location)).cloned().collect();
    (!never.is_empty()).then_some(never)
}
