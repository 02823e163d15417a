//! What the abstract machine can answer: its runs of so many steps, each with the condition that it can be made.
//!
//! In: the abstract machine as formulas, and the values that its inputs may have. Out: [`Run`]s, without a quantifier: the machine's own
//! choices are written out, one run for each. LIMIT: they must be finitely many, and few.

use std::collections::BTreeMap;

use program::FunctionId;
use rustc_hash::FxHashMap;
use solve::Outside;
use solve::encode::{Input, InputKind};
use solve::shared::{Kind, Node, Terms, VariableId};

use super::symbolic::{Replacement, Store, Symbolic, input_location, nowhere};

/// LIMIT: so many ways to make a step are written out.
const WAYS: usize = 512;
/// LIMIT: so many values of one choice.
const VALUES: i128 = 256;
/// LIMIT: shared terms.
const TERMS: usize = 3_000_000;

/// A value that an input may have, and the condition under which it may.
pub(crate) type Value = (Node, Node);

/// By input of the abstract machine, the values that it had so far in a diagram.
pub(crate) type Offered = FxHashMap<VariableId, Vec<Value>>;

/// A run of the abstract machine.
#[derive(Debug, Clone)]
pub(crate) struct Run {
    /// It can be made.
    pub made: Node,
    /// The values of the state's variables behind it.
    pub state: Vec<Node>,
}

/// The runs of so many steps from the state as it is.
///
/// # Errors
/// There are too many.
pub(crate) fn runs(
    machine: &Symbolic,
    store: &mut Store,
    names: &dyn Fn(FunctionId) -> String,
    offered: &Offered,
    m: u32,
) -> Result<Vec<Run>, Outside> {
    let mut found = vec![Run { made: Terms::TRUE, state: machine.here(&mut store.terms) }];
    if m == 0 {
        return Ok(found);
    }
    let ways = ways(machine, store, names, offered)?;
    for _ in 0..m {
        let mut longer: BTreeMap<Vec<Node>, Node> = BTreeMap::new();
        for run in &found {
            for way in &ways {
                if let Some(made) = step(machine, store, run, way) {
                    let known = longer.get(&made.state).copied().unwrap_or(Terms::FALSE);
                    let either = store.terms.or([known, made.made]);
                    longer.insert(made.state, either);
                }
                if longer.len() > WAYS || store.terms.count() > TERMS {
                    return Err(nowhere("an abstract machine that can do too many different things"));
                }
            }
        }
        found = longer.into_iter().map(|(state, made)| Run { made, state }).collect();
    }
    Ok(found)
}

/// Values of all inputs, and the condition that they may have them.
#[derive(Debug, Clone, Default)]
struct Way {
    values: Vec<(VariableId, Node)>,
    valid: Vec<Node>,
}

/// All ways to choose the inputs of a step.
fn ways(
    machine: &Symbolic,
    store: &mut Store,
    names: &dyn Fn(FunctionId) -> String,
    offered: &Offered,
) -> Result<Vec<Way>, Outside> {
    let mut ways = vec![Way::default()];
    for input in machine.used_inputs(&store.terms) {
        let Some(id) = store.variable(input.variable) else { continue };
        let values = match offered.get(&id) {
            Some(values) => values.clone(),
            None => own(store, names, &input, id)?.into_iter().map(|value| (value, Terms::TRUE)).collect(),
        };
        if ways.len() * values.len() > WAYS {
            return Err(nowhere(&format!("an abstract machine with more than {WAYS} choices of inputs in one step")));
        }
        let longer = |way: Way| {
            values.iter().map(move |(value, valid)| {
                let mut way = way.clone();
                way.values.push((id, *value));
                way.valid.push(*valid);
                way
            })
        };
        ways = ways.into_iter().flat_map(longer).collect();
    }
    Ok(ways)
}

/// The values that the abstract machine chooses among.
fn own(
    store: &mut Store,
    names: &dyn Fn(FunctionId) -> String,
    input: &Input,
    id: VariableId,
) -> Result<Vec<Node>, Outside> {
    let variable = store.terms.variable_of(id);
    match (variable.kind, variable.bounds) {
        (Kind::Boolean, _) => Ok(vec![Terms::FALSE, Terms::TRUE]),
        (Kind::Integer, (Some(low), Some(high))) if high - low < VALUES => {
            Ok((low..=high).map(|number| store.terms.integer(number)).collect())
        }
        _ => Err(nowhere(&match input_location(input) {
            Some((function, ..)) => {
                let name = names(function);
                format!(
                    "the input {name}, of which the abstract machine may take infinitely many values: say which, \
                     `input abstract.{name} = …;`"
                )
            }
            None if matches!(input.kind, InputKind::Rounding) => "a real number that is rounded".to_string(),
            None => "a choice of the abstract machine among infinitely many values".to_string(),
        })),
    }
}

/// A run with one step more; none if it can never be made.
fn step(machine: &Symbolic, store: &mut Store, run: &Run, way: &Way) -> Option<Run> {
    let state = machine.state.iter().copied().zip(run.state.iter().copied());
    let mut by = Replacement::new(state.chain(way.values.iter().copied()));
    let mut all = vec![run.made];
    all.extend(way.valid.iter().copied());
    for node in machine.given.iter().copied().chain([machine.goes]) {
        all.push(store.replaced(node, &mut by));
    }
    let (stray, fault) = (machine.stray(&mut store.terms), machine.fault(&mut store.terms));
    for node in [stray, fault] {
        let here = store.replaced(node, &mut by);
        all.push(store.terms.not(here));
    }
    if store.terms.and(all.iter().copied()) == Terms::FALSE {
        return None;
    }
    let state: Vec<Node> = machine.next.iter().map(|node| store.replaced(*node, &mut by)).collect();
    let mut there = Replacement::new(machine.state.iter().copied().zip(state.iter().copied()));
    all.push(store.replaced(machine.surely, &mut there));
    let made = store.terms.and(all);
    (made != Terms::FALSE).then_some(Run { made, state })
}
