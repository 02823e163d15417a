//! The chart as text, for `groundstate dump chart` and golden tests: machines, shapes, transitions.

use std::fmt::Write;

use crate::chart::{Chart, Control, Machine, ShapeKind};
use crate::flow::{Origin, Target, transitions};

/// The chart as text: each machine's shapes and transitions.
pub fn dump(chart: &Chart) -> String {
    let mut out = format!("chart {}\n", chart.name);
    for import in chart.charts.iter().chain(&chart.imports) {
        let _ = writeln!(out, "import {import}");
    }
    for machine in &chart.machines {
        one(&mut out, chart, machine);
    }
    out
}

fn one(out: &mut String, chart: &Chart, machine: &Machine) {
    let word = if machine.is_pattern { "pattern" } else { "machine" };
    let parameters: Vec<String> =
        machine.parameters.iter().map(|parameter| format!("{} in {}", parameter.variable, parameter.domain)).collect();
    let _ = writeln!(out, "\n{word} {}({}) {:?}", machine.name, parameters.join(", "), machine.text);
    match &machine.control {
        Some(Control::Linked(link)) => _ = writeln!(out, "  control {{{}}}", link.text),
        Some(Control::Made { name, .. }) => _ = writeln!(out, "  control {name}"),
        None => {}
    }
    for shape in &machine.shapes {
        let kind = match &shape.kind {
            ShapeKind::State { initial: true } => "initial state".to_string(),
            ShapeKind::State { initial: false } => "state".to_string(),
            ShapeKind::Composite(composite) => {
                format!("{}composite state", if composite.initial { "initial " } else { "" })
            }
            ShapeKind::Guard => "guard".to_string(),
            ShapeKind::Action => "action".to_string(),
            ShapeKind::Instance(pattern) => format!("instance of {}({})", pattern.name, pattern.arguments.join(", ")),
        };
        let link = shape.link.as_ref().map(|link| format!(" {{{}}}", link.text)).unwrap_or_default();
        let refinement = shape.refinement.as_ref().map(|refinement| match &refinement.by {
            Some(by) => format!(" to refine by {by}"),
            None => " to refine".to_string(),
        });
        let _ = writeln!(out, "  {kind} {} {:?}{link}{}", shape.name, shape.text, refinement.unwrap_or_default());
    }
    let machine = machine.flat();
    for transition in transitions(chart, machine) {
        let name = |id| machine.shape(id).name.as_str();
        let origin = match transition.origin {
            Origin::Enter => "enter".to_string(),
            Origin::State(id) => name(id).to_string(),
            Origin::Left(id) => format!("{} left", name(id)),
        };
        let guards =
            transition.guards.iter().map(|(id, holds)| format!("{}{}", if *holds { "" } else { "not " }, name(*id)));
        let guards: Vec<String> = guards.collect();
        let actions: Vec<&str> = transition.actions.iter().map(|id| name(*id)).collect();
        let target = match transition.target {
            Target::State(id) | Target::Block(id) => name(id),
            Target::Exit => "exit",
        };
        let _ = writeln!(out, "  {origin} --[{}]/{}--> {target}", guards.join(" and "), actions.join(", "));
    }
}
