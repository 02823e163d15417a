//! Rules that no step of any reachable state runs.
//!
//! In: by rule, whether some step ran it, of all states. Out: the places of rules that never ran though the rule around them, or a call of
//! them, did. A rule that stands in the program several times, specialised for its callers, ran if one of them did.

use std::collections::{BTreeMap, BTreeSet};

use program::{Program, Rule, RuleId};
use syntax::Span;

/// See the module.
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
