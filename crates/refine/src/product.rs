//! The pairs of states that the game is played on, and for each pair what may happen from it.
//!
//! In: two sides and a [`Judge`]. Out: a [`Product`]: pairs of corresponding states, each with a tree of what the concrete machine does
//! and how the abstract one may answer. A tree ends in pairs. INVARIANT: a pair is in the coupling relation; a pair without a tree has
//! not been looked at.
//!
//! Inputs that both machines have are those of one environment. In a diagram an abstract step sees a value that the input had at some
//! concrete step of the diagram; an input at which no concrete step looked has any value, one for the whole diagram, and each must be
//! answered.

mod endless;
mod kept;

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use explore::{Start, Unbounded};
use machine::{Location, Value};
use program::FunctionId;
use rustc_hash::{FxHashMap, FxHashSet};

use crate::coupling::{FairTerm, number_of_fair};
use crate::judge::Judge;
use crate::readings::{Readings, Reads, ReadsId};
use crate::side::{Goal, Inputs, LabelId, Move, Side, StateId, Stopped, Unmade};
use crate::{ABSTRACT, CONCRETE};
use endless::Endless;

/// The number of a pair.
pub(crate) type PairId = u32;
/// The number of a node.
pub(crate) type NodeId = u32;

/// LIMIT: so many values of inputs that the concrete machine did not look at are tried in one place.
const VALUATIONS: usize = 1 << 12;

/// Why it is not known what happens.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum Unclear {
    /// A step of a side cannot be gone through.
    Unbounded(usize, Unbounded),
    /// A segment has more steps than a diagram may have.
    Long,
    /// There are too many values of inputs.
    Valuations,
    /// Bounds leave out values of an input of the abstract machine, with which it might have an answer.
    Bounded(FunctionId),
}

/// What may happen.
#[derive(Debug)]
pub(crate) enum Node {
    /// The concrete machine begins in one of its initial states, in their order; each must be answered.
    Begins(Box<[NodeId]>),
    /// It makes one of the steps of a state, in their order; each must be answered.
    Steps(StateId, Box<[NodeId]>),
    /// The inputs that it did not look at have some values; all must be answered.
    Inputs(Box<[NodeId]>),
    /// The diagram may end here, or go on.
    Choice([NodeId; 2]),
    /// The diagram ends after `n` concrete steps; each answer leads to a pair, after so many abstract steps.
    Answers(Answers),
    /// The concrete machine cannot make its step.
    Fault,
    /// It can go on for ever, and the segment does not end.
    Endless,
    /// Not known.
    Open(Unclear),
}

impl Node {
    /// What must all be answered, if that is what it says.
    pub fn all(&self) -> Option<&[NodeId]> {
        match self {
            Node::Begins(nodes) | Node::Steps(_, nodes) | Node::Inputs(nodes) => Some(nodes),
            Node::Choice(_) | Node::Answers(_) | Node::Fault | Node::Endless | Node::Open(_) => None,
        }
    }

    /// The nodes behind it.
    pub fn behind(&self) -> &[NodeId] {
        match self {
            Node::Choice(ways) => ways,
            _ => self.all().unwrap_or_default(),
        }
    }
}

/// See [`Node::Answers`].
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(crate) struct Answers {
    /// The concrete state that it ends in.
    pub to: StateId,
    pub reads: ReadsId,
    /// 0 at the beginning of the runs.
    pub n: u32,
    pub answers: Box<[(PairId, u32)]>,
    /// There may be more.
    pub unclear: Option<Unclear>,
}

/// A run of the abstract machine within a diagram.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(crate) struct AbstractRun {
    pub to: StateId,
    pub m: u32,
    /// The values of inputs that it needs and that the concrete machine did not look at.
    pub needs: Vec<(u32, u32)>,
}

/// All runs of the abstract machine within a diagram.
#[derive(Debug, Default)]
pub(crate) struct AbstractRuns {
    pub runs: Vec<AbstractRun>,
    pub unclear: Option<Unclear>,
    /// By input that was not looked at, the values that it may have.
    values: BTreeMap<u32, BTreeSet<u32>>,
    /// Why steps cannot be made.
    pub faults: BTreeSet<String>,
}

