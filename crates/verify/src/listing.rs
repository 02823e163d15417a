//! Every state of a small model with every step between them, listed one by one: what a picture of the state graph is made of.
//!
//! In: a program, how far to go, and terms. Out: a [`Listing`]; states are numbered as they are met, initial ones first, then by
//! distance. INVARIANT: if nothing stopped it and every state is whole, the listing has all reachable states with all their steps. What
//! the model assumes leaves out states and steps, as in a search. It decides nothing: verdicts are those of a verification.

use std::collections::BTreeMap;
use std::sync::Arc;

use explore::{ChoiceTaken, Explorer, Outcome, Path, Trouble, Truth, Unbounded, Widening};
use machine::{FaultKind, Location, Value};
use program::{Expression, Program};

use crate::explorers::{Maker, widened};
use crate::options::Options;
use crate::progress::{Progress, Stop};
use crate::question::Question;
use crate::report::NoStart;

/// Where a step leads.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Leads {
    /// To the state of this number.
    To(usize),
    /// Nowhere: it cannot be made; why.
    Fault(Box<machine::Fault>),
    /// To what cannot be gone through.
    Open(Unbounded),
}

/// The ways from a state to one goal.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ListedStep {
    /// Where they lead.
    pub leads: Leads,
    /// How many there are.
    pub ways: u64,
    /// The inputs of the first.
    pub inputs: Vec<(Location, Value)>,
    /// The choices of the first.
    pub choices: Vec<ChoiceTaken>,
}

/// A state.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ListedState {
    /// Its locations that have a value.
    pub values: Vec<(Location, Value)>,
    /// Whether a run may begin in it.
    pub is_initial: bool,
    /// How many steps it is from an initial state.
    pub depth: u64,
    /// The properties of the program, by number, that are invariants and do not hold in it.
    pub violated: Vec<usize>,
    /// Of each term whether it is true in it; none where it has no value there.
    pub holds: Vec<Option<bool>>,
    /// All its steps are listed.
    pub is_whole: bool,
    /// Its steps, in the order of their first ways.
    pub steps: Vec<ListedStep>,
}

/// See the module.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Listing {
    /// The states.
    pub states: Vec<ListedState>,
    /// What ended it before all states were whole, if something did.
    pub stop: Option<Stop>,
    /// Whether something that is assumed, or an invariant, could not be decided in a state.
    pub is_unsure: bool,
}

impl Listing {
    /// Whether it has every reachable state with all its steps.
    pub fn is_complete(&self) -> bool {
        self.stop.is_none() && !self.is_unsure && self.states.iter().all(|state| state.is_whole)
    }
}

/// Lists the states of a program. Of the options those count that bound the search and its inputs; `terms` are conditions of the
/// program. `watch` receives progress and tells whether to go on.
///
/// # Errors
/// There is no initial state.
pub fn list(
    program: &Arc<Program>,
    options: &Options,
    terms: &[Expression],
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Listing, NoStart> {
    let question = Question::of(program, options);
    let attempt = |widening: &Widening| {
        let explorer = Maker::new(program, &question.plan, widening).first()?;
        Lister { question: &question, options, terms, explorer, numbers: BTreeMap::new(), packed: Vec::new() }
            .list(watch)
    };
    Ok(widened(attempt)?)
}

struct Lister<'a> {
    question: &'a Question,
    options: &'a Options,
    terms: &'a [Expression],
    explorer: Explorer,
    numbers: BTreeMap<Box<[u64]>, usize>,
    packed: Vec<Box<[u64]>>,
}

