//! Numbers that identify the search that a checkpoint belongs to.
//!
//! In: a program, a plan and an explorer. Out: a number for the program with its properties, bounds and machine limits;
//! a number for the layout of packed states. The extent of a search (states, depth, memory, workers) is not part of
//! them.

use std::fmt::{Debug, Write};

use explore::{Explorer, Settings};
use program::Program;

use crate::plan::Plan;

/// FNV-1a over what is written to it.
struct Hash(u64);

impl Write for Hash {
    fn write_str(&mut self, text: &str) -> std::fmt::Result {
        for byte in text.bytes().chain([0]) {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
        Ok(())
    }
}

fn hash(parts: &[&dyn Debug]) -> u64 {
    let mut hash = Hash(0xcbf2_9ce4_8422_2325);
    for part in parts {
        write!(hash, "{part:?}").expect("a hash takes any text");
    }
    hash.0
}

/// The number of the searched program and its targets.
pub fn question(program: &Program, plan: &Plan) -> u64 {
    let Program { domains, functions, constants, terms, term_lists, rules, rule_lists, binder_lists, .. } = program;
    let Program { function_lists, procedures, main, initials, agents, properties, .. } = program;
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
        &(domains, functions, constants, terms, term_lists, rules, rule_lists, binder_lists),
        &(function_lists, procedures, main, initials, agents, properties),
        &(limits, bounds, conditions, step_conditions, in_pairs_from, read_in_steps),
        &(numbered, observed, unordered),
        &(assumed, terminal, wanted, wanted_steps, storage, seed, partial_order),
    ])
}

/// The number of the layout of packed states.
pub fn layout(explorer: &Explorer) -> u64 {
    let initial: Vec<&[u64]> = explorer.initial().iter().map(|(state, _)| state).collect();
    hash(&[&explorer.words(), &explorer.fields(), &initial])
}
