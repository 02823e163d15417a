//! Builds the graph of a program's states, for properties of its runs.
//!
//! In: a program, propositions, bounds. Out: a [`Graph`] and the states of its nodes. If propositions read inputs, a
//! state of the machine gets one node for each set of propositions that its inputs can make true, with the steps that
//! these inputs allow; all other inputs, and choices, belong to the step. Formulas that tell branches apart need more: a node for
//! each value of the inputs that they read. Of values that make the same true and lead to the same states one is kept, for all. A step that faults leads nowhere: the run
//! stays. A state with alternatives that cannot be enumerated counts as unexplored.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use explore::{Explorer, Interner, Numbered, Outcome, Path, Settings, Trouble, Truth, Widening};
use hashbrown::HashSet;
use machine::{Cause, Location, Value};
use program::{FunctionId, Program};
use rustc_hash::FxBuildHasher;
use syntax::Span;

use crate::explicit::edges::Besides;
use crate::graph::{Builder, Graph, Label, StateId};
use crate::progress::{Progress, Stop};
use crate::walk::Walk;

/// What the graph is built from.
#[derive(Debug, Clone)]
pub struct Source {
    /// The program. The last conditions of `settings` are the propositions.
    pub program: Arc<Program>,
    /// How steps are made.
    pub settings: Settings,
    /// The conditions on states that are assumptions.
    pub assumed: Vec<usize>,
    /// For each proposition, its condition.
    pub propositions: Vec<Place>,
    /// The functions whose values, where the environment gives them, tell nodes of one state apart; none if it is enough what they make
    /// true, since no formula tells branches apart.
    pub inputs: BTreeSet<FunctionId>,
    /// The rule that chooses who moves, if edges are labelled with its choice.
    pub scheduler: Option<Span>,
    /// The largest number of states.
    pub max_states: u64,
    /// The largest depth.
    pub max_depth: u64,
    /// The largest number of bytes.
    pub max_bytes: u64,
}

/// The condition of a proposition.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// An index into the conditions on states.
    State(usize),
    /// An index into the conditions on steps; the next one is its negation.
    Step(usize),
}

/// A graph and what its nodes stand for.
#[derive(Debug)]
pub struct Explored {
    /// The graph.
    pub graph: Graph,
    /// Repeats steps, to show them.
    pub explorer: Explorer,
    /// For each node of the graph: the state, and the number of its letter.
    pub nodes: Vec<(u32, u32)>,
    /// The states.
    pub states: Numbered,
    /// What tells the nodes of one state apart.
    pub(super) letters: Letters,
    /// The rule that chooses who moves, if edges are labelled with its choice.
    pub(super) scheduler: Option<Span>,
    /// For each label: the choice.
    pub choices: Vec<Vec<Value>>,
    /// For each proposition: a state in which it has no truth value, if there is one.
    pub undecided: Vec<Option<u32>>,
    /// Why it is not complete, if because of a limit.
    pub stop: Option<Stop>,
}

/// What the inputs of a state come to.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct Letter {
    /// The conditions on steps that fail, among the propositions and their negations.
    failed: Vec<u32>,
    /// The values of inputs that tell nodes apart.
    inputs: Vec<(Location, Value)>,
}

/// The letters of a graph, by their numbers.
#[derive(Debug, Default)]
pub(super) struct Letters {
    all: Vec<Letter>,
    numbers: BTreeMap<Letter, u32>,
    /// The first condition on steps that is a proposition.
    first_step: u32,
    /// The functions whose values count.
    inputs: BTreeSet<FunctionId>,
}

impl Letters {
    /// The letter of a step.
    fn of(&self, path: &Path) -> Letter {
        let failed = path.failed.iter().copied().filter(|condition| *condition >= self.first_step);
        let counts = |(location, _): &&(Location, Value)| self.inputs.contains(&location.function);
        let mut inputs: Vec<(Location, Value)> = path.inputs.iter().filter(counts).cloned().collect();
        inputs.sort();
        Letter { failed: failed.collect(), inputs }
    }

    /// Whether a repeated step has the letter of this number.
    pub(super) fn is_of(&self, number: u32, path: &Path) -> bool {
        self.all.get(number as usize).is_none_or(|letter| *letter == self.of(path))
    }
}

/// A step of a state: its letter, its target, its label.
type Row = (u32, u32, u32);

