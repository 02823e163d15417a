//! Which rule of a program chooses who moves.

use program::{Program, Rule, RuleId};
use syntax::Span;

/// The choose rule that the main rule is, directly or through calls of macro rules; none if it is something else.
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
