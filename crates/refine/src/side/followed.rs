//! A run of a machine that is followed: it makes the steps of this run, and no others.
//!
//! In: the inputs of a step, and the state that it is to lead to. Out: the step, if the machine makes such a one. So whatever is refuted is
//! refuted by steps that the machine makes. INVARIANT: where the run goes no further, it is not known what the machine does.

use std::collections::BTreeMap;
use std::rc::Rc;

use explore::{Outcome, Told, Unbounded, UnboundedKind};
use machine::{Location, Value};
use rustc_hash::FxHashMap;
use syntax::{FileId, Span};

use super::{Goal, Inputs, Move, Side, StateId, Stopped};
use crate::joint::Bridge;

/// Why a step of a run is not made.
#[derive(Debug)]
pub(crate) enum Unmade {
    /// The machine makes none of this kind.
    Odd,
    /// It chooses among what cannot be gone through.
    Unbounded(Unbounded),
    Stopped(Stopped),
}

/// The steps of a run, by the state that they begin in.
#[derive(Debug, Default)]
pub(super) struct Followed(FxHashMap<StateId, Vec<(Move, Told)>>);

impl Followed {
    /// Of a run that goes no further: what stands for all that is not looked at.
    pub const NOTHING: Unbounded =
        Unbounded { kind: UnboundedKind::Limit, span: Span { file: FileId(0), start: 0, end: 0 } };

    /// The steps of a state, if the run goes on there.
    pub fn moves(&self, state: StateId) -> Option<Rc<[Move]>> {
        self.0.get(&state).map(|made| made.iter().map(|(made, _)| *made).collect())
    }

    /// All there is to say of a step.
    pub fn told(&self, from: StateId, wanted: &Move) -> Option<Told> {
        let made = self.0.get(&from)?;
        made.iter().find(|(made, _)| made == wanted).map(|(_, told)| told.clone())
    }

    fn add(&mut self, from: StateId, made: Move, told: Told) {
        let of = self.0.entry(from).or_default();
        if !of.iter().any(|(other, _)| *other == made) {
            of.push((made, told));
        }
    }
}

impl Side<'_> {
    /// Makes a step of a run with these inputs, to a state in which locations have the values that are `wanted`, or to a fault; and follows
    /// the run from now on: no steps are made but those of runs that were followed.
    pub fn follow(
        &mut self,
        state: StateId,
        values: &BTreeMap<Location, Value>,
        wanted: Option<&[(Location, Value)]>,
        given: &[(u32, u32)],
        inputs: &mut Inputs,
        bridge: &Bridge,
    ) -> Result<Option<StateId>, Unmade> {
        self.stepper.explorer.give(values.clone());
        let made = self.followed_by(state, wanted, given, inputs, bridge);
        self.stepper.explorer.give(BTreeMap::new());
        made
    }

    fn followed_by(
        &mut self,
        state: StateId,
        wanted: Option<&[(Location, Value)]>,
        given: &[(u32, u32)],
        inputs: &mut Inputs,
        bridge: &Bridge,
    ) -> Result<Option<StateId>, Unmade> {
        let packed = self.packed(state);
        let most = self.most;
        let (paths, whole) = self.stepper.paths(&packed, most, bridge);
        match whole {
            Ok(true) => {}
            Err(widening) => return Err(Unmade::Stopped(Stopped::Narrow(self.place, widening))),
            Ok(false) => return Err(Unmade::Stopped(Stopped::Interrupted)),
        }
        let mut why = match paths.len() as u64 > most {
            true => Unmade::Stopped(Stopped::Many),
            false => Unmade::Odd,
        };
        for (path, values) in paths {
            let goal = match (&path.outcome, wanted) {
                (Outcome::Next(next), Some(wanted)) if self.stepper.is_assumed(next) && self.has(next, wanted) => {
                    Goal::State(self.number(next))
                }
                (Outcome::Fault(fault), None) if fault.kind.is_of_the_model() && !self.stepper.is_end(fault) => {
                    Goal::Fault(self.faults.number(self.stepper.told(fault)))
                }
                (Outcome::Unbounded(unbounded), _) => {
                    why = Unmade::Unbounded(*unbounded);
                    continue;
                }
                _ => continue,
            };
            let label = self.label(&path.inputs, values, given, inputs, bridge);
            let told = self.stepper.tell(&packed, &path.picks, bridge);
            let to = if let Goal::State(to) = goal { Some(to) } else { None };
            let made = Move { label, goal };
            self.followed.get_or_insert_with(Followed::default).add(state, made, told);
            return Ok(to);
        }
        Err(why)
    }

    /// Whether locations have these values in a state.
    fn has(&mut self, state: &[u64], wanted: &[(Location, Value)]) -> bool {
        let values: FxHashMap<Location, Value> = self.stepper.explorer.values(state).into_iter().collect();
        wanted.iter().all(|(location, value)| *values.get(location).unwrap_or(&Value::Undef) == *value)
    }
}
