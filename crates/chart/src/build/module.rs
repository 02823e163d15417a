//! The contents of a chart's file: the created names, stubs of what is still to be written, the machines' rules.
//!
//! In: a chart, and the names of its imports. Out: [`Parts`], and from these the text of a new file. If a machine has a
//! control variable of its own, the file is an `asm` that runs; a file of patterns only is a `module`.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::known::Known;
use super::rule::machine_rule;
use super::running::{Running, Start};
use super::spelling::{answer_name, applied, call, function_name, memory_name, rule_name, state_value};
use crate::chart::{Chart, Composite, Control, History, Machine, Shape, ShapeKind};
use crate::flow::is_block;

/// A declaration or definition.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Item {
    /// The name it declares.
    pub(super) name: String,
    /// Its text.
    pub(super) text: String,
    /// Whether the chart alone determines it, so that it is rewritten each time.
    pub(super) decided: bool,
}

/// The parts of the file.
#[derive(Debug, Clone, Default)]
pub(super) struct Parts {
    /// Imports.
    pub(super) imports: Vec<String>,
    /// Declarations of the signature.
    pub(super) declarations: Vec<Item>,
    /// The definitions.
    pub(super) definitions: Vec<Item>,
    /// The main rule of a file that runs.
    pub(super) main: Option<String>,
    /// The initial state of a file that runs.
    pub(super) init: Option<String>,
    /// How the main rule runs the machines of a chart without a system.
    pub(super) running: Vec<Running>,
    /// How their control variables begin.
    pub(super) starts: Vec<Start>,
    /// Whether the chart determines the elements of some domains, the main rule and the initial state.
    pub(super) owns: bool,
    /// Names that are still to be written by hand.
    pub(super) to_write: Vec<String>,
}

/// All parts of a chart's file.
pub(super) fn parts(chart: &Chart, known: &Known) -> Parts {
    let mut parts = Parts { imports: chart.imports.clone(), ..Parts::default() };
    if !known.terms.contains("isUndef") {
        parts.imports.insert(0, "StandardLibrary".to_string()); // the built-in one
    }
    let runs = |machine: &&Machine| !machine.is_pattern && matches!(machine.control, Some(Control::Made { .. }));
    domains(chart, known, &mut parts);
    controls(chart, known, &mut parts);
    answers(chart, &mut parts);
    for machine in &chart.machines {
        for shape in &machine.shapes {
            let of_a_machine =
                chart.machines.iter().any(|other| call(machine, shape).starts_with(&(rule_name(other) + "[")));
            stub(machine, shape, known, of_a_machine, &mut parts);
        }
    }
    for machine in &chart.machines {
        let name = rule_name(machine);
        let text = format!("// {}\n{}", machine.text.replace('\n', " "), machine_rule(chart, machine, &name));
        parts.definitions.push(Item { name, text, decided: true });
    }
    if chart.machines.iter().any(|machine| runs(&machine)) {
        let machines: Vec<&Machine> = chart.machines.iter().filter(|machine| !machine.is_pattern).collect();
        parts.running = machines.iter().map(|machine| running(machine)).collect();
        parts.starts = starts(chart, &machines.into_iter().filter(runs).collect::<Vec<_>>());
        parts.main = Some(main_rule(&parts.running));
        parts.init = Some(initial_state(&parts.starts));
    }
    parts
}

fn add(items: &mut Vec<Item>, name: &str, text: String, decided: bool) -> bool {
    let new = !items.iter().any(|item| item.name == name);
    if new {
        items.push(Item { name: name.to_string(), text, decided });
    }
    new
}

/// Adds domains of parameters that nothing declares, with one element each, so that the file runs.
fn domains(chart: &Chart, known: &Known, parts: &mut Parts) {
    for parameter in chart.machines.iter().flat_map(|machine| &machine.parameters) {
        let domain = &parameter.domain;
        let simple = domain.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        if simple && !known.domains.contains(domain) {
            // A domain that the file has already has elements of its own, or is an enumeration.
            let text = format!("abstract domain {domain}\nstatic {}1: {domain}\n", function_name(domain));
            add(&mut parts.declarations, domain, text, false);
        }
    }
}

