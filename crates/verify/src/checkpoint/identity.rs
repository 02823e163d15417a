//! The number of the search that a checkpoint belongs to.
//!
//! In: a program and a plan. Out: a number for the program with its properties, bounds and machine limits. The extent of a search
//! (states, depth, memory, workers) is not part of it.

use explore::Settings;
use explore::checkpoint::{hash, of_program};
use program::Program;

use crate::plan::Plan;

/// The number of the searched program and its targets.
pub fn question(program: &Program, plan: &Plan) -> u64 {
    let Plan { settings, assumed, terminal, wanted, wanted_steps, storage, seed, partial_order, .. } = plan;
    // What makes the steps is no part of the question, nor what a search has compiled, nor who may interrupt it.
    let Settings {
        limits,
        bounds,
        conditions,
        step_conditions,
        in_pairs_from,
        read_in_steps,
        forgetful: _,
        engine: _,
        code: _,
        numbered,
        interrupt: _,
        observed,
        unordered,
    } = settings;
    hash(&[
        &of_program(program),
        &(limits, bounds, conditions, step_conditions, in_pairs_from, read_in_steps),
        &(numbered, observed, unordered),
        &(assumed, terminal, wanted, wanted_steps, storage, seed, partial_order),
    ])
}
