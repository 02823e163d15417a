//! The grammar of AsmetaL, Avalla and charts as a recursive descent, one file for each layer (spec/language.md).
//!
//! Each function parses one construct at the cursor and leaves the cursor after it. On a fault it reports the fault,
//! keeps what was read as part of the tree, and stops at a token from which a caller can go on.

mod binding;
#[cfg(test)]
mod brief;
mod chart;
mod chart_part;
mod collection;
mod conditional;
mod domain;
mod file;
mod function;
mod init;
mod list;
mod name;
mod operator;
mod property;
mod recovery;
mod rule;
mod scenario;
mod sets;
mod system;
mod term;

pub(crate) use chart::chart_file;
pub(crate) use file::source_file;
pub(crate) use operator::power_of;
pub(crate) use scenario::scenario_file;

use crate::parser::Parser;

/// `--until TERM`: a single term.
pub(crate) fn term_file(p: &mut Parser<'_>) {
    term::term(p, "a term");
    recovery::rest_of_file(p);
}