/// See the module.
pub(crate) struct Product<'c> {
    pub sides: [Side<'c>; 2],
    pub judge: Judge<'c>,
    pub inputs: Inputs,
    pub readings: Readings,
    pub pairs: Vec<(StateId, StateId)>,
    numbers: FxHashMap<(StateId, StateId), PairId>,
    pub trees: Vec<Option<NodeId>>,
    pub nodes: Vec<Node>,
    /// Diagrams that end alike end in one node.
    ends: FxHashMap<Answers, NodeId>,
    pub root: NodeId,
    /// The concrete state that the diagrams looked at begin in.
    at: StateId,
    /// What the abstract machine may do in them, with these inputs and so many steps.
    runs: FxHashMap<(StateId, ReadsId, u32), Rc<AbstractRuns>>,
    /// The abstract machine's initial states.
    pub initial: Vec<(LabelId, StateId, Start)>,
    /// The concrete machine's initial states.
    pub begun: Vec<(LabelId, StateId, Start)>,
    /// By condition of fairness: what stands in the label of a step in which it is true.
    met: Vec<(u32, u32)>,
    pub endless: Endless,
}

/// A state, the place of the one before it, and the step between them.
type Reached = (StateId, usize, Option<(StateId, Move)>);

type Memo = FxHashMap<(StateId, ReadsId, u32), NodeId>;

impl<'c> Product<'c> {
    /// The initial pairs. The inputs have the numbers that the sides know them by.
    pub fn new(mut sides: [Side<'c>; 2], judge: Judge<'c>, mut inputs: Inputs) -> Product<'c> {
        let bridges = &judge.coupling.joint.bridges;
        let initial = sides[ABSTRACT].initial(&mut inputs, &bridges[ABSTRACT]);
        let begun = sides[CONCRETE].initial(&mut inputs, &bridges[CONCRETE]);
        let fair = (0..judge.coupling.fair.len()).map(number_of_fair);
        let met = fair.map(|number| inputs.number(number, Vec::new(), Value::Boolean(true))).collect();
        let mut product = Product {
            sides,
            judge,
            inputs,
            readings: Readings::default(),
            pairs: Vec::new(),
            numbers: FxHashMap::default(),
            trees: Vec::new(),
            nodes: Vec::new(),
            ends: FxHashMap::default(),
            root: 0,
            at: 0,
            runs: FxHashMap::default(),
            initial,
            begun,
            met,
            endless: Endless::default(),
        };
        let mut nodes = Vec::new();
        for (label, state, _) in product.begun.clone() {
            let reads = product.readings.with(Readings::NONE, label, &product.inputs);
            let runs = product.initial_runs(reads);
            let Ok(node) = product.end(None, state, reads, 0, &runs, None) else { unreachable!("no step is made") };
            nodes.push(node);
        }
        product.root = product.node(Node::Begins(nodes.into()));
        product
    }

    fn node(&mut self, node: Node) -> NodeId {
        self.nodes.push(node);
        self.nodes.len() as NodeId - 1
    }

    fn pair(&mut self, pair: (StateId, StateId)) -> PairId {
        let next = self.pairs.len() as PairId;
        let number = *self.numbers.entry(pair).or_insert(next);
        if number == next {
            self.pairs.push(pair);
            self.trees.push(None);
            self.sides[ABSTRACT].offer(pair.0);
        }
        number
    }

    /// Whether two states correspond.
    fn coupled(&mut self, one: StateId, other: StateId) -> bool {
        self.numbers.contains_key(&(one, other)) || self.judge.coupled(&mut self.sides, [one, other])
    }

