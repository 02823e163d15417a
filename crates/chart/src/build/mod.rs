//! Builds AsmetaL from a chart: one readable rule per machine, in the form of the paper's Listing 2.
//!
//! In: a chart without errors, the names that its imports declare ([`Known`]), and the present text of the file, if
//! any. Out: the new text. What charts determine (the machines' rules, the control states) is rewritten; every other
//! declaration and definition in the file stays as it is, and what is missing is added.

mod known;
mod merge;
mod module;
mod rule;
mod spelling;
pub(crate) mod system;

pub(crate) use known::OWNED;
pub use known::{Known, Unknown};
pub(crate) use rule::{machine_rule, origin_condition};
pub(crate) use spelling::{call, function_name, rule_name, state_value};
pub use system::{busy, late};

use crate::chart::{Chart, Control, Machine, ShapeKind};
use crate::fault;

/// The result of building.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Built {
    /// The whole file.
    pub text: String,
    /// Names of rules and functions that were created and are still to be written by hand, in order.
    pub to_write: Vec<String>,
}

/// The parts of a chart that cannot be built; the places are in the chart.
pub fn unbuilt(chart: &Chart, known: &Known) -> Vec<syntax::Diagnostic> {
    if chart.machines.is_empty() && chart.system.is_none() {
        let file = chart.places.first().map_or(syntax::FileId(0), |place| place.file);
        return vec![fault::empty_chart(syntax::Span { file, start: 0, end: 0 })];
    }
    let mut faults = chart.system.as_ref().map(|one| system::unbuilt(one, known)).unwrap_or_default();
    for machine in &chart.machines {
        if let Some(Control::Made { name, span }) = &machine.control
            && known.terms.contains(name)
        {
            faults.push(fault::made_already(*span, name));
        }
    }
    if chart.system.is_none() {
        faults.extend(twice(chart, known));
    }
    faults
}

/// Reports a name that two things would create: an action's rule and a machine's, or a guard's function and a control
/// variable. Links refer to existing names on purpose, so they do not count.
fn twice(chart: &Chart, known: &Known) -> Vec<syntax::Diagnostic> {
    let mut faults = Vec::new();
    for machine in &chart.machines {
        for shape in machine.shapes.iter().filter(|shape| shape.link.is_none()) {
            let text = call(machine, shape);
            let name = text.split(['(', '[']).next().unwrap_or_default();
            let machines = || chart.machines.iter();
            let (what, first) = match shape.kind {
                ShapeKind::Action if !known.rules.contains(name) => {
                    ("rule", machines().find(|other| rule_name(other) == name).map(|other| other.span))
                }
                ShapeKind::Guard if !known.terms.contains(name) => {
                    let control = |other: &Machine| match &other.control {
                        Some(Control::Made { name: made, span }) if made == name => Some(*span),
                        _ => None,
                    };
                    ("function", machines().find_map(control))
                }
                _ => continue,
            };
            faults.extend(first.map(|first| fault::made_twice(shape.span, what, name, first)));
        }
    }
    faults
}

/// The text that a chart's system is built to if there is no file yet, whatever the imports declare.
pub(crate) fn fresh(chart: &Chart) -> String {
    let known = Known::default();
    chart.system.as_ref().map_or_else(String::new, |one| module::fresh(chart, &system::parts(chart, one, &known)))
}

/// Builds the specification of a chart for which [`unbuilt`] is empty.
///
/// # Errors
/// The faults of `existing`; it is then left unchanged.
pub fn build(chart: &Chart, known: &Known, existing: Option<&str>) -> Result<Built, Vec<syntax::Diagnostic>> {
    let parts = match &chart.system {
        Some(system) => system::parts(chart, system, known),
        None => module::parts(chart, known),
    };
    let (text, there) = match existing {
        None => (module::fresh(chart, &parts), Vec::new()),
        Some(text) => merge::into(text, chart, &parts)?,
    };
    let to_write = parts.to_write.into_iter().filter(|name| !there.contains(name)).collect();
    let parse = syntax::parse_asmetal(syntax::FileId(0), &text);
    Ok(Built { text: syntax::format(&parse), to_write })
}
