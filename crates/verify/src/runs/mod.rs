//! Properties of runs: decides the temporal formulas of a program on its state graph.
//!
//! In: a program and how its steps are made. Out: an outcome for each CTLSPEC and LTLSPEC, with a run in steps if one
//! is violated. INVARIANT: Holds is returned only if the graph is complete, every proposition has a truth value in
//! every state, and some run is fair.
//!
//! This is no `engine::Engine`. An engine is asked which targets, each a state or a step, are reachable,
//! and may stop at the first path to one. A formula is a question about the whole graph with its fairness: its witness
//! is an endless run or only the beginning of a branching one, and why it is unknown depends on propositions and on
//! runs. As targets, formulas would leave most of `Ended` empty here, and every other engine would have to refuse them.

mod apart;
mod close;
pub(crate) mod outcome;
mod scheduler;
mod states;

use std::collections::{BTreeMap, BTreeSet};
use std::ops::ControlFlow;
use std::sync::Arc;

use explore::{Outcome as Came, Settings, Told, Trouble};
use program::{FunctionId, FunctionKind, Program};
use syntax::Span;

use crate::graph::{Label, StateSet};
use crate::progress::{Progress, Stop};
use crate::temporal::budget::{Allowance, Budget, Spent};
use crate::temporal::checker::Checker;
use crate::temporal::fairness::{AgentFairness, Fairness};
use crate::temporal::formula::{Ctl, CtlFormulas, FormulaId};
use crate::temporal::ltl::propositions;
use crate::temporal::read::{Formula, Properties, read_each};
use crate::temporal::run::Run;
use crate::temporal::{FormulaVerdict, decide_ctl, decide_ltl};
use crate::trace::Trace;
use crate::walk::Walk;
use apart::{Group, groups};
use states::{Explored, Place, Source, explore};

pub use outcome::{OfRuns, Why};
pub use scheduler::scheduler;

/// How the runs of a program are explored.
#[derive(Debug, Clone, Default)]
pub struct RunPlan {
    /// Settings of steps: bounds, and conditions including the assumptions.
    pub settings: Settings,
    /// The conditions on states that are assumptions.
    pub assumed: Vec<usize>,
    /// The assumed fairness of the choice of who moves.
    pub agents: Option<AgentFairness>,
    /// The largest number of states.
    pub max_states: u64,
    /// The largest depth.
    pub max_depth: u64,
    /// The largest number of bytes.
    pub max_bytes: u64,
    /// Whether one violation suffices.
    pub first: bool,
}