    /// Looks at a pair.
    pub fn explore(&mut self, pair: PairId) -> Result<(), Stopped> {
        let (one, other) = self.pairs[pair as usize];
        self.at = other;
        self.runs.clear();
        let tree = self.go_on(one, other, Readings::NONE, 0, &mut Memo::default())?;
        self.trees[pair as usize] = Some(tree);
        Ok(())
    }

    /// The inputs of the abstract machine that a concrete state determines.
    pub fn given(&mut self, state: StateId) -> Vec<(u32, u32)> {
        let coupling = self.judge.coupling;
        let mut given = Vec::new();
        for (input, formula) in &coupling.given {
            // What cannot be evaluated is a value that no abstract step reads.
            let (value, _) = self.judge.evaluate(&mut self.sides, formula, [0, state]);
            let value = value.unwrap_or_else(machine::Value::string);
            given.push(self.inputs.number(*input, Vec::new(), value));
        }
        for (index, fair) in coupling.fair.iter().enumerate().filter(|(_, fair)| !fair.in_step) {
            let value = match &fair.term {
                FairTerm::Said(_, formula) => self.judge.evaluate(&mut self.sides, formula, [0, state]).0.ok(),
                FairTerm::Own(justice) => self.sides[CONCRETE].evaluate(&justice.formula, state).ok(),
            };
            // What cannot be evaluated is not true.
            let is_met = Value::Boolean(value == Some(Value::Boolean(true)));
            given.push(self.inputs.number(number_of_fair(index), Vec::new(), is_met));
        }
        given
    }

    /// How many conditions of fairness there are.
    pub fn fair(&self) -> usize {
        self.met.len()
    }

    /// Whether a condition of fairness was true in some step of a diagram.
    pub fn meets(&self, end: &Answers, fair: usize) -> bool {
        let (place, met) = self.met[fair];
        self.readings.get(end.reads).get(&place).is_some_and(|values| values.contains(&met))
    }

    /// Whether a condition of fairness is true in a step.
    pub fn meets_in(&self, made: &Move, fair: usize) -> bool {
        self.inputs.entries(made.label).contains(&self.met[fair])
    }

    /// The steps of a concrete state.
    pub fn concrete_moves(&mut self, state: StateId) -> Result<Rc<[Move]>, Stopped> {
        if let Some(known) = self.sides[CONCRETE].known(state)? {
            return Ok(known);
        }
        let given = self.given(state);
        let bridge = &self.judge.coupling.joint.bridges[CONCRETE];
        self.sides[CONCRETE].moves(state, &given, &mut self.inputs, bridge)
    }

    /// The steps of an abstract state.
    pub fn abstract_moves(&mut self, state: StateId) -> Result<Rc<[Move]>, Stopped> {
        let bridge = &self.judge.coupling.joint.bridges[ABSTRACT];
        self.sides[ABSTRACT].moves(state, &[], &mut self.inputs, bridge)
    }

    /// Follows a run of the concrete machine: see [`Side::follow`].
    pub fn follow(
        &mut self,
        state: StateId,
        values: &BTreeMap<Location, Value>,
        wanted: Option<&[(Location, Value)]>,
    ) -> Result<Option<StateId>, Unmade> {
        let given = self.given(state);
        let bridge = &self.judge.coupling.joint.bridges[CONCRETE];
        self.sides[CONCRETE].follow(state, values, wanted, &given, &mut self.inputs, bridge)
    }

    /// The concrete machine goes on in a diagram that has `n` steps already.
    fn go_on(
        &mut self,
        from: StateId,
        state: StateId,
        reads: ReadsId,
        n: u32,
        memo: &mut Memo,
    ) -> Result<NodeId, Stopped> {
        let moves = self.concrete_moves(state)?;
        let mut nodes = Vec::with_capacity(moves.len());
        for made in moves.iter() {
            nodes.push(match made.goal {
                Goal::Fault(_) => self.node(Node::Fault),
                Goal::Open(open) => {
                    let unbounded = self.sides[CONCRETE].unbounded(open);
                    self.node(Node::Open(Unclear::Unbounded(CONCRETE, unbounded)))
                }
                Goal::State(next) => {
                    let reads = self.readings.with(reads, made.label, &self.inputs);
                    let key = (next, reads, n + 1);
                    match memo.get(&key) {
                        Some(node) => *node,
                        None => {
                            let node = self.reached(from, next, reads, n + 1, memo)?;
                            memo.insert(key, node);
                            node
                        }
                    }
                }
            });
        }
        Ok(self.node(Node::Steps(state, nodes.into())))
    }

