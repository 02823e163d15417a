//! Builds AsmetaL from a chart: one readable rule per machine, in the form of the paper's Listing 2.
//!
//! In: a chart without errors, the names that its imports declare ([`Known`]), and the present text of the file, if
//! any. Out: the new text. What charts determine (the machines' rules, the control states) is rewritten; every other
//! declaration and definition in the file stays as it is, and what is missing is added.

mod ages;
mod clash;
mod edit;
mod figures;
mod known;
mod lengths;
mod merge;
mod module;
mod observed;
mod rule;
mod running;
mod spelling;
pub(crate) mod system;
mod table;

pub use clash::clashes;
pub use figures::{Figure, figures};
pub(crate) use known::OWNED;
pub use known::{Known, Unknown};
pub use lengths::Lengths;
pub(crate) use rule::{machine_rule, origin_condition};
pub(crate) use spelling::{
    answer_location, answer_name, call, control_location, function_name, inner_control, instance_call, memory_location,
    of_instance, rule_name, state_value,
};
pub(crate) use system::taken;
pub use system::{budget, busy, late};

use crate::chart::{Chart, Control, Machine, ShapeKind};
use crate::component::{Cut, Reduction};
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
        let answer = answer_name(machine);
        if machine.answers() && known.terms.contains(&answer) {
            faults.push(fault::answer::made_already(machine.span, &answer));
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
                        _ if other.answers() && answer_name(other) == name => Some(other.span),
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

/// Why the system of a chart cannot be verified as it is drawn; the places are in the chart.
pub fn unverified(chart: &Chart, known: &Known) -> Vec<syntax::Diagnostic> {
    let Some(system) = &chart.system else {
        let file = chart.places.first().map_or(syntax::FileId(0), |place| place.file);
        let span = chart.machines.first().map_or(syntax::Span { file, start: 0, end: 0 }, |machine| machine.span);
        let help = "build the model with `groundstate chart build`, and verify that";
        return vec![fault::not_verified(span, "the chart has no system", "a system is verified as it is drawn", help)];
    };
    if system.components.is_empty() {
        let help = "add a `component` with its phases";
        return vec![fault::not_verified(system.span, "the system has no components", "nothing happens in it", help)];
    }
    let unbuilt = unbuilt(chart, known);
    if unbuilt.is_empty() && library(chart).is_none() {
        let here = "the patterns come with another module, which may have changed them";
        let help = "import ControlTask in the chart, too";
        return vec![fault::not_verified(system.span, "it is not known which patterns to verify", here, help)];
    }
    unbuilt
}

/// The folder of the pattern library, as the chart's imports write it.
pub fn library(chart: &Chart) -> Option<String> {
    chart.imports.iter().find_map(|import| folder_of_patterns(import))
}

/// The folder in an import of the module that brings all patterns.
fn folder_of_patterns(import: &str) -> Option<String> {
    let path = import.replace('\\', "/");
    let folder = path.trim_end_matches(".asm").strip_suffix("ControlTask")?;
    (folder.is_empty() || folder.ends_with('/')).then(|| folder.to_string())
}

/// The part of a chart that [`verified`] is about: its system with those of its components' machines on which the functions rest that are
/// asked about, and without what elaborations compute by rules.
pub fn verifiable(chart: &Chart, asks_about: &dyn Fn(&str) -> bool) -> Chart {
    let sliced = chart.system.as_ref().and_then(|system| crate::component::slice(system, asks_about));
    if let Some(sliced) = sliced {
        return Chart { system: Some(system::without_rules(sliced)), ..chart.clone() };
    }
    let mut bare = Chart { system: chart.system.as_ref().map(system::bare), ..chart.clone() };
    let own = |(import, _): &(String, syntax::Span)| folder_of_patterns(import).is_some();
    let imports = chart.imports.iter().cloned().zip(chart.places.iter().copied()).filter(own);
    (bare.imports, bare.places) = imports.unzip();
    bare
}

/// A part of a chart's system in whose runs are all that the system has, as far as some functions are concerned.
#[derive(Debug)]
pub struct Reduced {
    /// The system of the part.
    pub chart: Chart,
    /// The inputs that stand for what was left free.
    pub free: Vec<String>,
    /// Those of them that may be undef.
    pub undefined: Vec<String>,
    /// The components whose machines are a part of it.
    pub components: Vec<String>,
}

/// The part of a chart that is enough if these functions of machines rest on no more than is left: first only these functions, then, each time
/// it is widened, also what they read. None if there is none so wide that leaves anything out.
pub fn reduced(chart: &Chart, asks_about: &dyn Fn(&str) -> bool, widenings: usize) -> Option<Reduced> {
    let system = chart.system.as_ref()?;
    let mut reduction = Reduction::of(system, asks_about)?;
    for _ in 0..widenings {
        reduction = reduction.widened(system)?;
    }
    let Cut { system: part, free, undefined } = reduction.cut(system);
    let components = reduction.names(system).into_iter().map(str::to_string).collect();
    let chart = Chart { system: Some(system::without_rules(part)), ..chart.clone() };
    Some(Reduced { chart, free, undefined, components })
}

/// The functions of machines, sensors and actuators of a [`verifiable`] chart that [`verified`] keeps as they are in the ground model.
pub fn kept(chart: &Chart) -> Vec<String> {
    chart.system.as_ref().map(system::kept).unwrap_or_default()
}

/// The text of the model that verifies the system of a [`verifiable`] chart for which [`unbuilt`] is empty: the ground model with each state reduced
/// to what its rules can tell apart, so that the states are finitely many. It imports the modules of the pattern library from the
/// folder of its [`library`], those of the verification library from `verification/`, and further built-in libraries.
pub fn verified(chart: &Chart, libraries: &[&str], lengths: Lengths) -> Option<String> {
    let mut parts = system::verified(chart, chart.system.as_ref()?, &library(chart)?, lengths);
    parts.imports.extend(libraries.iter().filter(|name| **name != "CTLLibrary").map(|name| (*name).to_string()));
    let verified = Chart { name: format!("{}InTicks", chart.name), ..chart.clone() };
    let text = module::fresh(&verified, &parts);
    let text = text.split_once("*/").map_or(text.as_str(), |(_, rest)| rest);
    let text = format!("/* What is verified of {}.chart. */{text}", chart.name);
    Some(syntax::format(&syntax::parse_asmetal(syntax::FileId(0), &text)))
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
