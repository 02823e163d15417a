//! What a checkpoint is of: numbers that are the same where a search means the same.
//!
//! In: a program and a plan, an explorer. Out: a number of the program with its properties, bounds and limits of the machine;
//! one of how states are packed. How far a search goes (states, depth, memory, workers) is no part of it.

use std::fmt::{Debug, Write};

use explore::Explorer;
use program::Program;

use crate::plan::Plan;

/// FNV-1a over what is written.
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

/// The number of what is searched, and for what.
pub fn question(program: &Program, plan: &Plan) -> u64 {
    let Program { domains, functions, constants, terms, term_lists, rules, rule_lists, binder_lists, .. } = program;
    let Program { function_lists, procedures, main, initials, agents, properties, .. } = program;
    let Plan { settings, assumed, terminal, wanted, wanted_steps, storage, seed, partial_order, .. } = plan;
    hash(&[
        &(domains, functions, constants, terms, term_lists, rules, rule_lists, binder_lists),
        &(function_lists, procedures, main, initials, agents, properties),
        &(settings, assumed, terminal, wanted, wanted_steps, storage, seed, partial_order),
    ])
}

/// The number of how states are packed.
pub fn layout(explorer: &Explorer) -> u64 {
    let initial: Vec<&[u64]> = explorer.initial().iter().map(|(state, _)| &**state).collect();
    hash(&[&explorer.words(), &explorer.fields(), &initial])
}
