//! The transition relation of a program: its state as variables, the effect of a step on them, and the targets.
//!
//! In: a program and its targets, as for [`crate::explicit`]. Out: a [`Relation`], or what cannot be encoded. Which
//! locations may be undef is found by trying: at first only those without an initial value.

use std::collections::BTreeSet;
use std::sync::Arc;

use explore::{Explorer, Given, Interner, Settings, Told, Trouble};
use machine::{Location, Machine, Value};
use program::{FunctionId, Program};
use rustc_hash::FxHashMap;
use solve::Outside;
use solve::shared::{Kind, Node, Op, Terms, VariableId};
use syntax::Span;

use crate::explorers::widened;
use crate::plan::Plan;
use crate::target::Target;
use solve::encode::{Choice, Encoder, Input, InputKind, Place};
use solve::symbol::{Codes, constant};

/// LIMIT: the most initial states.
const STARTS: usize = 256;
/// LIMIT: the most values of an input that are enumerated to decide whether a state is a deadlock.
const VALUES: i128 = 64;
/// LIMIT: the most shared terms, for the same purpose.
const TERMS: usize = 1_500_000;

/// An initial state.
pub(crate) struct Start {
    pub told: Told,
    pub values: Vec<(Location, Value)>,
}

/// A transition relation.
pub(crate) struct Relation {
    pub terms: Terms,
    pub codes: Codes,
    pub places: Vec<Place>,
    /// The variables of the state.
    pub state: Vec<VariableId>,
    /// Their values in the initial state that `start` selects.
    pub initial: Vec<Node>,
    pub start: Option<VariableId>,
    pub starts: Vec<Start>,
    /// Facts about the inputs of the first step: it keeps those that the initial state has read.
    pub first: Node,
    /// Their values after a step.
    pub next: Vec<Node>,
    pub inputs: Vec<Input>,
    pub choices: Vec<Choice>,
    /// Facts about a state and its step: the domains; that no assumption about the state is false; the inputs; that there is a step
    /// from a state whose assumptions are true.
    pub typed: Node,
    pub admitted: Node,
    pub given: Node,
    pub goes: Node,
    /// The targets, each with the condition on state and inputs under which it is found.
    pub targets: Vec<(Target, Node)>,
    /// Targets whose condition cannot be encoded.
    pub untold: Vec<Target>,
    /// Conditions under which the machine may do what is not encoded.
    pub beyond: Vec<(Node, Outside)>,
    /// Any of these conditions.
    pub strays: Node,
    /// Whether reals are computed.
    pub inexact: bool,
}

/// Why there is no relation.
pub(crate) enum Unrelated {
    Outside(Outside),
    Trouble(Trouble),
}

impl From<Outside> for Unrelated {
    fn from(outside: Outside) -> Unrelated {
        Unrelated::Outside(outside)
    }
}

impl Relation {
    /// The relation of a program; with `exact`, reals are computed without rounding.
    ///
    /// # Errors
    /// See [`Unrelated`].
    pub fn of(program: &Arc<Program>, plan: &Plan, exact: bool) -> Result<Relation, Unrelated> {
        let starts = starts(program, plan)?;
        let mut partial = BTreeSet::new();
        loop {
            let mut machine = Machine::new(Arc::clone(program), plan.settings.limits.clone());
            let mut given = Given::new(&starts[0].told);
            if let Err(fault) = machine.start(&mut given) {
                return Err(Unrelated::Trouble(Trouble::Fault(Box::new(fault))));
            }
            let bounds = plan.settings.bounds.as_ref().clone();
            let mut encoder = Encoder::new(machine, bounds, exact, partial.clone());
            let relation = Relation::encode(&mut encoder, plan, &starts)?;
            let Built { next, initial, mut relation } = relation;
            let mut more = BTreeSet::new();
            for (place, (next, initial)) in encoder.places.iter().zip(next.iter().zip(&initial)) {
                let function = place.location.function;
                let undefined = next.1 != Terms::TRUE || initial.1 != Terms::TRUE;
                if place.kept && undefined && !partial.contains(&function) {
                    more.insert(function);
                }
            }
            if !more.is_empty() {
                partial.extend(more);
                continue;
            }
            for (index, place) in encoder.places.iter().enumerate().filter(|(_, place)| place.kept) {
                let mut variables = vec![(place.value, next[index].0, initial[index].0)];
                if place.defined != Terms::TRUE {
                    variables.push((place.defined, next[index].1, initial[index].1));
                }
                for (variable, next, initial) in variables {
                    let Op::Variable(id) = encoder.terms.op(variable) else { continue };
                    relation.state.push(*id);
                    relation.next.push(next);
                    relation.initial.push(initial);
                }
            }
            relation.places = encoder.places;
            relation.inputs = encoder.inputs;
            relation.choices = encoder.choices;
            relation.beyond.extend(encoder.beyond);
            relation.strays = encoder.terms.or(relation.beyond.iter().map(|one| one.0));
            relation.inexact = encoder.inexact;
            relation.terms = encoder.terms;
            relation.codes = encoder.codes;
            relation.starts = starts;
            return Ok(relation);
        }
    }