impl Lister<'_> {
    fn list(mut self, watch: &mut dyn FnMut(&Progress) -> bool) -> Result<Listing, Trouble> {
        let mut listing = Listing::default();
        let starts: Vec<Box<[u64]>> = self.explorer.initial().iter().map(|(state, _)| state.into()).collect();
        for state in starts {
            self.number(&mut listing, state, 0);
        }
        let (mut next, mut transitions) = (0, 0);
        while next < listing.states.len() {
            let depth = listing.states[next].depth;
            let progress = Progress {
                states: listing.states.len() as u64,
                transitions,
                queue: (listing.states.len() - next) as u64,
                depth,
                ..Progress::default()
            };
            if !watch(&progress) {
                let cause = self.options.interrupt.cause();
                listing.stop = Some(cause.map_or(Stop::Asked, Stop::from));
                break;
            }
            if depth >= self.options.max_depth {
                listing.stop = listing.stop.or(Some(Stop::Depth));
            } else {
                self.expand(&mut listing, next)?;
                transitions += listing.states[next].steps.len() as u64;
            }
            next += 1;
        }
        Ok(listing)
    }

    /// The number of a state; none if there is no room for it. What is assumed holds of it.
    fn number(&mut self, listing: &mut Listing, packed: Box<[u64]>, depth: u64) -> Number {
        if let Some(known) = self.numbers.get(&packed) {
            return Number::Of(*known);
        }
        let plan = &self.question.plan;
        for condition in &plan.assumed {
            let truth = self.explorer.truth(*condition, &packed);
            listing.is_unsure |= matches!(truth, Truth::Fault | Truth::Unknown);
            if truth != Truth::True {
                return Number::LeftOut;
            }
        }
        if listing.states.len() as u64 >= self.options.max_states {
            listing.stop = listing.stop.or(Some(Stop::States));
            return Number::NoRoom;
        }
        let mut violated = Vec::new();
        for condition in &plan.wanted {
            match self.explorer.truth(*condition, &packed) {
                Truth::True => {}
                Truth::Unknown => listing.is_unsure = true,
                Truth::False | Truth::Undef | Truth::Fault => violated.push(self.question.property_of(*condition)),
            }
        }
        let holds = self.terms.iter().map(|term| match self.explorer.evaluate(term, &packed) {
            Ok(Value::Boolean(holds)) => Some(holds),
            _ => None,
        });
        let holds = holds.collect();
        let number = listing.states.len();
        listing.states.push(ListedState {
            values: self.explorer.values(&packed),
            is_initial: depth == 0,
            depth,
            violated,
            holds,
            is_whole: false,
            steps: Vec::new(),
        });
        self.numbers.insert(packed.clone(), number);
        self.packed.push(packed);
        Number::Of(number)
    }

    /// Lists the steps of a state.
    fn expand(&mut self, listing: &mut Listing, from: usize) -> Result<(), Trouble> {
        let (packed, depth) = (self.packed[from].clone(), listing.states[from].depth + 1);
        let mut paths: Vec<Path> = Vec::new();
        let all = self.explorer.paths(&packed, &mut |path| paths.push(path)).map_err(Trouble::TooNarrow)?;
        let mut is_whole = all;
        let mut steps: Vec<ListedStep> = Vec::new();
        for path in paths {
            let leads = match path.outcome {
                Outcome::Next(next) => match self.number(listing, next, depth) {
                    Number::Of(number) => Leads::To(number),
                    Number::LeftOut => continue,
                    Number::NoRoom => {
                        is_whole = false;
                        continue;
                    }
                },
                Outcome::Fault(fault) if matches!(fault.kind, FaultKind::Interrupted(_)) => {
                    is_whole = false;
                    continue;
                }
                Outcome::Fault(fault) => Leads::Fault(fault),
                Outcome::Unbounded(unbounded) => {
                    is_whole = false;
                    Leads::Open(unbounded)
                }
                Outcome::Excluded => continue,
            };
            match steps.iter_mut().find(|step| step.leads == leads) {
                Some(step) => step.ways += 1,
                None => steps.push(ListedStep { leads, ways: 1, inputs: path.inputs, choices: path.choices }),
            }
        }
        let state = &mut listing.states[from];
        (state.is_whole, state.steps) = (is_whole, steps);
        Ok(())
    }
}

enum Number {
    Of(usize),
    /// Something that is assumed does not hold.
    LeftOut,
    NoRoom,
}