/// Adds control variables and the domains of their values.
fn controls(chart: &Chart, known: &Known, parts: &mut Parts) {
    let mut made: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let mut order: Vec<(&Machine, String)> = Vec::new();
    for machine in &chart.machines {
        let name = match &machine.control {
            Some(Control::Made { name, .. }) => name.clone(),
            Some(Control::Linked(link)) if !known.terms.contains(&link.name) && link.is_application => {
                link.name.clone()
            }
            _ => continue,
        };
        let blocks = machine
            .numbered()
            .filter(|(id, shape)| matches!(shape.kind, ShapeKind::State { .. }) || is_block(chart, machine, *id));
        let values = made.entry(name.clone()).or_default();
        for value in blocks.map(|(id, _)| state_value(chart, machine, id)).filter(|value| !known.terms.contains(value))
        {
            if !values.contains(&value) {
                values.push(value);
            }
        }
        order.push((machine, name));
    }
    for (machine, name) in order {
        let domain = capitalised(&name) + if name.ends_with("State") { "" } else { "State" };
        let values = &made[&name];
        let text = format!("// the control states\nenum domain {domain} = {{ {} }}\n", values.join(" | "));
        add(&mut parts.declarations, &domain, text, true);
        let of = domain_of(machine);
        add(&mut parts.declarations, &name, format!("controlled {name}: {of}{domain}\n"), false);
        for composite in machine.shapes.iter().filter(|shape| remembers(shape)) {
            let memory = memory_name(composite);
            let note = format!("// where {} was left\n", composite.text.replace('\n', " "));
            add(&mut parts.declarations, &memory, format!("{note}controlled {memory}: {of}{domain}\n"), false);
        }
    }
}

/// Adds what patterns are left with.
fn answers(chart: &Chart, parts: &mut Parts) {
    for machine in chart.machines.iter().filter(|machine| machine.answers()) {
        let (name, of) = (answer_name(machine), domain_of(machine));
        let note = format!("// what {} answers\n", machine.text.replace('\n', " "));
        add(&mut parts.declarations, &name, format!("{note}controlled {name}: {of}Boolean\n"), false);
    }
}

/// The domain of a function of a machine's parameters, with its arrow.
fn domain_of(machine: &Machine) -> String {
    let of: Vec<&str> = machine.parameters.iter().map(|parameter| parameter.domain.as_str()).collect();
    match of[..] {
        [] => String::new(),
        [one] => format!("{one} -> "),
        _ => format!("Prod({}) -> ", of.join(", ")),
    }
}

/// Whether a function is to be made that remembers where a composite state was left.
fn remembers(shape: &Shape) -> bool {
    matches!(shape.composite(), Some(Composite { history: Some(History::Made), .. }))
}

fn capitalised(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}

/// The domains of the arguments of an application, if they are parameters of the machine.
fn parameters_of(machine: &Machine, text: &str) -> Option<Vec<(String, String)>> {
    let Some((_, rest)) = text.split_once(['(', '[']) else { return Some(Vec::new()) };
    let inner = rest.trim_end().trim_end_matches([')', ']']).trim();
    if inner.is_empty() {
        return Some(Vec::new());
    }
    let domain_of = |variable: &str| {
        let known = machine.parameters.iter().find(|parameter| parameter.variable == variable)?;
        Some((variable.to_string(), known.domain.clone()))
    };
    inner.split(',').map(|argument| domain_of(argument.trim())).collect()
}

/// Adds what a guard or an action stands for if nothing declares it: a monitored function, or a rule that does nothing
/// yet.
fn stub(machine: &Machine, shape: &Shape, known: &Known, of_a_machine: bool, parts: &mut Parts) {
    let text = call(machine, shape);
    let is_application = shape.link.as_ref().is_none_or(|link| link.is_application);
    let name = text.split(['(', '[', ' ']).next().unwrap_or_default();
    let Some(parameters) = parameters_of(machine, &text).filter(|_| is_application) else { return };
    let note = match &shape.refinement {
        Some(refinement) => match &refinement.by {
            Some(by) => format!("// to be refined by {by}\n"),
            None => "// to be refined\n".to_string(),
        },
        None => format!("// {}\n", shape.text.replace('\n', " ")),
    };
    let added = match shape.kind {
        ShapeKind::Guard if !known.terms.contains(name) => {
            let of: Vec<&str> = parameters.iter().map(|(_, domain)| domain.as_str()).collect();
            let of = match of[..] {
                [] => String::new(),
                [one] => format!("{one} -> "),
                _ => format!("Prod({}) -> ", of.join(", ")),
            };
            add(&mut parts.declarations, name, format!("{note}monitored {name}: {of}Boolean\n"), false)
        }
        ShapeKind::Action if !known.rules.contains(name) && !of_a_machine => {
            let of: Vec<String> =
                parameters.iter().map(|(variable, domain)| format!("{variable} in {domain}")).collect();
            let of = if of.is_empty() { String::new() } else { format!("({})", of.join(", ")) };
            add(&mut parts.definitions, name, format!("{note}rule {name}{of} = skip\n"), false)
        }
        _ => false,
    };
    if added {
        parts.to_write.push(name.to_string());
    }
}

