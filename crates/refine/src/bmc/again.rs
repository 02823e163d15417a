//! A run that a solver found, made again by both machines.
//!
//! In: the solver's values. Out: a [`Refutation`]. The concrete machine follows the run, step by step ([`crate::side`]); then the game on
//! pairs ([`crate::game`]) is played with these steps of it alone, and inputs of the abstract machine that it shares have the values of the
//! run. INVARIANT: what is lost in this game is lost in the whole game: the concrete machine can do more there, and what values were left
//! out counts for the abstract machine, as for every bound.

use std::collections::{BTreeMap, BTreeSet};

use explore::{Told, Widening};
use machine::{Location, Value};
use program::FunctionId;
use solve::session::Constant;
use solve::symbol::value_of;

use super::unrolled::Unrolled;
use crate::coupling::Coupling;
use crate::evidence::{Refutation, refutation};
use crate::formulas::Begun;
use crate::formulas::ask::Model;
use crate::formulas::symbolic::input_location;
use crate::formulas::values::{Values, least, values};
use crate::game::{Parents, Rules, solve};
use crate::options::Options;
use crate::product::{Node, Product};
use crate::refine::{begun as begin, why_of};
use crate::report::Why;
use crate::side::{StateId, Stopped, Unmade};
use crate::{ABSTRACT, CONCRETE};

/// LIMIT: so many pairs of states are looked at.
const PAIRS: usize = 20_000;
/// LIMIT: so many steps of one state.
const STEPS: u64 = 20_000;

/// Why a run refutes nothing.
pub(super) enum Again {
    /// The machines do something else.
    Odd,
    /// What they do there cannot be gone through.
    Unclear(Why),
    Stopped,
}

/// A step of the concrete machine: its inputs, and the values behind it; none of a step that cannot be made.
struct Made {
    inputs: BTreeMap<Location, Value>,
    to: Option<Vec<(Location, Value)>>,
}

/// The run that a solver's values say.
fn run(unrolled: &Unrolled<'_>, model: &Model, values: &Values<'_>) -> Result<Vec<Made>, Again> {
    let machine = unrolled.machines[CONCRETE];
    let mut run = Vec::new();
    for step in &unrolled.steps {
        let mut inputs = BTreeMap::new();
        for (input, own) in &step.inputs {
            let Some((function, arguments, shape)) = input_location(input) else { continue };
            let constant = model.get(own).copied().unwrap_or_else(|| least(&unrolled.store.terms, *own));
            let value = value_of(&unrolled.store.codes, shape, constant).ok_or(Again::Odd)?;
            inputs.insert(Location { function, arguments: arguments.to_vec() }, value);
        }
        let goes = values.truth(step.goes);
        let to = goes.then(|| values.state(machine, &step.to, None));
        run.push(Made { inputs, to });
        if !goes {
            break;
        }
    }
    Ok(run)
}

/// Options in which inputs of the abstract machine have the values of the run.
fn narrowed(coupling: &Coupling, options: &Options, unrolled: &Unrolled<'_>, values: &Values<'_>) -> Options {
    let mut options = options.clone();
    let machine = unrolled.machines[ABSTRACT];
    let mut offered: BTreeMap<FunctionId, BTreeSet<Value>> = BTreeMap::new();
    for input in &machine.inputs {
        let (Some((function, _, shape)), Some(id)) = (input_location(input), unrolled.store.variable(input.variable))
        else {
            continue;
        };
        if !coupling.shared[ABSTRACT].contains_key(&function) {
            continue;
        }
        let all = unrolled.steps.iter().filter_map(|step| step.offered.get(&id)).flatten();
        let all = all.filter(|(_, valid)| values.truth(*valid)).filter_map(|(value, _)| values.value(shape, *value));
        offered.entry(function).or_default().extend(all);
    }
    let extent = &mut options.extents[ABSTRACT];
    for (function, all) in offered {
        let before = extent.bounds.get(&function);
        let all: Vec<Value> =
            all.into_iter().filter(|value| before.is_none_or(|before| before.contains(value))).collect();
        if !all.is_empty() {
            extent.assumed.remove(&function);
            extent.bounds.insert(function, all);
        }
    }
    options
}

