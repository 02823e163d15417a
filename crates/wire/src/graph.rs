//! The states of a small model and the steps between them, as JSON objects.

use groundstate::tell::{FoundStep, Verdicts};
use groundstate::verify::listing::{Leads, ListedState, ListedStep, Listing};
use machine::Show;
use serde::Serialize;

/// `{"type":"graph-state",…}`: a state with its steps.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct GraphState {
    #[cfg_attr(test, schemars(extend("const" = "graph-state")))]
    r#type: &'static str,
    /// Its number; initial states come first, then the others by distance.
    pub state: usize,
    /// Whether a run may begin in it.
    pub initial: bool,
    /// How many steps it is from an initial state.
    pub depth: u64,
    /// Its locations with their values.
    pub values: Vec<(String, String)>,
    /// The invariants that do not hold in it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub violated: Vec<String>,
    /// Of each term asked for, whether it is true; null where it has no value.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub holds: Vec<Option<bool>>,
    /// Whether all its steps are here.
    pub whole: bool,
    /// Its steps, those to the same state as one.
    pub steps: Vec<GraphStep>,
}

/// The steps from a state to another.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct GraphStep {
    /// The state that they lead to; null if they cannot be made.
    pub to: Option<usize>,
    /// Why they cannot be made.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fault: Option<String>,
    /// How many ways there are.
    pub ways: u64,
    /// What the first of them read.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub inputs: Vec<(String, String)>,
    /// What the first of them chose, in words.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub choices: Vec<String>,
}

impl GraphState {
    /// The state of this number.
    pub fn new(words: &Verdicts<'_>, state: usize, listed: &ListedState) -> GraphState {
        let program = words.program;
        let pair = |(location, value): &(machine::Location, machine::Value)| {
            (location.show(program).to_string(), value.show(program).to_string())
        };
        GraphState {
            r#type: "graph-state",
            state,
            initial: listed.is_initial,
            depth: listed.depth,
            values: listed.values.iter().map(pair).collect(),
            violated: listed.violated.iter().map(|index| program.properties[*index].name.clone()).collect(),
            holds: listed.holds.clone(),
            whole: listed.is_whole,
            steps: listed.steps.iter().map(|step| GraphStep::new(words, step)).collect(),
        }
    }
}

impl GraphStep {
    fn new(words: &Verdicts<'_>, step: &ListedStep) -> GraphStep {
        let FoundStep { inputs, choices, .. } = words.way(step);
        let (to, fault) = match &step.leads {
            Leads::To(to) => (Some(*to), None),
            Leads::Fault(fault) => (None, Some(fault.show(words.program).to_string())),
            Leads::Open(unbounded) => (None, Some(words.unbounded(unbounded).message)),
        };
        GraphStep { to, fault, ways: step.ways, inputs, choices }
    }
}

/// `{"type":"graph",…}`: how much of the state graph there is.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Graph {
    #[cfg_attr(test, schemars(extend("const" = "graph")))]
    r#type: &'static str,
    /// Whether every reachable state is there with all its steps.
    pub complete: bool,
    /// Why not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// How many states there are.
    pub states: usize,
    /// How many steps there are, those between the same states as one.
    pub steps: usize,
}

impl Graph {
    /// What there is of it, and in a clause why it is not all.
    pub fn new(listing: &Listing, reason: Option<String>) -> Graph {
        Graph {
            r#type: "graph",
            complete: listing.is_complete(),
            reason,
            states: listing.states.len(),
            steps: listing.states.iter().map(|state| state.steps.len()).sum(),
        }
    }
}