    fn encode(encoder: &mut Encoder, plan: &Plan, starts: &[Start]) -> Result<Built, Unrelated> {
        let settings = &plan.settings;
        encoder.step()?;
        // A step counts if all assumptions are true, and does not if one is false; otherwise nobody knows.
        let (mut ruled_out, mut unclear) = (Terms::FALSE, Vec::new());
        let mut failures = Vec::new();
        for (index, (formula, assumed)) in settings.step_conditions.iter().enumerate() {
            let (alone, live) = encoder.condition(formula)?;
            if !*assumed {
                // One that has no value is not true, and no fault of the step.
                failures.push((index, encoder.terms.not(alone)));
                continue;
            }
            let not = encoder.terms.not(alone);
            let fails = encoder.terms.and([live, not]);
            ruled_out = encoder.terms.or([ruled_out, fails]);
            if live != Terms::TRUE {
                unclear.push((encoder.terms.not(live), without_value(encoder.program.term_span(formula.body))));
            }
        }
        let may_count = encoder.terms.not(ruled_out);
        let mut beyond = Vec::new();
        for (unclear, outside) in unclear {
            beyond.push((encoder.terms.and([unclear, may_count]), outside));
        }
        let unclear = encoder.terms.or(beyond.iter().map(|one| one.0));
        let is_clear = encoder.terms.not(unclear);
        let counts = encoder.terms.and([may_count, is_clear]);
        let course = encoder.course();
        let goes = encoder.terms.and([course.live, counts]);
        let fault = |class: usize| (Target::Fault(class), encoder.terms.and([course.faults[class], counts]));
        let mut targets: Vec<(Target, Node)> = (0..3).map(fault).collect();
        for (index, fails) in failures.into_iter().filter(|(index, _)| plan.wanted_steps.contains(index)) {
            targets.push((Target::StepCondition(index), encoder.terms.and([goes, fails])));
        }
        let (mut conditions, mut refuted) = (Vec::new(), Terms::FALSE);
        for (index, condition) in settings.conditions.iter().enumerate() {
            let before = encoder.beyond.len();
            let (truth, live) = encoder.condition(condition)?;
            // Where it cannot be told what it comes to, it is not violated either.
            let strays: Vec<Node> = encoder.beyond[before..].iter().map(|one| one.0).collect();
            let strays = encoder.terms.or(strays);
            conditions.push(truth);
            if live != Terms::TRUE && (plan.assumed.contains(&index) || plan.terminal == Some(index)) {
                let outside = without_value(encoder.program.term_span(condition.body));
                beyond.push((encoder.terms.not(live), outside));
            }
            if plan.assumed.contains(&index) {
                let not = encoder.terms.not(truth);
                let fails = encoder.terms.and([live, not]);
                refuted = encoder.terms.or([refuted, fails]);
            }
            if plan.wanted.contains(&index) {
                let violated = [encoder.terms.not(truth), encoder.terms.not(strays)];
                targets.push((Target::Condition(index), encoder.terms.and(violated)));
            }
        }
        let admitted = encoder.terms.not(refuted);
        let surely_admitted = encoder.terms.and(plan.assumed.iter().map(|index| conditions[*index]));
        let (mut next, mut moves) = (Vec::new(), Vec::new());
        for index in 0..encoder.places.len() {
            let place = encoder.places[index].clone();
            if !place.kept {
                next.push((Terms::FALSE, Terms::TRUE));
                continue;
            }
            let (symbol, changed) = encoder.next(index)?;
            moves.push(changed);
            next.push(encoder.lowered(&symbol, &place)?);
        }
        let changed = encoder.terms.or(moves);
        let moves = encoder.terms.and([goes, changed]);
        let (initial, start) = initial(encoder, starts)?;
        let first = first(encoder, starts, start);
        let start = start.and_then(|node| match encoder.terms.op(node) {
            Op::Variable(id) => Some(*id),
            _ => None,
        });
        let given = encoder.given.clone();
        let given = encoder.terms.and(given);
        let typed: Vec<Node> = encoder.places.iter().map(|place| place.typed).collect();
        let typed = encoder.terms.and(typed);
        let mut untold = Vec::new();
        let disturbed: Vec<Node> =
            course.faults.into_iter().chain([unclear]).chain(encoder.beyond.iter().map(|one| one.0)).collect();
        let disturbed = encoder.terms.or(disturbed);
        let awake = encoder.terms.or([moves, disturbed]);
        match possible(encoder, awake) {
            Some(awake) => {
                let rests = [encoder.terms.not(changed), encoder.terms.not(awake)];
                let resting = encoder.terms.and([goes, rests[0], rests[1]]);
                let may = plan.terminal.map_or(Terms::FALSE, |index| conditions[index]);
                let may_not = encoder.terms.not(may);
                targets.push((Target::Rest, encoder.terms.and([resting, may_not])));
            }
            None => untold.push(Target::Rest),
        }
        // What is violated is so in a state that counts, and after states that count.
        let goes = encoder.terms.and([goes, surely_admitted]);
        for (_, found) in &mut targets {
            *found = encoder.terms.and([*found, surely_admitted]);
        }
        let relation = Relation {
            terms: Terms::default(),
            codes: Codes::default(),
            places: Vec::new(),
            state: Vec::new(),
            initial: Vec::new(),
            start,
            starts: Vec::new(),
            first,
            next: Vec::new(),
            inputs: Vec::new(),
            choices: Vec::new(),
            typed,
            admitted,
            given,
            goes,
            targets,
            untold,
            beyond,
            strays: Terms::FALSE,
            inexact: false,
        };
        Ok(Built { next, initial, relation })
    }