fn running(machine: &Machine) -> Running {
    let rule = rule_name(machine);
    let call = applied(&rule, machine, '[', ']');
    let call = match &machine.parameters[..] {
        [] => call,
        _ => format!("forall {} with true do {call}", binders(machine)),
    };
    let control = match &machine.control {
        Some(Control::Made { name, .. }) => Some(name.clone()),
        _ => None,
    };
    Running { rule, call, control }
}

/// The parameters of a machine with their domains.
fn binders(machine: &Machine) -> String {
    let all = machine.parameters.iter().map(|parameter| format!("{} in {}", parameter.variable, parameter.domain));
    all.collect::<Vec<_>>().join(", ")
}

fn main_rule(machines: &[Running]) -> String {
    let calls: Vec<&str> = machines.iter().map(|machine| machine.call.as_str()).collect();
    match &calls[..] {
        [one] => format!("main rule r_Main =\n{one}\n"),
        several => format!("main rule r_Main =\npar\n{}\nendpar\n", several.join("\n")),
    }
}

/// How the control variables of machines begin, each once.
fn starts(chart: &Chart, machines: &[&Machine]) -> Vec<Start> {
    let mut all: Vec<Start> = Vec::new();
    for machine in machines {
        let (Some(Control::Made { name, .. }), Some(initial)) = (&machine.control, machine.initial()) else { continue };
        if all.iter().any(|start| start.control == *name) {
            continue;
        }
        let parameters = if machine.parameters.is_empty() { String::new() } else { format!("({})", binders(machine)) };
        let head = format!("function {name}{parameters} = ");
        all.push(Start { control: name.clone(), head, value: state_value(chart, machine, initial) });
    }
    all
}

fn initial_state(starts: &[Start]) -> String {
    let mut text = "default init s0:\n".to_string();
    for Start { head, value, .. } in starts {
        let _ = writeln!(text, "{head}{value}");
    }
    text
}

/// The text of a new file.
pub(super) fn fresh(chart: &Chart, parts: &Parts) -> String {
    let word = if parts.main.is_some() { "asm" } else { "module" };
    let decided = match &chart.system {
        Some(system) if !system.computing.ends.is_empty() => {
            "elements, the main rule, the initial state and what comes from its components' machines"
        }
        Some(_) => "elements, the main rule and the initial state",
        None => "rules of its machines and the domains of its control states",
    };
    let mut text = format!(
        "/* Made from {0}.chart. The {decided} are written\n   anew from there; all else is kept. */\n{word} {0}\n\n",
        chart.name
    );
    for (index, import) in parts.imports.iter().enumerate() {
        // A chart may name what its parts bring anyway.
        if !parts.imports[..index].contains(import) {
            let _ = writeln!(text, "import {}", quoted(import));
        }
    }
    if parts.main.is_none() {
        text.push_str("\nexport *\n");
    }
    text.push_str("\nsignature:\n");
    text.extend(parts.declarations.iter().map(|item| item.text.as_str()));
    text.push_str("\ndefinitions:\n");
    for item in &parts.definitions {
        let _ = writeln!(text, "{}", item.text);
    }
    text.extend(parts.main.as_deref());
    text.extend(parts.init.iter().map(|init| format!("\n{init}")));
    text
}

/// A path as written in an import.
pub(super) fn quoted(path: &str) -> String {
    if path.contains(' ') { format!("\"{path}\"") } else { path.to_string() }
}