/// The refutation that a run is, if the machines make it and it is one.
pub(super) fn again(
    coupling: &Coupling,
    options: &Options,
    unrolled: &Unrolled<'_>,
    starts: &[Vec<Told>; 2],
    begun: &[Begun],
    model: &Model,
) -> Result<Refutation, Again> {
    let values = values(unrolled.store, model);
    let start = match values.constant(unrolled.chosen) {
        Some(Constant::Integer(number)) => usize::try_from(number).ok().and_then(|number| begun.get(number)),
        _ => None,
    };
    let start = start.ok_or(Again::Odd)?.concrete;
    debug_assert!(start < starts[CONCRETE].len());
    let run = run(unrolled, model, &values)?;
    let options = narrowed(coupling, options, unrolled, &values);
    let mut widenings: [Widening; 2] = Default::default();
    loop {
        let begun = begin(coupling, &options, &widenings, None).map_err(|_| Again::Odd)?;
        let (side, widening) = match begun {
            Err(narrow) => narrow,
            Ok(mut product) => match played(&mut product, start, &run) {
                Err(Unplayed::Narrow(side, widening)) => (side, widening),
                Err(Unplayed::Not(again)) => return Err(again),
                Ok(refutation) => return Ok(refutation),
            },
        };
        widenings[side].merge(&widening);
    }
}

/// Why the game was not played to its end.
enum Unplayed {
    Narrow(usize, Widening),
    Not(Again),
}

impl From<Stopped> for Unplayed {
    fn from(stopped: Stopped) -> Unplayed {
        match stopped {
            Stopped::Narrow(side, widening) => Unplayed::Narrow(side, widening),
            Stopped::Interrupted => Unplayed::Not(Again::Stopped),
            Stopped::Many => Unplayed::Not(Again::Unclear(Why::Steps(STEPS))),
        }
    }
}

/// Follows the run, and plays the game on it.
fn played(product: &mut Product<'_>, start: usize, run: &[Made]) -> Result<Refutation, Unplayed> {
    product.sides.iter_mut().for_each(|side| side.most = STEPS);
    let mut different: Vec<StateId> = Vec::new();
    for (_, state, _) in &product.begun {
        if !different.contains(state) {
            different.push(*state);
        }
    }
    let mut state = *different.get(start).ok_or(Unplayed::Not(Again::Odd))?;
    for made in run {
        match product.follow(state, &made.inputs, made.to.as_deref()) {
            Ok(Some(next)) => state = next,
            Ok(None) => break,
            Err(Unmade::Odd) => return Err(Unplayed::Not(Again::Odd)),
            Err(Unmade::Unbounded(unbounded)) => {
                return Err(Unplayed::Not(Again::Unclear(Why::Unbounded(CONCRETE, unbounded))));
            }
            Err(Unmade::Stopped(stopped)) => return Err(stopped.into()),
        }
    }
    let mut next = 0;
    while next < product.pairs.len() {
        if next >= PAIRS {
            return Err(Unplayed::Not(Again::Unclear(Why::Pairs(PAIRS as u64))));
        }
        product.explore(next as u32)?;
        next += 1;
    }
    product.sides.iter_mut().for_each(|side| side.ignore_interrupts());
    let hopeful = solve(product, &Parents::of(product), Rules::of(product, true));
    match hopeful.won {
        false => Ok(refutation(product, &hopeful)),
        true => {
            let unclear = product.nodes.iter().find_map(|node| match node {
                Node::Answers(end) => end.unclear,
                _ => None,
            });
            let why = unclear.map(|unclear| why_of(product, unclear));
            Err(Unplayed::Not(why.map_or(Again::Odd, Again::Unclear)))
        }
    }
}
