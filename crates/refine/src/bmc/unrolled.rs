//! Runs of both machines from the initial states, step by step of the concrete one.
//!
//! In: both machines and the coupling as formulas. Out: after each concrete step the condition under which it cannot be made, or no run of
//! the abstract machine matches what was done. The concrete machine's inputs and choices are variables. The abstract machine's runs are
//! written out: a list of its states, each with the condition that it is one to which a run has come that corresponds at the end of each
//! of its diagrams. INVARIANT: each run that the abstract machine may have made is among them, and none that it may not.

use std::collections::BTreeMap;

use explore::Told;
use program::FunctionId;
use solve::Outside;
use solve::shared::{Kind, Node, Terms};
use solve::symbol::{Shape, constant};

use crate::coupling::Coupling;
use crate::formulas::Begun;
use crate::formulas::answers::{Offered, runs};
use crate::formulas::ask::Ask;
use crate::formulas::diagrams::{Diagrams, Step, add};
use crate::formulas::related::Related;
use crate::formulas::symbolic::{Replacement, Store, Symbolic, input_location, nowhere};
use crate::{ABSTRACT, CONCRETE};

/// LIMIT: so many states of the abstract machine are followed side by side.
const WAYS: usize = 256;
/// LIMIT: so many of them are compared with each other by solvers.
const COMPARED: usize = 12;
/// LIMIT: shared terms.
const TERMS: usize = 6_000_000;

/// A state of the abstract machine at the end of a diagram.
#[derive(Debug, Clone)]
pub(super) struct Way {
    /// A run has come to it.
    pub made: Node,
    pub state: Vec<Node>,
}

/// The next concrete step.
pub(super) struct Next {
    /// It cannot be made, or nothing matches.
    pub lost: Node,
    /// It may do what is not encoded.
    pub strays: Vec<(Node, Outside)>,
}