/// Explores the states, unless a search has just done so; `watch` receives progress and tells whether to go on.
///
/// # Errors
/// There is no initial state.
pub fn explore(
    source: &Source,
    walk: Option<Walk>,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Explored, Trouble> {
    if let Some(exploration) = walk.and_then(|walk| Exploration::walked(source, walk)) {
        return Ok(exploration.graph());
    }
    let mut widening = Widening::default();
    loop {
        let interner = Arc::new(Interner::default());
        let explorer = match Explorer::new(&source.program, source.settings.clone(), &widening, &interner) {
            Err(Trouble::TooNarrow(wider)) => {
                widening.merge(&wider);
                continue;
            }
            other => other?,
        };
        match Exploration::new(source, explorer).run(watch) {
            Ok(explored) => return Ok(explored),
            Err(wider) => widening.merge(&wider),
        }
    }
}

struct Exploration<'s> {
    source: &'s Source,
    explorer: Explorer,
    states: Numbered,
    depths: Vec<u32>,
    initial: usize,
    rows: Vec<Row>,
    /// For each explored state, where its rows end.
    ends: Vec<usize>,
    cut: Vec<bool>,
    letters: Letters,
    choices: Vec<Vec<Value>>,
    choice: BTreeMap<Vec<Value>, u32>,
    undecided: Vec<Option<u32>>,
    stop: Option<Stop>,
}

