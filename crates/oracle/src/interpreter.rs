//! What the evaluation of one step carries along besides the state and the variable assignment.
//!
//! The book's ⟦t⟧ and `yields` have the state 𝔄 and the assignment ζ as their only parameters. Four things that it
//! keeps outside are here: the inputs of this step (monitored functions are read once a step), the chooser, the reserve
//! from which `extend` takes its elements, and bounds, so that an endless evaluation is reported.

use std::collections::BTreeMap;

use model::{DomainId, Model, VariableId};

use crate::environment::{Environment, Tick};
use crate::fault::Fault;
use crate::state::{Location, State};
use crate::value::Value;

/// A variable assignment ζ (definition 2.4.8), with the agent that `self` denotes.
#[derive(Debug, Clone, Default)]
pub struct Assignment {
    values: BTreeMap<VariableId, Value>,
    /// The agent whose program is run.
    pub agent: Option<Value>,
    /// The location that replaces `result`.
    pub result: Option<Location>,
}

impl Assignment {
    /// No variable bound, and `self` denoting an agent.
    pub fn of_agent(agent: Value) -> Assignment {
        Assignment { values: BTreeMap::new(), agent: Some(agent), result: None }
    }

    /// ζ(x).
    pub fn get(&self, variable: VariableId) -> Value {
        self.values.get(&variable).cloned().expect("the checker has every variable bound")
    }

    /// ζ[x ↦ a].
    pub fn with(&self, variable: VariableId, value: Value) -> Assignment {
        let mut extended = self.clone();
        extended.values.insert(variable, value);
        extended
    }

    /// The assignment of parameters, and nothing else, to values; `self` still denotes the same agent.
    pub fn parameters(&self, parameters: &[VariableId], values: Vec<Value>) -> Assignment {
        Assignment { values: parameters.iter().copied().zip(values).collect(), agent: self.agent.clone(), result: None }
    }

    /// The same with this in the place of `result`.
    pub fn returning(self, result: Option<Location>) -> Assignment {
        Assignment { result, ..self }
    }
}

/// Bounds on one step.
#[derive(Debug, Clone, Copy)]
pub struct Bounds {
    /// Rounds of all loops together.
    pub iterations: u64,
    /// Calls inside each other.
    pub depth: u64,
    /// Elements of one enumeration.
    pub elements: usize,
}

impl Default for Bounds {
    fn default() -> Self {
        Bounds { iterations: 10_000, depth: 100, elements: 100_000 }
    }
}

/// Initial values as far as they are known.
#[derive(Debug, Default)]
pub(crate) struct Initialisation {
    pub(crate) known: BTreeMap<Location, Value>,
    pub(crate) running: Vec<Location>,
}

/// See the head of this file.
pub struct Interpreter<'a> {
    pub(crate) model: &'a Model,
    pub(crate) environment: &'a mut dyn Environment,
    /// What the environment has answered in this step.
    pub(crate) inputs: &'a mut BTreeMap<Location, Value>,
    /// The state before the step, for `pre`.
    pub(crate) before: State,
    /// The initial state, once it is made.
    pub(crate) initial: State,
    /// There while the initial state is made.
    pub(crate) initialisation: Option<Initialisation>,
    /// What the clock has shown in this step.
    pub(crate) clock: Vec<(Tick, i64)>,
    /// The elements imported in this step and the domains they go into.
    pub(crate) imported: Vec<(DomainId, Value)>,
    /// The number of the next element of each abstract domain.
    pub(crate) reserve: BTreeMap<DomainId, u32>,
    /// The first variable that no instance of a macro rule uses.
    pub(crate) fresh_variable: u32,
    pub(crate) bounds: Bounds,
    pub(crate) rounds: u64,
    pub(crate) depth: u64,
}

/// Variables of declarations are numbered from 0; those of instances of macro rules from here.
const FIRST_INSTANCE: u32 = 1 << 20;

impl<'a> Interpreter<'a> {
    /// For one step, or for the making of the initial state.
    pub fn new(
        model: &'a Model,
        (initial, before): (&State, &State),
        environment: &'a mut dyn Environment,
        inputs: &'a mut BTreeMap<Location, Value>,
        bounds: Bounds,
    ) -> Self {
        Interpreter {
            model,
            environment,
            inputs,
            before: before.clone(),
            initial: initial.clone(),
            initialisation: None,
            clock: Vec::new(),
            imported: Vec::new(),
            reserve: BTreeMap::new(),
            fresh_variable: FIRST_INSTANCE,
            bounds,
            rounds: 0,
            depth: 0,
        }
    }

    /// Counts a round of a loop.
    pub(crate) fn round(&mut self) -> Result<(), Fault> {
        self.rounds += 1;
        if self.rounds > self.bounds.iterations { Err(Fault::Limit) } else { Ok(()) }
    }

    /// Evaluates within a call.
    pub(crate) fn call<T, E: From<Fault>>(&mut self, inside: impl FnOnce(&mut Self) -> Result<T, E>) -> Result<T, E> {
        if self.depth >= self.bounds.depth {
            return Err(Fault::Limit.into());
        }
        self.depth += 1;
        let result = inside(self);
        self.depth -= 1;
        result
    }

    /// Asks the environment for one of the candidates.
    pub(crate) fn choose(&mut self, mut candidates: Vec<Vec<Value>>) -> Result<Vec<Value>, Fault> {
        let index = self.environment.choose(self.model, &candidates).map_err(Fault::Environment)?;
        Ok(candidates.swap_remove(index))
    }
}
