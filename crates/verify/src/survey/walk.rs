//! Walks: runs with all events in each of their steps.
//!
//! In: a sighting of a survey, or a source of random numbers. Out: a [`Walk`]. The walk to a sighting is a shortest
//! run; a random walk takes any alternative that succeeds. The caller decides what a walk is used for.

use std::sync::Arc;

use explore::{Explorer, Interner, Outcome, Trouble, Truth, Widening};
use machine::{Interrupt, Observation};
use program::Program;

use crate::explorers::widened;
use crate::options::Options;
use crate::plan::Plan;
use crate::report::NoStart;
use crate::survey::surveyor::{Sighting, Survey, plan_for};
use crate::trace::{Trace, picks_between, tell_way};

/// A run and its events.
#[derive(Debug, Clone, Default)]
pub struct Walk {
    /// The run.
    pub trace: Trace,
    /// All events of each step.
    pub happens: Vec<Vec<Observation>>,
}

impl Walk {
    fn push(&mut self, explorer: &mut Explorer, state: &[u64], picks: &[u32]) {
        self.trace.steps.push(explorer.tell(state, picks));
        self.happens.push(explorer.observe(state, picks));
    }
}

impl Survey {
    /// A shortest run whose last step contains a sighting.
    pub fn walk(&mut self, sighting: &Sighting) -> Walk {
        let places = self.places(sighting.state);
        let state = |survey: &Survey, place: u32| -> Box<[u64]> { survey.table.state(place as usize).into() };
        let first = state(self, places[0]);
        let mut walk = Walk { trace: tell_way(&mut self.explorer, &[first]), happens: Vec::new() };
        for pair in places.windows(2) {
            // Each state was discovered by one step, which many walks share.
            if !self.told.contains_key(&pair[1]) {
                let (from, to) = (state(self, pair[0]), state(self, pair[1]));
                let picks = picks_between(&mut self.explorer, &from, &to);
                let told = (self.explorer.tell(&from, &picks), self.explorer.observe(&from, &picks));
                self.told.insert(pair[1], told);
            }
            let (step, happens) = self.told[&pair[1]].clone();
            walk.trace.steps.push(step);
            walk.happens.push(happens);
        }
        let last = state(self, sighting.state);
        walk.push(&mut self.explorer, &last, &sighting.picks);
        walk
    }
}

/// Makes random walks.
#[derive(Debug)]
pub struct Wanderer {
    program: Arc<Program>,
    plan: Plan,
    widening: Widening,
    explorer: Explorer,
}

impl Wanderer {
    /// Makes walks through the states of a program. With `lawful`, states and steps that violate an invariant are
    /// skipped.
    ///
    /// # Errors
    /// There is no initial state.
    pub fn new(program: &Arc<Program>, options: &Options, lawful: bool) -> Result<Wanderer, NoStart> {
        let plan = plan_for(program, options, lawful);
        let mut used = Widening::default();
        let explorer = widened(|widening| {
            used = widening.clone();
            Explorer::new(program, plan.settings.clone(), widening, &Arc::new(Interner::default()))
        })?;
        let mut plan = plan;
        // The caller is asked between walks instead. If states do not fit, initial states are made again.
        plan.settings.interrupt = Interrupt::default();
        Ok(Wanderer { program: Arc::clone(program), plan, widening: used, explorer })
    }

    /// A walk with at most this many steps; `draw` returns a number below its argument. The walk ends early if no step
    /// succeeds.
    pub fn walk(&mut self, steps: usize, draw: &mut dyn FnMut(usize) -> usize) -> Walk {
        loop {
            match self.attempt(steps, draw) {
                Ok(walk) => return walk,
                Err(widening) => self.widen(&widening),
            }
        }
    }

    fn widen(&mut self, more: &Widening) {
        self.widening.merge(more);
        let interner = Arc::new(Interner::default());
        match Explorer::new(&self.program, self.plan.settings.clone(), &self.widening, &interner) {
            Ok(explorer) => self.explorer = explorer,
            Err(Trouble::TooNarrow(more)) => self.widen(&more),
            Err(_) => unreachable!("there was an initial state before"),
        }
    }

    fn attempt(&mut self, steps: usize, draw: &mut dyn FnMut(usize) -> usize) -> Result<Walk, Widening> {
        let starts: Vec<Box<[u64]>> = self.explorer.initial().iter().map(|(state, _)| state.into()).collect();
        let starts: Vec<Box<[u64]>> = starts.into_iter().filter(|state| self.admits(state)).collect();
        if starts.is_empty() {
            return Ok(Walk::default());
        }
        let mut state = starts[draw(starts.len())].clone();
        let mut walk = Walk { trace: tell_way(&mut self.explorer, &[state.clone()]), happens: Vec::new() };
        for _ in 0..steps {
            let mut paths = Vec::new();
            self.explorer.paths(&state, &mut |path| {
                if let Outcome::Next(next) = path.outcome {
                    paths.push((path.picks, next));
                }
            })?;
            paths.retain(|(_, next)| self.admits(next));
            if paths.is_empty() {
                break;
            }
            let (picks, next) = paths.swap_remove(draw(paths.len()));
            walk.push(&mut self.explorer, &state, &picks);
            state = next;
        }
        Ok(walk)
    }

    fn admits(&mut self, state: &[u64]) -> bool {
        let Wanderer { plan, explorer, .. } = self;
        plan.assumed.iter().chain(&plan.wanted).all(|condition| explorer.truth(*condition, state) == Truth::True)
    }
}