    /// The concrete machine has reached a state in a diagram.
    fn reached(
        &mut self,
        from: StateId,
        state: StateId,
        reads: ReadsId,
        n: u32,
        memo: &mut Memo,
    ) -> Result<NodeId, Stopped> {
        let coupling = self.judge.coupling;
        let (most, has_end) = (coupling.diagrams.most_concrete(), coupling.segment.is_some());
        let ends = self.judge.ends(&mut self.sides, state);
        let longest = coupling.diagrams.most_abstract(n).filter(|_| ends);
        let goes_on = n < most && !(has_end && ends);
        match longest {
            Some(longest) => {
                let runs = match self.runs.get(&(from, reads, longest)) {
                    Some(known) => Rc::clone(known),
                    None => {
                        let runs = Rc::new(self.abstract_runs(from, reads, longest)?);
                        self.runs.insert((from, reads, longest), Rc::clone(&runs));
                        runs
                    }
                };
                self.end(Some(from), state, reads, n, &runs, goes_on.then_some(memo))
            }
            None if goes_on => self.go_on(from, state, reads, n, memo),
            None if !ends && self.never_ends(state)? => Ok(self.node(Node::Endless)),
            None if !ends => Ok(self.node(Node::Open(Unclear::Long))),
            // A segment ends where no diagram does.
            None => self.end(Some(from), state, reads, n, &AbstractRuns::default(), None),
        }
    }

