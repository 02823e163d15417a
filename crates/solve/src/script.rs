//! Writes a question as SMT-LIB 2.6: one script that asks whether the condition holds in some state, and for that
//! state's values.
//!
//! Elements are encoded by their numbers; those after the last named one are unnamed. Integers have 64 bits: each
//! location is bounded, and the condition states for each operation that it does not fault.

use std::fmt::Write;

use crate::question::Question;
use crate::shared::{Script, Terms, VariableId};

/// The script; it asks for the values of the locations in order.
pub(crate) fn script(question: &Question) -> String {
    let Question { terms, unknowns, locations, .. } = question;
    let mut out = "(set-option :produce-models true)\n(set-logic ALL)\n".to_string();
    let all = terms.parts(question.given.iter().copied().chain([question.condition]));
    let mut symbols: Vec<VariableId> = all.iter().filter_map(|node| Some(question.location(*node)?.0)).collect();
    symbols.sort_unstable();
    symbols.dedup();
    symbols.retain(|id| unknowns.contains_key(id));
    Script::declare_bound(terms, &symbols, &mut out);
    for location in all.into_iter().filter(|node| question.location(*node).is_some()) {
        if let (Some(low), Some(high)) = terms.bounds(location) {
            let (low, high) = (Script::whole(low), Script::whole(high));
            let _ = writeln!(out, "(assert (<= {low} {} {high}))", Script::closed(terms, location));
        }
    }
    for known in question.given.iter().filter(|known| **known != Terms::TRUE) {
        let _ = writeln!(out, "(assert {})", Script::closed(terms, *known));
    }
    let _ = writeln!(out, "(assert {})\n(check-sat)", Script::closed(terms, question.condition));
    if !locations.is_empty() {
        let asked: Vec<String> = locations.iter().map(|location| Script::closed(terms, *location)).collect();
        let _ = writeln!(out, "(get-value ({}))", asked.join(" "));
    }
    out
}