    /// The variables of the state that affect the targets, directly or through others; as indices into `state`.
    pub fn cone(&self) -> Vec<usize> {
        let place: FxHashMap<VariableId, usize> = self.state.iter().copied().zip(0..).collect();
        let wanted = self.targets.iter().map(|one| one.1).chain(self.beyond.iter().map(|one| one.0));
        let roots: Vec<Node> = wanted.chain([self.typed, self.admitted, self.given, self.goes]).collect();
        let mut open: Vec<VariableId> = self.terms.variables_of(roots);
        let mut within = BTreeSet::new();
        while let Some(id) = open.pop() {
            if let Some(index) = place.get(&id)
                && within.insert(*index)
            {
                open.extend(self.terms.variables_of([self.next[*index]]));
            }
        }
        within.into_iter().collect()
    }

    /// The variables of the inputs.
    pub fn input_variables(&self) -> Vec<VariableId> {
        let variable = |input: &Input| match self.terms.op(input.variable) {
            Op::Variable(id) => Some(*id),
            _ => None,
        };
        self.inputs.iter().filter_map(variable).collect()
    }
}

/// What stands outside where an assumption cannot be evaluated.
fn without_value(span: Span) -> Outside {
    Outside { what: "an assumption that has no value".to_string(), span }
}

struct Built {
    /// For each place its value, and whether it is defined.
    next: Vec<(Node, Node)>,
    initial: Vec<(Node, Node)>,
    relation: Relation,
}

fn starts(program: &Arc<Program>, plan: &Plan) -> Result<Vec<Start>, Unrelated> {
    let nowhere = Span { file: syntax::FileId(0), start: 0, end: 0 };
    // Conditions also read inputs that the initial state keeps.
    let settings = Settings { observed: false, unordered: Arc::default(), ..plan.settings.clone() };
    let explore = |widening: &_| Explorer::new(program, settings.clone(), widening, &Arc::new(Interner::default()));
    let explorer = match widened(explore) {
        Ok(explorer) => explorer,
        Err(Trouble::Unbounded(unbounded)) => {
            let what = "an initial value that takes any of infinitely many inputs".to_string();
            return Err(Unrelated::Outside(Outside { what, span: unbounded.span }));
        }
        Err(trouble) => return Err(Unrelated::Trouble(trouble)),
    };
    let mut seen = BTreeSet::new();
    let distinct: Vec<_> =
        explorer.initial().iter().filter(|(state, _)| seen.insert(*state)).map(|(_, start)| start).collect();
    if distinct.len() > STARTS {
        let what = format!("more than {STARTS} initial states");
        return Err(Unrelated::Outside(Outside { what, span: nowhere }));
    }
    if distinct.is_empty() {
        let what = "assumptions that leave no initial state".to_string();
        return Err(Unrelated::Outside(Outside { what, span: nowhere }));
    }
    // A packed state omits values that are still the initial ones.
    let mut machine = Machine::new(Arc::clone(program), plan.settings.limits.clone());
    let mut starts = Vec::new();
    for start in distinct {
        let told = explorer.told_of_start(start);
        if let Err(fault) = machine.start(&mut Given::new(&told)) {
            return Err(Unrelated::Trouble(Trouble::Fault(Box::new(fault))));
        }
        starts.push(Start { told, values: machine.locations() });
    }
    Ok(starts)
}