impl<'s> Exploration<'s> {
    fn new(source: &'s Source, explorer: Explorer) -> Exploration<'s> {
        let steps = source.propositions.iter().filter_map(|place| match place {
            Place::Step(number) => Some(*number as u32),
            Place::State(_) => None,
        });
        Exploration {
            source,
            states: Numbered::new(explorer.words()),
            explorer,
            depths: Vec::new(),
            initial: 0,
            rows: Vec::new(),
            ends: Vec::new(),
            cut: Vec::new(),
            letters: Letters {
                first_step: steps.min().unwrap_or(u32::MAX),
                inputs: source.inputs.clone(),
                ..Letters::default()
            },
            choices: Vec::new(),
            choice: BTreeMap::new(),
            undecided: vec![None; source.propositions.len()],
            stop: None,
        }
    }

    /// One that a search has made, if it made it all, or came as far as this one would. Without letters and labels an edge is an edge.
    fn walked(source: &'s Source, walk: Walk) -> Option<Exploration<'s>> {
        let Walk { maker, explorer: walker, stop, graph } = walk;
        let explorer = maker.of(&source.program, source.settings.clone()).ok()?;
        let mut exploration = Exploration::new(source, explorer);
        let states = graph.ends.len() as u64;
        let far_enough = match stop {
            None | Some(Stop::Depth) => true,
            Some(Stop::States) => states >= source.max_states,
            Some(_) => false,
        };
        let plain = exploration.letters.first_step == u32::MAX && source.scheduler.is_none();
        if !plain || !far_enough || !exploration.explorer.packs_like(&walker) {
            return None;
        }
        drop(walker);
        exploration.stop = stop;
        exploration.initial = graph.initial;
        exploration.states = Numbered::listed(exploration.explorer.words(), graph.states);
        let mut start = 0;
        for (state, (end, besides)) in graph.ends.iter().zip(&graph.besides).enumerate() {
            let own = &graph.targets[start..*end];
            start = *end;
            let is_cut = besides.is_none_or(Besides::is_cut);
            if let Some(besides) = besides.filter(|_| !is_cut) {
                exploration.rows.extend(own.iter().map(|target| (0, *target, 0)));
                if besides.stays() {
                    exploration.rows.push((0, state as u32, 0));
                }
                if besides.faults() {
                    exploration.rows.push((0, state as u32, Label::STUTTER.0));
                }
            }
            exploration.cut.push(is_cut);
            exploration.ends.push(exploration.rows.len());
        }
        exploration.explorer.ignore_interrupts();
        Some(exploration)
    }

    fn run(mut self, watch: &mut dyn FnMut(&Progress) -> bool) -> Result<Explored, Widening> {
        self.prepare();
        let mut next = 0;
        while next < self.states.len() {
            if next % 4096 == 0 {
                self.stop = self.stop.or_else(|| (!watch(&self.progress(next))).then_some(Stop::Asked));
            }
            if let Some(cause) = self.source.settings.interrupt.cause() {
                self.stop = Some(cause.into());
            } else if (self.states.len() as u64) > self.source.max_states {
                self.stop = Some(Stop::States);
            } else if self.bytes() > self.source.max_bytes {
                self.stop = Some(Stop::Memory);
            }
            if self.stop.is_some() {
                break;
            }
            if u64::from(self.depths[next]) >= self.source.max_depth {
                // States are ordered by distance, so all further ones are as deep.
                self.stop = Some(Stop::Depth);
                break;
            }
            if !self.expand(next)? {
                let cause = self.source.settings.interrupt.cause().unwrap_or(Cause::Memory);
                self.stop = Some(cause.into());
                break;
            }
            next += 1;
        }
        // Findings are reported however long that takes.
        self.explorer.ignore_interrupts();
        Ok(self.graph())
    }

    /// Meets the initial states.
    fn prepare(&mut self) {
        let initial: Vec<Box<[u64]>> = self.explorer.initial().iter().map(|(state, _)| state.into()).collect();
        for state in initial {
            self.state(&state, 0);
        }
        self.initial = self.states.len();
    }

    fn progress(&self, next: usize) -> Progress {
        let depth = self.depths.get(next).copied().unwrap_or(0);
        Progress {
            states: self.states.len() as u64,
            transitions: self.rows.len() as u64,
            queue: (self.states.len() - next) as u64,
            depth: u64::from(depth),
            bytes: self.bytes(),
            ..Progress::default()
        }
    }

    fn bytes(&self) -> u64 {
        (self.states.bytes() + 16 * self.states.len() + self.rows.len() * size_of::<Row>()) as u64
    }

    /// The number of a state; `None` if an assumption is false in it.
    fn state(&mut self, state: &[u64], depth: u32) -> Option<u32> {
        if let Some(known) = self.states.find(state) {
            return Some(known);
        }
        for condition in &self.source.assumed {
            if self.explorer.truth(*condition, state) != Truth::True {
                return None;
            }
        }
        self.depths.push(depth);
        Some(self.states.push(state))
    }

    /// Returns `false` if the caller asked to stop before all alternatives were found.
    fn expand(&mut self, index: usize) -> Result<bool, Widening> {
        let state: Box<[u64]> = self.states.get(index as u32).into();
        let depth = self.depths[index] + 1;
        let start = self.rows.len();
        let mut cut = false;
        if self.letters.first_step == u32::MAX && self.source.scheduler.is_none() {
            let mut successors = Vec::new();
            let expansion = self.explorer.expand(&state, &mut successors)?;
            if expansion.interrupted {
                return Ok(false);
            }
            for successor in successors.chunks_exact(self.explorer.words()) {
                if let Some(target) = self.state(successor, depth) {
                    self.rows.push((0, target, 0));
                }
            }
            if expansion.stayed > 0 {
                self.rows.push((0, index as u32, 0));
            }
            if expansion.faults.iter().any(|faults| *faults > 0) {
                self.rows.push((0, index as u32, Label::STUTTER.0));
            }
            cut = expansion.unbounded > 0;
        } else {
            let Some(groups) = self.grouped(&state, depth, index as u32, &mut cut)? else { return Ok(false) };
            for Grouped { letter, rows } in groups {
                let letter = self.number_of(letter);
                self.rows.extend(rows.into_iter().map(|(target, label)| (letter, target, label)));
            }
        }
        if cut {
            self.rows.truncate(start);
        }
        // Without a step there are no inputs, so propositions about them are unknown.
        cut |= self.letters.first_step != u32::MAX && self.rows.len() == start;
        let own = &mut self.rows[start..];
        own.sort_unstable_by_key(|(letter, ..)| *letter);
        self.ends.push(self.rows.len());
        self.cut.push(cut);
        Ok(true)
    }

    /// The steps of a state by what its inputs come to; none if the caller asked to stop before all were found.
    fn grouped(
        &mut self,
        state: &[u64],
        depth: u32,
        index: u32,
        cut: &mut bool,
    ) -> Result<Option<Vec<Grouped>>, Widening> {
        // Of equivalent alternatives only one is kept, since there may be many.
        let (mut paths, mut seen) = (Vec::new(), HashSet::<_, FxBuildHasher>::default());
        let (scheduler, letters) = (self.source.scheduler, &self.letters);
        let whole = self.explorer.paths(state, &mut |mut path| {
            path.choices.retain(|choice| Some(choice.span) == scheduler);
            let next = match &path.outcome {
                Outcome::Next(next) => Some(next.clone()),
                _ => None,
            };
            let chosen: Vec<Vec<Value>> = path.choices.iter().map(|choice| choice.values.clone()).collect();
            let letter = letters.of(&path);
            let kept =
                (std::mem::discriminant(&path.outcome), next, path.failed.clone(), letter.inputs.clone(), chosen);
            if seen.insert(kept) {
                paths.push((letter, path));
            }
        })?;
        if !whole {
            return Ok(None);
        }
        let (mut groups, mut places): (Vec<Grouped>, BTreeMap<Letter, usize>) = (Vec::new(), BTreeMap::new());
        for (letter, path) in paths {
            // A step that is ruled out says nothing about propositions.
            let row = match &path.outcome {
                Outcome::Next(next) => match self.state(next, depth) {
                    Some(target) => (target, self.label_of(&path)),
                    None => continue,
                },
                Outcome::Fault(_) => (index, Label::STUTTER.0),
                Outcome::Unbounded(_) => {
                    *cut = true;
                    continue;
                }
                Outcome::Excluded => continue,
            };
            let place = *places.entry(letter).or_insert_with_key(|letter| {
                groups.push(Grouped { letter: letter.clone(), rows: Vec::new() });
                groups.len() - 1
            });
            groups[place].rows.push(row);
        }
        Ok(Some(apart(groups)))
    }

    /// The number of a letter.
    fn number_of(&mut self, letter: Letter) -> u32 {
        if self.letters.first_step == u32::MAX {
            return 0;
        }
        let next = self.letters.all.len() as u32;
        if let Some(known) = self.letters.numbers.get(&letter) {
            return *known;
        }
        for (proposition, place) in self.source.propositions.iter().enumerate() {
            if let Place::Step(condition) = place {
                let fails = |condition: usize| letter.failed.contains(&(condition as u32));
                if fails(*condition) == fails(*condition + 1) {
                    // The number of the state being explored.
                    self.undecided[proposition].get_or_insert(self.ends.len() as u32);
                }
            }
        }
        self.letters.numbers.insert(letter.clone(), next);
        self.letters.all.push(letter);
        next
    }

    fn label_of(&mut self, path: &Path) -> u32 {
        let Some(scheduler) = self.source.scheduler else { return 0 };
        let Some(choice) = path.choices.iter().find(|choice| choice.span == scheduler) else {
            return Label::STUTTER.0;
        };
        let next = self.choices.len() as u32;
        *self.choice.entry(choice.values.clone()).or_insert_with_key(|values| {
            self.choices.push(values.clone());
            next
        })
    }

    /// Builds the graph: a node for each state and letter.
    fn graph(mut self) -> Explored {
        let explored = self.ends.len();
        let rows_of = |state: usize| if state == 0 { 0 } else { self.ends[state - 1] };
        let mut nodes: Vec<(u32, u32)> = Vec::new();
        let mut first: Vec<u32> = Vec::with_capacity(self.states.len() + 1);
        for state in 0..self.states.len() {
            first.push(nodes.len() as u32);
            let mut last = None;
            if state < explored {
                for (letter, ..) in &self.rows[rows_of(state)..self.ends[state]] {
                    if last.replace(*letter) != Some(*letter) {
                        nodes.push((state as u32, *letter));
                    }
                }
            }
            if last.is_none() {
                nodes.push((state as u32, u32::MAX));
            }
        }
        first.push(nodes.len() as u32);
        let mut builder = Builder::new(self.source.propositions.len());
        for (number, place) in self.source.propositions.iter().enumerate() {
            if matches!(place, Place::Step(_)) {
                builder.unknown_where_unexplored(number);
            }
        }
        for (state, letter) in &nodes {
            let index = *state as usize;
            if index < self.initial {
                builder.initial();
            }
            let mut truths = Vec::with_capacity(self.source.propositions.len());
            for (number, place) in self.source.propositions.iter().enumerate() {
                truths.push(match place {
                    Place::State(condition) => match self.explorer.truth(*condition, self.states.get(*state)) {
                        Truth::True => true,
                        Truth::False => false,
                        Truth::Undef | Truth::Fault | Truth::Unknown => {
                            self.undecided[number].get_or_insert(index as u32);
                            false
                        }
                    },
                    Place::Step(condition) => {
                        let letter = self.letters.all.get(*letter as usize);
                        letter.is_some_and(|letter| !letter.failed.contains(&(*condition as u32)))
                    }
                });
            }
            if index >= explored || self.cut[index] {
                builder.unexplored_state(truths);
                continue;
            }
            let start = if index == 0 { 0 } else { self.ends[index - 1] };
            for (own, target, label) in &self.rows[start..self.ends[index]] {
                if own == letter {
                    let targets = first[*target as usize]..first[*target as usize + 1];
                    targets.for_each(|target: StateId| builder.edge(target, Label(*label)));
                }
            }
            builder.state(truths);
        }
        Explored {
            graph: builder.finish(),
            explorer: self.explorer,
            nodes,
            states: self.states,
            letters: self.letters,
            scheduler: self.source.scheduler,
            choices: self.choices,
            undecided: self.undecided,
            stop: self.stop,
        }
    }
}

/// The steps of a state, each with its target and its label, that some inputs allow.
struct Grouped {
    letter: Letter,
    rows: Vec<(u32, u32)>,
}

/// Those of which no other makes the same true and allows the same steps: nothing tells such two apart.
fn apart(mut groups: Vec<Grouped>) -> Vec<Grouped> {
    let mut seen = BTreeSet::new();
    groups.retain(|group| {
        let mut rows = group.rows.clone();
        rows.sort_unstable();
        seen.insert((group.letter.failed.clone(), rows))
    });
    groups
}

#[cfg(test)]
mod tests;