/// See the module.
pub(super) struct Unrolled<'u> {
    pub machines: [&'u Symbolic; 2],
    pub store: &'u mut Store,
    coupling: &'u Coupling,
    related: &'u Related,
    diagrams: Diagrams<'u>,
    /// Which of the initial states it is.
    pub chosen: Node,
    /// The concrete states by time, and the steps between them.
    states: Vec<Vec<Node>>,
    pub steps: Vec<Step>,
    /// By time, the abstract machine's states.
    ways: Vec<Vec<Way>>,
    /// The run so far is made, and matched at each time.
    path: Node,
    /// The last step is made, and matched.
    gone: Node,
    /// What inputs of the initial state keep in the first step.
    kept: Vec<(Node, &'u Told)>,
}

impl<'u> Unrolled<'u> {
    /// The initial states.
    pub fn new(
        coupling: &'u Coupling,
        machines: [&'u Symbolic; 2],
        related: &'u Related,
        store: &'u mut Store,
        starts: &'u [Vec<Told>; 2],
        begun: &[Begun],
    ) -> Unrolled<'u> {
        let terms = &mut store.terms;
        let last = begun.len() as i128 - 1;
        let chosen = match last {
            ..1 => terms.integer(0),
            last => terms.variable("initial state", Kind::Integer, (Some(0), Some(last))),
        };
        let mut is_it = Vec::new();
        for number in 0..begun.len() {
            let number = terms.integer(number as i128);
            is_it.push(terms.equal(chosen, number));
        }
        let mut state: Vec<Node> = Vec::new();
        for place in 0..machines[CONCRETE].state.len() {
            let of = |number: usize| machines[CONCRETE].starts[begun[number].concrete][place];
            let first = of(0);
            state.push((1..begun.len()).fold(first, |other, number| terms.choose(is_it[number], of(number), other)));
        }
        let mut found: BTreeMap<usize, Vec<Node>> = BTreeMap::new();
        for (begun, is_it) in begun.iter().zip(&is_it) {
            begun.answers.iter().for_each(|answer| found.entry(*answer).or_default().push(*is_it));
        }
        let mut ways = Vec::new();
        for (answer, made) in found {
            ways.push(Way { made: terms.or(made), state: machines[ABSTRACT].starts[answer].clone() });
        }
        let kept = begun.iter().zip(is_it).map(|(begun, is_it)| (is_it, &starts[CONCRETE][begun.concrete])).collect();
        let diagrams = Diagrams::from(coupling, machines, related, state.clone());
        Unrolled {
            machines,
            store,
            coupling,
            related,
            diagrams,
            chosen,
            states: vec![state],
            steps: Vec::new(),
            ways: vec![ways],
            path: Terms::TRUE,
            gone: Terms::TRUE,
            kept,
        }
    }

    /// One more concrete step.
    ///
    /// # Errors
    /// What the abstract machine may do cannot be written out.
    pub fn next(&mut self) -> Result<Next, Outside> {
        let step = self.diagrams.step(self.store)?;
        let mut here = vec![self.path, step.facts];
        for (is_it, told) in self.kept.drain(..) {
            for (location, value) in &told.inputs {
                let own = step.inputs.iter().find(|(input, _)| {
                    let there = input_location(input);
                    there.is_some_and(|(function, arguments, shape)| {
                        (function, arguments) == (location.function, &location.arguments[..])
                            && shape == Shape::of(value)
                    })
                });
                let Some((_, own)) = own else { continue };
                let value = constant(&mut self.store.terms, &mut self.store.codes, value);
                let own = self.store.terms.known(*own);
                let keeps = self.store.terms.equal(own, value);
                here.push(self.store.terms.implies(is_it, keeps));
            }
        }
        let here = self.store.terms.and(here);
        let faults = self.store.terms.or(step.faults.iter().map(|one| one.1));
        let mut strays = Vec::new();
        for (stray, outside) in &step.strays {
            strays.push((self.store.terms.and([here, *stray]), outside.clone()));
        }
        let gone = self.store.terms.and([here, step.goes]);
        self.states.push(step.to.clone());
        self.steps.push(step);
        let ways = self.answers()?;
        let mut answered = self.goes_on();
        answered.extend(ways.iter().map(|way| way.made));
        self.ways.push(ways);
        let terms = &mut self.store.terms;
        let answered = terms.or(answered);
        let not = terms.not(answered);
        self.gone = terms.and([gone, answered]);
        let (unmatched, fault) = (terms.and([gone, not]), terms.and([here, faults]));
        Ok(Next { lost: terms.or([unmatched, fault]), strays })
    }

    /// The run goes on from there: it is made and matched so far. Solvers say which of the abstract machine's states no run comes to, and
    /// which are always equal.
    pub fn go_on(&mut self, ask: &mut Ask<'_, '_>) {
        self.path = self.gone;
        let Some(ways) = self.ways.pop() else { return };
        let mut kept: Vec<Way> = Vec::new();
        let is_one = ways.len() == 1;
        'ways: for way in ways {
            let terms = &mut self.store.terms;
            let made = terms.and([self.path, way.made]);
            if !is_one && ask.denied(terms, made) {
                continue;
            }
            for other in kept.iter_mut().take(COMPARED) {
                let mut differ = Vec::new();
                for (one, other) in way.state.iter().zip(&other.state) {
                    let same = terms.equal(*one, *other);
                    differ.push(terms.not(same));
                }
                let differ = terms.or(differ);
                let both = terms.and([made, other.made, differ]);
                if ask.denied(terms, both) {
                    for (one, there) in way.state.iter().zip(&mut other.state) {
                        *there = terms.choose(other.made, *there, *one);
                    }
                    other.made = terms.or([other.made, way.made]);
                    continue 'ways;
                }
            }
            kept.push(way);
        }
        self.ways.push(kept);
    }

    /// The run so far comes to a pair of states of which a condition holds.
    pub fn comes_to(&mut self, condition: Node) -> Node {
        let now = self.steps.len();
        let mut any = Vec::new();
        for way in self.ways[now].clone() {
            let mut by = both(self.machines, &way.state, &self.states[now]);
            let holds = self.store.replaced(condition, &mut by);
            any.push(self.store.terms.and([self.path, way.made, holds]));
        }
        self.store.terms.or(any)
    }

    /// No segment ends between two times.
    fn not_ended(&mut self, after: usize, before: usize) -> Node {
        if self.coupling.segment.is_none() {
            return Terms::TRUE;
        }
        let mut all = Vec::new();
        for step in &self.steps[after..before.saturating_sub(1).max(after)] {
            all.push(self.store.terms.not(step.ends));
            all.push(self.store.terms.not(step.ends_stray));
        }
        self.store.terms.and(all)
    }

    /// Conditions under which a diagram that has begun may end later.
    fn goes_on(&mut self) -> Vec<Node> {
        let (now, most) = (self.steps.len(), self.coupling.diagrams.most_concrete() as usize);
        let mut all = Vec::new();
        for time in 0..now {
            // A segment that is too long is not clear, and refutes nothing.
            let until = match self.coupling.segment.is_some() {
                true => now.min(time + most),
                false if now - time < most => now,
                false => continue,
            };
            let open = self.not_ended(time, until + 1);
            let made: Vec<Node> = self.ways[time].iter().map(|way| way.made).collect();
            let any = self.store.terms.or(made);
            all.push(self.store.terms.and([any, open]));
        }
        all
    }

    /// The states of the abstract machine that correspond to the last state, at the end of diagrams.
    fn answers(&mut self) -> Result<Vec<Way>, Outside> {
        let coupling = self.coupling;
        let now = self.steps.len();
        let last = &self.steps[now - 1];
        let (ends, odd) = (last.ends, last.ends_stray);
        let not = self.store.terms.not(odd);
        let ends = self.store.terms.and([ends, not]);
        let program = &coupling.programs[ABSTRACT];
        let names = |function: FunctionId| program.function(function).name.clone();
        let mut found: BTreeMap<Vec<Node>, Vec<Node>> = BTreeMap::new();
        let mut offered = Offered::default();
        let most = now.min(coupling.diagrams.most_concrete() as usize);
        for n in 1..=most {
            let begun = now - n;
            add(&mut offered, &self.steps[begun].offered);
            let Some(longest) = coupling.diagrams.most_abstract(n as u32) else { continue };
            let open = self.not_ended(begun, now);
            let ways = self.ways[begun].clone();
            if ways.is_empty() || open == Terms::FALSE {
                continue;
            }
            for m in (0..=longest).filter(|m| coupling.diagrams.allows(*m, n as u32)) {
                let made = runs(self.machines[ABSTRACT], self.store, &names, &offered, m)?;
                for (run, way) in made.iter().flat_map(|run| ways.iter().map(move |way| (run, way))) {
                    let mut by = from(self.machines[ABSTRACT], &way.state);
                    let made = self.store.replaced(run.made, &mut by);
                    let made = self.store.terms.and([way.made, open, ends, made]);
                    if made == Terms::FALSE {
                        continue;
                    }
                    let state: Vec<Node> = run.state.iter().map(|node| self.store.replaced(*node, &mut by)).collect();
                    let mut all = vec![made, self.corresponds(&state, now)];
                    if m == 0 {
                        all.push(self.descends(&state, begun, now));
                    }
                    let made = self.store.terms.and(all);
                    if made != Terms::FALSE {
                        found.entry(state).or_default().push(made);
                    }
                    if found.len() > WAYS || self.store.terms.count() > TERMS {
                        let what = format!("an abstract machine that can do too many different things in {now} steps");
                        return Err(nowhere(&what));
                    }
                }
            }
        }
        let terms = &mut self.store.terms;
        Ok(found.into_iter().map(|(state, made)| Way { made: terms.or(made), state }).collect())
    }

    /// A state of the abstract machine corresponds to the concrete state of a time.
    fn corresponds(&mut self, state: &[Node], time: usize) -> Node {
        let mut by = both(self.machines, state, &self.states[time]);
        let mut all: Vec<Node> = Vec::new();
        for part in &self.related.parts {
            all.push(self.store.replaced(*part, &mut by));
        }
        let stray = self.store.replaced(self.related.stray, &mut by);
        all.push(self.store.terms.not(stray));
        self.store.terms.and(all)
    }

    /// The abstract machine may make no step between two times: the variant decreases, if there is one.
    fn descends(&mut self, state: &[Node], before: usize, after: usize) -> Node {
        let Some(variant) = self.related.variant else { return Terms::TRUE };
        let [before, after] = [before, after].map(|time| {
            let mut by = both(self.machines, state, &self.states[time]);
            (self.store.replaced(variant.value, &mut by), self.store.replaced(variant.known, &mut by))
        });
        let terms = &mut self.store.terms;
        let zero = terms.integer(0);
        let (positive, less) = (terms.at_most(zero, before.0), terms.less(after.0, before.0));
        terms.and([before.1, after.1, positive, less])
    }
}

/// A state for an arbitrary one of a machine.
fn from(machine: &Symbolic, state: &[Node]) -> Replacement {
    Replacement::new(machine.state.iter().copied().zip(state.iter().copied()))
}

/// States for arbitrary ones of both machines.
fn both(machines: [&Symbolic; 2], state: &[Node], other: &[Node]) -> Replacement {
    let one = machines[ABSTRACT].state.iter().copied().zip(state.iter().copied());
    let other = machines[CONCRETE].state.iter().copied().zip(other.iter().copied());
    Replacement::new(one.chain(other))
}
