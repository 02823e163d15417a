//! Finds rules that no step of any reachable state runs.
//!
//! In: for each rule, whether some step ran it, over all states. Out: the places of rules that never ran although the
//! enclosing rule, or a call of them, did. A rule that occurs several times in the program, specialised for its
//! callers, ran if any of them ran.

use std::collections::{BTreeMap, BTreeSet};

use program::{Program, Rule, RuleId};
use syntax::Span;

/// The places of such rules.
pub fn unreachable_rules(program: &Program, executed: &[bool]) -> Vec<Span> {
    let mut ran: BTreeMap<Span, bool> = BTreeMap::new();
    for (rule, executed) in executed.iter().enumerate() {
        *ran.entry(program.rule_spans[rule]).or_default() |= executed;
    }
    let mut found = BTreeSet::new();
    for (rule, _) in executed.iter().enumerate().filter(|(_, executed)| **executed) {
        program.each_child_of_rule(RuleId(rule as u32), &mut |child| {
            if !ran[&program.rule_span(child)] && *program.rule(child) != Rule::Skip {
                found.insert(program.rule_span(child));
            }
        });
    }
    found.into_iter().collect()
}
