//! Finds the rule of a program that chooses who moves.

use program::{Program, Rule, RuleId};
use syntax::Span;

/// The choose rule that is the main rule, directly or through calls of macro rules; `None` if the main rule is
/// something else.
pub fn scheduler(program: &Program) -> Option<Span> {
    let mut entered = vec![false; program.procedures.len()];
    let mut procedure = program.main?;
    while !std::mem::replace(&mut entered[procedure.0 as usize], true) {
        let body: RuleId = program.procedure(procedure).body;
        match program.rule(body) {
            Rule::Choose { .. } => return Some(program.rule_span(body)),
            Rule::Call { procedure: called, .. } => procedure = *called,
            _ => return None,
        }
    }
    None
}
