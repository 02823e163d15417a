//! Numbers that identify what a checkpoint belongs to.
//!
//! In: a program, an explorer, or whatever else a search depends on. Out: a number that differs where they differ, but for collisions.

use std::fmt::{Debug, Write};

use program::Program;

use crate::explorer::Explorer;

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

/// A number for all of these together.
///
/// # Panics
/// Something cannot be shown.
pub fn hash(parts: &[&dyn Debug]) -> u64 {
    let mut hash = Hash(0xcbf2_9ce4_8422_2325);
    for part in parts {
        write!(hash, "{part:?}").expect("a hash takes any text");
    }
    hash.0
}

/// The number of a program, with its properties.
pub fn of_program(program: &Program) -> u64 {
    let Program { domains, functions, constants, terms, term_lists, rules, rule_lists, binder_lists, .. } = program;
    let Program { function_lists, procedures, main, initials, agents, properties, .. } = program;
    hash(&[
        &(domains, functions, constants, terms, term_lists, rules, rule_lists, binder_lists),
        &(function_lists, procedures, main, initials, agents, properties),
    ])
}

/// The number of the layout of packed states.
pub fn layout(explorer: &Explorer) -> u64 {
    let initial: Vec<&[u64]> = explorer.initial().iter().map(|(state, _)| state).collect();
    hash(&[&explorer.words(), &explorer.fields(), &initial])
}