type Values = Vec<(Node, Node)>;

/// For each place its value in an initial state; and the variable that selects the initial state.
fn initial(encoder: &mut Encoder, starts: &[Start]) -> Result<(Values, Option<Node>), Outside> {
    let several = starts.len() > 1;
    let bounds = (Some(0), Some(starts.len() as i128 - 1));
    let node = several.then(|| encoder.terms.variable("start", Kind::Integer, bounds));
    let known: Vec<FxHashMap<&Location, &Value>> =
        starts.iter().map(|start| start.values.iter().map(|(location, value)| (location, value)).collect()).collect();
    let mut initial = Vec::new();
    for index in 0..encoder.places.len() {
        let place = encoder.places[index].clone();
        if !place.kept {
            initial.push((Terms::FALSE, Terms::TRUE));
            continue;
        }
        let mut all: Option<(Node, Node)> = None;
        for (number, values) in known.iter().enumerate() {
            let value = values.get(&place.location).map_or(Value::Undef, |value| (*value).clone());
            let function: FunctionId = place.location.function;
            let (codomain, span) =
                (encoder.program.function(function).codomain, encoder.program.function(function).span);
            if !encoder.machine().contains(codomain, &value) {
                return Err(Outside { what: "an initial value outside of its domain".to_string(), span });
            }
            let one = encoder.begun(value, &place)?;
            all = Some(match (all, node) {
                (Some(former), Some(node)) => {
                    let number = encoder.terms.integer(number as i128);
                    let this = encoder.terms.equal(node, number);
                    (encoder.terms.choose(this, one.0, former.0), encoder.terms.choose(this, one.1, former.1))
                }
                _ => one,
            });
        }
        initial.extend(all);
    }
    Ok((initial, node))
}

/// For each initial state, that the inputs of the first step equal those that it has read.
fn first(encoder: &mut Encoder, starts: &[Start], start: Option<Node>) -> Node {
    let mut all = Vec::new();
    for input in encoder.inputs.clone() {
        let InputKind::Location(function, arguments, _) = input.kind else { continue };
        let location = Location { function, arguments };
        for (number, one) in starts.iter().enumerate() {
            let Some((_, value)) = one.told.inputs.iter().find(|(asked, _)| *asked == location) else { continue };
            let value = constant(&mut encoder.terms, &mut encoder.codes, value);
            let same = encoder.terms.equal(input.variable, value);
            all.push(match start {
                Some(start) => {
                    let number = encoder.terms.integer(number as i128);
                    let here = encoder.terms.equal(start, number);
                    encoder.terms.implies(here, same)
                }
                None => same,
            });
        }
    }
    encoder.terms.and(all)
}

/// Whether a condition holds for some inputs; `None` if these cannot be enumerated.
fn possible(encoder: &mut Encoder, condition: Node) -> Option<Node> {
    let mut result = condition;
    let variable = |input: &Input| match encoder.terms.op(input.variable) {
        Op::Variable(id) => Some(*id),
        _ => None,
    };
    let inputs: BTreeSet<VariableId> = encoder.inputs.iter().filter_map(variable).collect();
    // Later inputs may depend on earlier ones.
    for id in inputs.iter().rev() {
        if encoder.terms.variables_of([result]).binary_search(id).is_err() {
            continue;
        }
        let declared = encoder.terms.variable_of(*id);
        let values: Vec<Node> = match (declared.kind, declared.bounds) {
            (Kind::Boolean, _) => vec![Terms::FALSE, Terms::TRUE],
            (Kind::Integer, (Some(low), Some(high))) if high - low < VALUES => {
                (low..=high).map(|number| encoder.terms.integer(number)).collect()
            }
            _ => return None,
        };
        let mut known = Vec::new();
        for given in encoder.given.clone() {
            let mut of_inputs = encoder.terms.variables_of([given]).into_iter().filter(|one| inputs.contains(one));
            if of_inputs.next_back() == Some(*id) {
                known.push(given);
            }
        }
        let known = encoder.terms.and(known.into_iter().chain([result]));
        let mut any = Vec::new();
        for value in values {
            let mut made = FxHashMap::default();
            any.push(encoder.terms.replace(known, &|other| (other == *id).then_some(value), &mut made));
            if encoder.terms.count() > TERMS {
                return None;
            }
        }
        result = encoder.terms.or(any);
    }
    Some(result)
}
