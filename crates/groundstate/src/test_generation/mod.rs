//! Generates tests from a model: scenarios that reach its rules, branches, updates, conditions and transitions.
//!
//! In: a loaded model and a method of search. Out: [`Generated`] scenarios as texts, and for each [`Goal`] whether they
//! reach it. INVARIANT: only steps that can be made, in states that satisfy every invariant, reach a goal, so the
//! scenarios pass.

mod cover;
mod goals;
mod kept;
mod turns;
mod write;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use model::Model;
use program::Program;
use simulate::SplitMix;
use syntax::FileId;
use verify::survey::{Sighting, Walk, Wanderer, survey};
use verify::{NoStart, Options, Progress, Reason};

use cover::{Candidate, cover};
use goals::{Need, goals, needs_met};

pub use goals::{Goal, GoalKind, Turn};
pub use kept::{Shown, Trial};
pub use turns::chart_turns;

/// How to search for goals.
#[derive(Debug, Clone, Copy)]
pub enum Method {
    /// Explore all states breadth-first.
    Search,
    /// Make random walks: the number of walks, the steps of each, the seed.
    Random(u64, usize, u64),
}

/// A generated scenario.
#[derive(Debug, Clone)]
pub struct Generated {
    /// Its name.
    pub name: String,
    /// Its text.
    pub text: String,
    /// How many steps it makes.
    pub steps: usize,
    /// What its steps show of what is wanted.
    meets: BTreeSet<Need>,
}

/// Tests of a model.
#[derive(Debug, Clone)]
pub struct Tests {
    /// The scenarios.
    pub scenarios: Vec<Generated>,
    /// What there is to reach, in the order of the text.
    pub goals: Vec<Goal>,
    /// How far the search came; `None` for random walks.
    pub progress: Option<Progress>,
    /// Why goals that were not reached may still be reachable; empty if every state was explored.
    pub reasons: Vec<Reason>,
}

impl Tests {
    /// From now on a scenario shows this and nothing else. Whether that is more than the `kept` ones show.
    pub fn settle(&mut self, index: usize, shown: Shown, kept: &[usize]) -> bool {
        let before: BTreeSet<&Need> = kept.iter().flat_map(|index| &self.scenarios[*index].meets).collect();
        let is_more = shown.0.iter().any(|need| !before.contains(need));
        let met = |goal: &&Goal| goal.reached && goal.needs.iter().any(|need| shown.0.contains(need));
        let goals = self.goals.iter().filter(met).count();
        let generated = &mut self.scenarios[index];
        if generated.meets != shown.0 {
            let rest = generated.text.split_once('\n').map_or("", |(_, rest)| rest);
            generated.text = format!("{}\n{rest}", write::headline(goals));
            generated.meets = shown.0;
        }
        is_more
    }

    /// By goal, whether the scenarios of these numbers reach it.
    pub fn reached_by(&self, kept: &[usize]) -> Vec<bool> {
        let met: BTreeSet<&Need> = kept.iter().flat_map(|index| &self.scenarios[*index].meets).collect();
        self.goals.iter().map(|goal| goal.reached && goal.needs.iter().all(|need| met.contains(need))).collect()
    }
}

/// The model to generate tests for.
#[derive(Debug, Clone, Copy)]
pub struct Subject<'a> {
    /// The model.
    pub model: &'a Model,
    /// The program.
    pub program: &'a Arc<Program>,
    /// The transitions of its charts.
    pub turns: &'a [Turn],
    /// The path that scenarios load the model by.
    pub path: &'a str,
}

/// Generates tests for the parts of a model in files that `own` accepts.
///
/// # Errors
/// There is no initial state.
pub fn generate_tests(
    subject: Subject<'_>,
    options: &Options,
    method: Method,
    own: &dyn Fn(FileId) -> bool,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Tests, NoStart> {
    let Subject { model, program, turns, .. } = subject;
    let (candidates, goals, progress, reasons) = match method {
        Method::Search => {
            let mut survey = survey(program, options, true, watch)?;
            let goals = goals(model, program, turns, own, &survey.sightings);
            let mut first: BTreeMap<&Need, &Sighting> = BTreeMap::new();
            let needs: Vec<(Need, Sighting)> = survey
                .sightings
                .iter()
                .filter(|sighting| sighting.made)
                .flat_map(|sighting| needs_met(program, sighting.observation).map(|need| (need, sighting.clone())))
                .collect();
            let wanted: BTreeSet<&Need> =
                goals.iter().filter(|goal| goal.reached).flat_map(|goal| &goal.needs).collect();
            for (need, sighting) in needs.iter().filter(|(need, _)| wanted.contains(need)) {
                first.entry(need).or_insert(sighting);
            }
            // One sighting may be the first of several needs; its walk is made once.
            let mut walked: Vec<&Sighting> = Vec::new();
            for sighting in first.into_values() {
                if !walked.iter().any(|other| other.same_step(sighting)) {
                    walked.push(sighting);
                }
            }
            let walks: Vec<Walk> = walked.into_iter().map(|sighting| survey.walk(sighting)).collect();
            (walks, goals, Some(survey.progress), survey.reasons)
        }
        Method::Random(walks, steps, seed) => {
            let mut wanderer = Wanderer::new(program, options, true)?;
            let mut random = SplitMix::new(seed);
            let mut draw = |of: usize| random.below(of as u64) as usize;
            let walks: Vec<Walk> = (0..walks).map(|_| wanderer.walk(steps, &mut draw)).collect();
            let seen = walks.iter().flat_map(|walk| walk.happens.iter().flatten()).copied();
            let sightings: Vec<Sighting> = seen.map(Sighting::at_random).collect();
            let goals = goals(model, program, turns, own, &sightings);
            (walks, goals, None, vec![Reason::Stopped(verify::Stop::Asked)])
        }
    };
    let wanted: BTreeSet<Need> =
        goals.iter().filter(|goal| goal.reached).flat_map(|goal| goal.needs.iter().copied()).collect();
    let candidates = candidates.into_iter().map(|walk| Candidate::new(program, walk, &wanted)).collect();
    let chosen = cover(candidates);
    let scenarios = chosen.iter().enumerate().map(|(index, candidate)| {
        let met = |goal: &&Goal| goal.reached && goal.needs.iter().any(|need| candidate.meets(need));
        write::scenario(&subject, index + 1, candidate, goals.iter().filter(met).count())
    });
    Ok(Tests { scenarios: scenarios.collect(), goals, progress, reasons })
}
