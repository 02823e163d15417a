//! The title and description of a picture, for those who cannot see it: its transitions in sentences.

use std::fmt::Write;

use crate::chart::{Chart, Machine};
use crate::flow::{Origin, Target, transitions};

/// LIMIT: a description tells so many transitions.
const TOLD: usize = 60;

/// One line.
pub(super) fn title(machine: &Machine) -> String {
    machine.text.replace('\n', " ")
}

/// A sentence for each transition.
pub(super) fn description(chart: &Chart, machine: &Machine) -> String {
    let kind = if machine.is_pattern { "Pattern machine" } else { "Control-state machine" };
    let mut out = format!("{kind} {}.", machine.name);
    let text = |id| machine.shape(id).text.replace('\n', " ");
    let all = transitions(chart, machine);
    for transition in all.iter().take(TOLD) {
        let _ = match transition.origin {
            Origin::Enter => write!(out, " On entering"),
            Origin::State(id) => write!(out, " From {}", text(id)),
            Origin::Left(id) => write!(out, " When {} has been left", text(id)),
        };
        let guards: Vec<String> = transition
            .guards
            .iter()
            .map(|(id, holds)| format!("{} is {}", text(*id), if *holds { "true" } else { "false" }))
            .collect();
        if !guards.is_empty() {
            let _ = write!(out, ", if {}", guards.join(" and "));
        }
        let actions: Vec<String> = transition.actions.iter().map(|id| text(*id)).collect();
        if !actions.is_empty() {
            let _ = write!(out, ": {};", actions.join(", "));
        }
        let _ = match transition.target {
            Target::State(id) | Target::Block(id) => write!(out, " go to {}.", text(id)),
            Target::Exit => write!(out, " leave."),
        };
    }
    if all.len() > TOLD {
        let _ = write!(out, " And {} more transitions.", all.len() - TOLD);
    }
    out
}