/// Decides all temporal properties of a program, keyed by index.
///
/// # Errors
/// There is no initial state.
pub fn decide(
    program: &Arc<Program>,
    plan: &RunPlan,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Vec<(usize, OfRuns)>, Trouble> {
    decide_after(program, plan, None, watch)
}

/// The same after a search of the program's states that may have kept what it walked.
pub(crate) fn decide_after(
    program: &Arc<Program>,
    plan: &RunPlan,
    mut walk: Option<Walk>,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Vec<(usize, OfRuns)>, Trouble> {
    let mut all = Vec::new();
    let mut is_enough = false;
    for Group { program, places, reads_inputs } in groups(program) {
        // What was walked has no inputs in its states.
        let walk = if reads_inputs { None } else { walk.take() };
        let decided = match is_enough {
            true => each_formula(&program, &Why::Unexplored(Some(Stop::Found))),
            false => decide_together(&program, plan, walk, watch)?,
        };
        is_enough |= plan.first && decided.iter().any(|(_, answer)| matches!(answer, OfRuns::Violated(_)));
        all.extend(decided.into_iter().map(|(index, answer)| (places[index], answer)));
    }
    all.sort_by_key(|(index, _)| *index);
    Ok(all)
}

/// All formulas of a program as unknown.
fn each_formula(program: &Program, why: &Why) -> Vec<(usize, OfRuns)> {
    let formulas = program.properties.iter().enumerate().filter(|(_, property)| is_temporal(property.kind));
    formulas.map(|(index, _)| (index, OfRuns::Unknown(why.clone()))).collect()
}

fn is_temporal(kind: program::PropertyKind) -> bool {
    matches!(kind, program::PropertyKind::Ctl | program::PropertyKind::Ltl)
}

/// Decides the formulas of a program on one graph, in whose states the inputs are that any of them reads.
fn decide_together(
    program: &Arc<Program>,
    plan: &RunPlan,
    walk: Option<Walk>,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Vec<(usize, OfRuns)>, Trouble> {
    let all = |why: Why| each_formula(program, &why);
    if plan.agents.is_some() && scheduler(program).is_none() {
        return Ok(all(Why::NoScheduler));
    }
    let (properties, faults) = read_each(program);
    let mut unread: BTreeMap<usize, String> = BTreeMap::new();
    for (index, fault) in faults {
        let what = format!("{}: {}", fault.message, fault.primary.text);
        if !is_temporal(program.properties[index].kind) {
            return Ok(all(Why::Unread(what)));
        }
        unread.entry(index).or_insert(what);
    }
    let (source, unwritten) = source(program, plan, &properties);
    let properties = match without(properties, &unwritten, &mut unread) {
        Ok(properties) => properties,
        Err(why) => return Ok(all(why)),
    };
    let unread = unread.into_iter().map(|(index, what)| (index, OfRuns::Unknown(Why::Unread(what))));
    if properties.formulas.is_empty() {
        return Ok(unread.collect());
    }
    let mut explored = match explore(&source, walk, watch) {
        Err(Trouble::Interrupted(cause)) => return Ok(all(Why::Unexplored(Some(cause.into())))),
        explored => explored?,
    };
    let fairness = fairness(&explored, &properties, plan.agents);
    let progress = Progress {
        states: explored.states.len() as u64,
        transitions: explored.graph.edges() as u64,
        ..Progress::default()
    };
    let interrupt = plan.settings.interrupt.clone();
    let mut stop = || interrupt.is_raised() || !watch(&progress);
    let mut budget = Budget::new(Allowance::default(), &mut stop);
    let verdicts = verdicts(&explored, &fairness, &properties, plan.first, &mut budget);
    let spans: Vec<Span> = properties.propositions.iter().map(|proposition| proposition.span(program)).collect();
    let decided = verdicts.into_iter().map(|(index, verdict)| (index, told(verdict, &mut explored, &spans)));
    let mut all: Vec<(usize, OfRuns)> = decided.chain(unread).collect();
    all.sort_by_key(|(index, _)| *index);
    Ok(all)
}

fn verdicts(
    explored: &Explored,
    fairness: &Fairness,
    properties: &Properties,
    first: bool,
    budget: &mut Budget<'_>,
) -> Vec<(usize, Option<Result<FormulaVerdict, usize>>)> {
    let checker = Checker::new(&explored.graph, fairness, budget);
    let assumed = properties.justice.iter().chain(properties.compassion.iter().flat_map(|(p, q)| [p, q]));
    let assumed_undecided = assumed.into_iter().find(|number| explored.undecided[**number].is_some());
    let decide = |formula: Formula| {
        let speaks_of = speaks_of(properties, formula);
        let undecided =
            speaks_of.iter().map(|number| *number as usize).find(|number| explored.undecided[*number].is_some());
        if let Some(number) = assumed_undecided.copied().or(undecided) {
            return Err(number);
        }
        let checker = match &checker {
            Ok(checker) => checker,
            Err(ended) => return Ok(FormulaVerdict::Spent(ended.clone())),
        };
        Ok(match formula {
            Formula::Ltl(formula) => decide_ltl(checker, &properties.ltl, formula, budget),
            Formula::Ctl(formula) => decide_ctl(checker, &properties.ctl, formula, budget),
        })
    };
    let (mut decide, mut is_enough) = (decide, false);
    let mut unless_enough = |formula: Formula| {
        let verdict = (!is_enough).then(|| decide(formula));
        is_enough |= first && matches!(verdict, Some(Ok(FormulaVerdict::Violated { .. })));
        verdict
    };
    properties.formulas.iter().map(|(index, formula)| (*index, unless_enough(*formula))).collect()
}

fn told(verdict: Option<Result<FormulaVerdict, usize>>, explored: &mut Explored, propositions: &[Span]) -> OfRuns {
    let Some(verdict) = verdict else { return OfRuns::Unknown(Why::Unexplored(Some(Stop::Found))) };
    match verdict {
        Err(number) => {
            let state: Option<Box<[u64]>> = explored.undecided[number].map(|state| explored.states.get(state).into());
            let values = state.map(|state| explored.explorer.values(&state)).unwrap_or_default();
            OfRuns::Unknown(Why::NoTruth(propositions[number], values))
        }
        Ok(FormulaVerdict::Holds { vacuous: false }) => OfRuns::Holds,
        Ok(FormulaVerdict::Holds { vacuous: true }) => OfRuns::Unknown(Why::NoFairRun),
        Ok(FormulaVerdict::Violated { run, whole }) => {
            OfRuns::Violated(Box::new(Trace { branch: !whole, ..explored.trace(&run) }))
        }
        Ok(FormulaVerdict::Unexplored) => OfRuns::Unknown(Why::Unexplored(explored.stop)),
        Ok(FormulaVerdict::Spent(Spent::Stopped)) => OfRuns::Unknown(Why::Asked),
        Ok(FormulaVerdict::Spent(Spent::Limit { of, value })) => OfRuns::Unknown(Why::TooLarge(of, value)),
    }
}

/// The properties that can be decided; those with a value that cannot be written as a term are added to the unread
/// ones.
fn without(
    mut properties: Properties,
    unwritten: &BTreeSet<u32>,
    unread: &mut BTreeMap<usize, String>,
) -> Result<Properties, Why> {
    let what = "a value in it, of a set or a map, cannot be written down";
    let assumed = properties.justice.iter().chain(properties.compassion.iter().flat_map(|(p, q)| [p, q]));
    if assumed.into_iter().any(|number| unwritten.contains(&(*number as u32))) {
        return Err(Why::Unread(format!("an assumption about runs: {what}")));
    }
    let formulas = std::mem::take(&mut properties.formulas);
    for (index, formula) in formulas {
        if speaks_of(&properties, formula).iter().any(|number| unwritten.contains(number)) {
            unread.insert(index, what.to_string());
        } else {
            properties.formulas.push((index, formula));
        }
    }
    Ok(properties)
}

/// The propositions of a formula.
fn speaks_of(properties: &Properties, formula: Formula) -> Vec<u32> {
    match formula {
        Formula::Ltl(formula) => propositions(&properties.ltl, formula),
        Formula::Ctl(formula) => propositions_of_ctl(&properties.ctl, formula),
    }
}

/// Adds the propositions to the plan's conditions; those that cannot be written as terms become placeholders.
fn source(program: &Arc<Program>, plan: &RunPlan, properties: &Properties) -> (Source, BTreeSet<u32>) {
    let mut extended = (**program).clone();
    let mut settings = plan.settings.clone();
    let (mut places, mut unwritten, mut inputs) = (Vec::new(), BTreeSet::new(), BTreeSet::new());
    for (number, proposition) in properties.propositions.iter().enumerate() {
        let expression = close::closed(&mut extended, proposition).unwrap_or_else(|| {
            unwritten.insert(number as u32);
            close::truth(&mut extended, proposition)
        });
        if extended.reads_monitored(&expression) {
            settings.in_pairs_from.get_or_insert(settings.step_conditions.len());
            places.push(Place::Step(settings.step_conditions.len()));
            let given = |function: &FunctionId| {
                matches!(extended.function(*function).kind, FunctionKind::Monitored | FunctionKind::Shared)
            };
            inputs.extend(extended.reads_and_more(&expression).0.into_iter().filter(given));
            let negated = close::negated(&mut extended, &expression);
            settings.step_conditions.extend([(expression, false), (negated, false)]);
        } else {
            places.push(Place::State(settings.conditions.len()));
            settings.conditions.push(expression);
        }
    }
    // Runs that formulas of LTL speak of are the same whatever else the inputs are.
    if !properties.formulas.iter().any(|(_, formula)| matches!(formula, Formula::Ctl(_))) {
        inputs.clear();
    }
    let source = Source {
        inputs,
        scheduler: plan.agents.and_then(|_| scheduler(&extended)),
        program: Arc::new(extended),
        settings,
        assumed: plan.assumed.clone(),
        propositions: places,
        max_states: plan.max_states,
        max_depth: plan.max_depth,
        max_bytes: plan.max_bytes,
    };
    (source, unwritten)
}

fn fairness(explored: &Explored, properties: &Properties, agents: Option<AgentFairness>) -> Fairness {
    let graph = &explored.graph;
    let mut fairness = Fairness::none();
    for number in &properties.justice {
        fairness.add_justice(graph, graph.proposition(*number));
    }
    for (premise, conclusion) in &properties.compassion {
        fairness.add_compassion(graph, graph.proposition(*premise), graph.proposition(*conclusion));
    }
    if let Some(kind) = agents {
        for agent in 0..explored.choices.len() as u32 {
            let state = |node: u32| explored.nodes[node as usize].0;
            fairness.add_agent(graph, kind, |node, edge| {
                graph.label(edge) == Label(agent) && state(graph.target(edge)) != state(node)
            });
        }
    }
    fairness
}

/// The propositions of a formula of CTL.
fn propositions_of_ctl(formulas: &CtlFormulas, formula: FormulaId) -> Vec<u32> {
    let mut seen = StateSet::none(formulas.nodes().len());
    let mut found = BTreeSet::new();
    let mut open = vec![formula];
    while let Some(formula) = open.pop() {
        if !seen.insert(formula.0) {
            continue;
        }
        match formulas.node(formula) {
            Ctl::Constant(_) => {}
            Ctl::Proposition(number) => {
                found.insert(number);
            }
            Ctl::Not(p) | Ctl::ExistsNext(p) | Ctl::ExistsGlobally(p) => open.push(p),
            Ctl::And(p, q) | Ctl::ExistsUntil(p, q) => open.extend([p, q]),
        }
    }
    found.into_iter().collect()
}

impl Explored {
    /// A run in steps. Where no step of a state satisfies the assumptions, it ends.
    fn trace(&mut self, run: &Run) -> Trace {
        let nodes = run.states(&self.graph);
        let first: Box<[u64]> = self.states.get(self.nodes[nodes[0] as usize].0).into();
        let start = self.explorer.initial().iter().find(|(state, _)| **state == *first).map(|(_, start)| start);
        let start = start.map(|start| self.explorer.told_of_start(start)).unwrap_or_default();
        let values = self.explorer.values(&first);
        let mut trace = Trace { start, values, turn: run.turn, ..Trace::default() };
        for (pair, edge) in nodes.windows(2).zip(&run.edges) {
            match self.step(pair[0], pair[1], *edge) {
                Some(step) => trace.steps.push(step),
                None => {
                    (trace.turn, trace.ends) = (None, true);
                    break;
                }
            }
        }
        trace
    }

    /// The first alternative that an edge of the graph represents; none if the run stays because no alternative leads anywhere.
    fn step(&mut self, from: u32, to: u32, edge: usize) -> Option<Told> {
        let (state, letter) = self.nodes[from as usize];
        let target: Box<[u64]> = self.states.get(self.nodes[to as usize].0).into();
        let state: Box<[u64]> = self.states.get(state).into();
        let label = self.graph.label(edge);
        let chosen = self.choices.get(label.0 as usize);
        let (letters, scheduler) = (&self.letters, self.scheduler);
        let mut picks = None;
        // A successor that does not fit would have been reported before.
        let tried = self.explorer.paths_until(&state, &mut |path| {
            let leads = match &path.outcome {
                // A step that does not choose who moves has no label either.
                Came::Next(next) => {
                    let moves = path.choices.iter().any(|choice| Some(choice.span) == scheduler);
                    *next == target && (label != Label::STUTTER || scheduler.is_some() && !moves)
                }
                Came::Fault(_) => label == Label::STUTTER,
                Came::Unbounded(_) | Came::Excluded => false,
            };
            let is_chosen = chosen.is_none_or(|values| path.choices.iter().any(|choice| choice.values == *values));
            if leads && is_chosen && letters.is_of(letter, &path) {
                picks = Some(path.picks);
                return ControlFlow::Break(());
            }
            ControlFlow::Continue(())
        });
        match picks {
            Some(picks) => Some(self.explorer.tell(&state, &picks)),
            // The graph has such an edge where a state has no step, and all alternatives were tried. Any other edge that none makes is a
            // fault of the graph: such a run is not made again.
            None if label == Label::STUTTER && from == to && matches!(tried, Ok(true)) => None,
            None => Some(Told::default()),
        }
    }
}