    /// The diagram may end: what the abstract machine may have come to. With `memo` it may go on as well; the abstract machine decides
    /// when it knows the inputs.
    fn end(
        &mut self,
        from: Option<StateId>,
        to: StateId,
        reads: ReadsId,
        n: u32,
        runs: &AbstractRuns,
        mut memo: Option<&mut Memo>,
    ) -> Result<NodeId, Stopped> {
        let allowed = |m: u32, judge: &Judge<'_>| from.is_none() || judge.coupling.diagrams.allows(m, n);
        let mut matching = Vec::new();
        let begun = if from.is_some() { self.at } else { to };
        for run in &runs.runs {
            let goes_down = |product: &mut Product<'_>| match from {
                Some(from) if run.m == 0 => product.judge.descends(&mut product.sides, [from, begun], [from, to]),
                _ => true,
            };
            if allowed(run.m, &self.judge) && self.coupled(run.to, to) && goes_down(self) {
                matching.push(run);
            }
        }
        let Some(valuations) = valuations(&matching, runs) else {
            return Ok(self.node(Node::Open(Unclear::Valuations)));
        };
        let mut nodes = Vec::new();
        let mut seen = FxHashSet::default();
        for valuation in valuations {
            let fits =
                |run: &&&AbstractRun| run.needs.iter().all(|(location, value)| valuation.get(location) == Some(value));
            let mut answers: Vec<(PairId, u32)> = Vec::new();
            for run in matching.iter().filter(fits) {
                let pair = self.pair((run.to, to));
                if !answers.iter().any(|(other, m)| *other == pair && (*m == 0) == (run.m == 0)) {
                    answers.push((pair, run.m));
                }
            }
            // Where the diagram may go on, what comes then depends on the values, too.
            if !seen.insert(answers.clone()) && memo.is_none() {
                continue;
            }
            let reads = self.readings.where_unread(reads, &valuation);
            let ending = Answers { to, reads, n, answers: answers.into(), unclear: runs.unclear };
            let mut node = self.ending(ending);
            if let (Some(from), Some(memo)) = (from, memo.as_deref_mut()) {
                let further = self.go_on(from, to, reads, n, memo)?;
                node = self.node(Node::Choice([node, further]));
            }
            nodes.push(node);
        }
        Ok(match nodes[..] {
            [only] => only,
            _ => self.node(Node::Inputs(nodes.into())),
        })
    }

    /// The node of an end.
    fn ending(&mut self, end: Answers) -> NodeId {
        if let Some(known) = self.ends.get(&end) {
            return *known;
        }
        let node = self.node(Node::Answers(end.clone()));
        self.ends.insert(end, node);
        node
    }

    /// What bounds leave out of the steps of an abstract state, or of the abstract machine's initial states, in a diagram with these
    /// inputs. An input at which the concrete machine did not look has any value, of which those that were tried must be answered, too.
    fn left_out(&self, at: Option<StateId>, reads: ReadsId) -> Option<Unclear> {
        let coupling = self.judge.coupling;
        let bridge = &coupling.joint.bridges[ABSTRACT];
        let mut looked = self.sides[ABSTRACT].limited_at(at);
        let lacking = looked.find(|(location, limit)| {
            if !coupling.shared[ABSTRACT].contains_key(&location.function) {
                return true;
            }
            let arguments: Option<Vec<Value>> = location.arguments.iter().map(|value| bridge.over(value)).collect();
            let place = arguments.and_then(|arguments| self.inputs.location(location.function.0, arguments));
            let had = place.and_then(|place| self.readings.get(reads).get(&place)).into_iter().flatten();
            let mut own = had.filter_map(|value| bridge.back(&self.inputs.told_values[*value as usize]));
            own.any(|value| limit.leaves_out(&value))
        });
        lacking.map(|(location, _)| Unclear::Bounded(location.function))
    }

    fn initial_runs(&mut self, reads: ReadsId) -> AbstractRuns {
        let mut found = AbstractRuns { unclear: self.left_out(None, reads), ..AbstractRuns::default() };
        for (label, state, _) in self.initial.clone() {
            let (label, reads) = (self.inputs.entries(label), self.readings.get(reads));
            if let Some(needs) = fitting(label, reads, &[], &mut found.values) {
                found.runs.push(AbstractRun { to: state, m: 0, needs });
            }
        }
        found
    }

    /// How the abstract machine begins in a state, with these inputs if it can.
    pub fn begun_in(&self, state: StateId, reads: ReadsId) -> Option<Start> {
        let reads = self.readings.get(reads);
        let fits = |label: LabelId| fitting(self.inputs.entries(label), reads, &[], &mut BTreeMap::new()).is_some();
        let mut all = self.initial.iter().filter(|(_, other, _)| *other == state);
        let fitting = all.clone().find(|(label, ..)| fits(*label));
        fitting.or_else(|| all.next()).map(|(.., start)| *start)
    }

    /// An initial state of the abstract machine that corresponds to the concrete one of this place.
    pub fn beside(&self, begun: usize) -> Option<(StateId, Start)> {
        let Node::Begins(all) = &self.nodes[self.root as usize] else { return None };
        let mut open = vec![all[begun]];
        while let Some(node) = open.pop() {
            match &self.nodes[node as usize] {
                Node::Answers(end) => {
                    let (pair, _) = end.answers.first()?;
                    let (state, _) = self.pairs[*pair as usize];
                    return Some((state, self.begun_in(state, end.reads)?));
                }
                node => open.extend(node.behind().iter().rev()),
            }
        }
        None
    }

    /// The runs of the abstract machine in a diagram, of at most so many steps.
    pub fn abstract_runs(&mut self, from: StateId, reads: ReadsId, most: u32) -> Result<AbstractRuns, Stopped> {
        let mut found = AbstractRuns::default();
        let mut last = vec![AbstractRun { to: from, m: 0, needs: Vec::new() }];
        found.runs.extend(last.clone());
        for m in 1..=most {
            let mut next = Vec::new();
            let mut seen = FxHashSet::default();
            for run in last {
                let moves = self.abstract_moves(run.to)?;
                found.unclear = found.unclear.or(self.left_out(Some(run.to), reads));
                for made in moves.iter() {
                    let (label, reads) = (self.inputs.entries(made.label), self.readings.get(reads));
                    let Some(needs) = fitting(label, reads, &run.needs, &mut found.values) else { continue };
                    match made.goal {
                        Goal::State(to) => {
                            let run = AbstractRun { to, m, needs };
                            if seen.insert(run.clone()) {
                                next.push(run);
                            }
                        }
                        Goal::Fault(fault) => {
                            found.faults.insert(self.sides[ABSTRACT].fault(fault).clone());
                        }
                        Goal::Open(open) => {
                            let unbounded = self.sides[ABSTRACT].unbounded(open);
                            found.unclear = Some(Unclear::Unbounded(ABSTRACT, unbounded));
                        }
                    }
                }
            }
            found.runs.extend(next.clone());
            last = next;
        }
        Ok(found)
    }

    /// The steps of the abstract machine from one state to another in a diagram with these inputs.
    pub fn abstract_way(&mut self, from: StateId, to: StateId, m: u32, reads: ReadsId) -> Vec<(StateId, Move)> {
        let mut layers: Vec<Vec<Reached>> = vec![vec![(from, 0, None)]];
        for _ in 0..m {
            let mut next: Vec<Reached> = Vec::new();
            for (place, (state, ..)) in layers[layers.len() - 1].clone().into_iter().enumerate() {
                let Ok(moves) = self.abstract_moves(state) else { return Vec::new() };
                for made in moves.iter() {
                    let (label, reads) = (self.inputs.entries(made.label), self.readings.get(reads));
                    let fits = fitting(label, reads, &[], &mut BTreeMap::new()).is_some_and(|needs| needs.is_empty());
                    if let Goal::State(there) = made.goal
                        && fits
                        && !next.iter().any(|(other, ..)| *other == there)
                    {
                        next.push((there, place, Some((state, *made))));
                    }
                }
            }
            layers.push(next);
        }
        let mut way = Vec::new();
        let last = layers.len() - 1;
        let Some(mut place) = layers[last].iter().position(|(state, ..)| *state == to) else { return way };
        for layer in layers.iter().rev() {
            let (_, before, made) = &layer[place];
            way.extend(*made);
            place = *before;
        }
        way.reverse();
        way
    }
}

