//! Chart → AsmetaL: one readable rule a machine, in the shape of the paper's Listing 2.
//!
//! In: a chart without errors, what its imports declare ([`Known`]), and the text of the file as it stands, if there is
//! one. Out: the new text. What charts decide (the machines' rules, the control states) is written anew; every other
//! declaration and definition that the file has stays as it is, and what is missing is added.

mod known;
mod merge;
mod module;
mod rule;
pub(crate) mod system;

pub use known::{Known, Unknown};
pub(crate) use module::{call, function_name, rule_name, state_value};
pub(crate) use rule::{machine_rule, origin_condition};

use crate::chart::{Chart, Control};
use crate::fault;

/// What is built.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Built {
    /// The whole file.
    pub text: String,
    /// Names of rules and functions that were made and are still to be written, in order.
    pub to_write: Vec<String>,
}

/// What of a chart cannot be built; the places are those of the chart.
pub fn unbuilt(chart: &Chart, known: &Known) -> Vec<syntax::Diagnostic> {
    let mut faults = chart.system.as_ref().map(system::unbuilt).unwrap_or_default();
    for machine in &chart.machines {
        if let Some(Control::Made { name, span }) = &machine.control
            && known.terms.contains(name)
        {
            faults.push(fault::made_already(*span, name));
        }
    }
    faults
}

/// Builds the specification of a chart of which nothing is [`unbuilt`].
///
/// # Errors
/// The faults of `existing`, which is not touched then.
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