/// The values of inputs that the concrete machine did not look at and matching runs need; none if there are too many.
fn valuations(matching: &[&AbstractRun], runs: &AbstractRuns) -> Option<Vec<BTreeMap<u32, u32>>> {
    let asked: BTreeSet<u32> = matching.iter().flat_map(|run| &run.needs).map(|(location, _)| *location).collect();
    let mut valuations = vec![BTreeMap::new()];
    for location in asked {
        let values = &runs.values[&location];
        if valuations.len() * values.len() > VALUATIONS {
            return None;
        }
        let with = |before: &BTreeMap<u32, u32>, value: u32| {
            let mut with = before.clone();
            with.insert(location, value);
            with
        };
        valuations = valuations.iter().flat_map(|before| values.iter().map(|value| with(before, *value))).collect();
    }
    Some(valuations)
}

/// What an abstract step needs besides what it needed before, if its inputs can have these values.
fn fitting(
    label: &[(u32, u32)],
    reads: &Reads,
    before: &[(u32, u32)],
    values: &mut BTreeMap<u32, BTreeSet<u32>>,
) -> Option<Vec<(u32, u32)>> {
    let mut needs = before.to_vec();
    let mut fits = true;
    for (location, value) in label.iter() {
        match reads.get(location) {
            Some(had) => fits &= had.contains(value),
            None => {
                values.entry(*location).or_default().insert(*value);
                match needs.iter().find(|(other, _)| other == location) {
                    Some((_, other)) => fits &= other == value,
                    None => needs.push((*location, *value)),
                }
            }
        }
    }
    needs.sort_unstable();
    fits.then_some(needs)
}
