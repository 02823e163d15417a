//! Traceability: checks that a chart and its specification agree, transition by transition.
//!
//! In: a chart and the specification's text ([`probed`] adds the chart's own rules to it, under separate names), then
//! the result of checking that text. Out: faults, each with the places on both sides: links that lead nowhere or to the
//! wrong kind, transitions and actions that only one side has; notes on what is still to be refined.
//!
//! Both rules are executed symbolically for each value of the control variable. Their effects are compared exactly, as
//! propositional formulas over the tests. LIMIT: tests with different texts count as different.

mod anew;
mod ground;
mod paths;
pub(crate) mod system;

use std::collections::BTreeSet;
use std::ops::Range;

pub use anew::outdated;

use model::{Checked, FunctionId, Model, RuleId};
use solve::Solver;
use syntax::{Diagnostic, Severity, Span, SyntaxKind};

use crate::begin::{self, Initial, Otherwise};
use crate::build::{call, control_location, machine_rule, rule_name, state_value};
use crate::chart::{Chart, Control, Machine, ShapeKind};
use crate::differ::{by_effect, difference};
use crate::extract::{controls, origins};
use crate::fault::{self, Sides};
use crate::flow::{Origin, is_block, transitions};
use crate::read::flat;
use crate::symbolic::{Depth, Explorer, Guarded, Path, Reason, consistent};

/// A specification with the chart's rules added.
#[derive(Debug, Clone)]
pub struct Probed {
    /// The text.
    pub text: String,
    /// The range of each machine's rule in it.
    ranges: Vec<Range<usize>>,
}

/// Adds the chart's rules to the end of a specification's definitions, on one line, so that line numbers do not change.
///
/// # Errors
/// The faults of the specification's syntax.
pub fn probed(chart: &Chart, specification: &str) -> Result<Probed, Vec<Diagnostic>> {
    let parse = syntax::parse_asmetal(syntax::FileId(0), specification);
    if parse.diagnostics.iter().any(|fault| fault.severity == Severity::Error) {
        return Err(parse.diagnostics);
    }
    let root = parse.syntax();
    let definitions = root.children().find(|node| node.kind() == syntax::SyntaxKind::DEFINITIONS);
    let at = definitions.map_or(specification.len(), |node| syntax::ast::trimmed_range(&node).end().into());
    let mut text = specification[..at].to_string();
    let mut ranges = Vec::new();
    for (index, machine) in chart.machines.iter().enumerate() {
        text.push(' ');
        let start = text.len();
        text.push_str(&on_one_line(&machine_rule(chart, machine, &probe_name(index))));
        ranges.push(start..text.len());
    }
    text.push_str(&specification[at..]);
    Ok(Probed { text, ranges })
}

/// A rule's text without its comments.
fn on_one_line(rule: &str) -> String {
    let parse = syntax::parse_asmetal(syntax::FileId(0), &format!("module P\nsignature:\ndefinitions:\n{rule}"));
    let definitions = parse.syntax().children().find(|node| node.kind() == SyntaxKind::DEFINITIONS);
    let rules = definitions.iter().flat_map(|node| node.children()).map(|node| flat(&node));
    rules.collect::<Vec<_>>().join(" ")
}

fn probe_name(index: usize) -> String {
    format!("r_chart_{index}_probe")
}

/// Machines and patterns without a control state, whose control variable would have no value.
pub fn stateless(chart: &Chart) -> Vec<Diagnostic> {
    let is_empty = |machine: &&Machine| {
        let stays = |id| is_block(chart, machine, id) || matches!(machine.shape(id).kind, ShapeKind::State { .. });
        matches!(machine.control, Some(Control::Made { .. }))
            && !machine.numbered().any(|(id, shape)| stays(id) || shape.composite().is_some())
    };
    chart
        .machines
        .iter()
        .filter(is_empty)
        .map(|machine| fault::empty_machine(machine.span, machine.is_pattern, &machine.name))
        .collect()
}

/// The errors of a model that was built from a chart; those of links are reported in the chart. Without errors, the
/// model can be used.
pub fn built_faults(chart: &Chart, probed: &Probed, checked: &Checked) -> Vec<Diagnostic> {
    let (of_links, others) = located(chart, probed, checked);
    let known: BTreeSet<&str> = of_links.iter().map(|(message, _)| message.as_str()).collect();
    // The rule of a machine has the same fault in the built model and in the probe.
    let others = others.into_iter().filter(|fault| !known.contains(fault.message.as_str()));
    let mut faults: Vec<Diagnostic> = others.collect();
    faults.extend(of_links.into_iter().map(|(_, fault)| fault));
    faults.sort_by_key(|fault| (fault.primary.span.file, fault.primary.span.start));
    faults.dedup();
    faults
}

/// The errors of a probed specification: first those within a probe, moved to their links, with their former messages;
/// then the others.
fn located(chart: &Chart, probed: &Probed, checked: &Checked) -> (Vec<(String, Diagnostic)>, Vec<Diagnostic>) {
    let (mut of_links, mut others) = (Vec::new(), Vec::new());
    for diagnostic in checked.diagnostics.iter().filter(|found| found.severity == Severity::Error) {
        let place = diagnostic.primary.span;
        let start = place.start as usize;
        let machine = probed.ranges.iter().position(|range| place.file == checked.model.root && range.contains(&start));
        match machine.map(|index| &chart.machines[index]) {
            Some(machine) => {
                let fault = broken(machine, checked.sources.text(place), diagnostic);
                of_links.push((diagnostic.message.clone(), fault));
            }
            None => others.push(diagnostic.clone()),
        }
    }
    (of_links, others)
}

/// Compares a chart with its specification; `solver` decides guards that cannot be enumerated.
pub fn check(chart: &Chart, probed: &Probed, checked: &Checked, solver: &mut dyn Solver) -> Vec<Diagnostic> {
    let (of_links, mut faults) = located(chart, probed, checked);
    faults.extend(of_links.into_iter().map(|(_, fault)| fault));
    let root = checked.model.root;
    if faults.is_empty() {
        let mut guards = paths::Guards::over(&checked.model);
        chart.machines.iter().for_each(|machine| paths::paths(chart, machine, &mut guards, solver, &mut faults));
        for (index, machine) in chart.machines.iter().enumerate() {
            one(chart, machine, &probe_name(index), &checked.model, &mut faults);
        }
    }
    if let Some(system) = &chart.system {
        faults.extend(system::compare(chart, system, root, &checked.sources.file(root).text));
    }
    refinements(chart, &mut faults);
    faults.sort_by_key(|fault| (fault.primary.span.file, fault.primary.span.start));
    faults.dedup();
    faults
}

/// A fault within a probe, moved to the link that causes it.
fn broken(machine: &Machine, snippet: &str, diagnostic: &Diagnostic) -> Diagnostic {
    let shapes = machine.shapes.iter().map(|shape| {
        let text = match (&shape.kind, &shape.link) {
            (_, Some(link)) => link.text.clone(),
            (ShapeKind::Instance(pattern), None) => pattern.arguments.join(", "),
            (ShapeKind::State { .. }, None) => String::new(),
            _ => call(machine, shape),
        };
        (text, shape.link.as_ref().map_or(shape.span, |link| link.span))
    });
    let control = match &machine.control {
        Some(Control::Linked(link)) => Some((link.text.clone(), link.span)),
        Some(Control::Made { name, span }) => Some((name.clone(), *span)),
        None => None,
    };
    let all: Vec<(String, Span)> = shapes.chain(control).collect();
    let word = snippet.split(['(', '[', ' ']).next().unwrap_or(snippet);
    // A match with a whole link is more specific than one with a part.
    let exact = all.iter().find(|(text, _)| text == snippet);
    let whole = exact.or_else(|| all.iter().find(|(text, _)| text.contains(snippet)));
    let place = whole.or_else(|| all.iter().find(|(text, _)| text.contains(word))).map_or(machine.span, |(_, at)| *at);
    fault::broken_link(place, &diagnostic.message, diagnostic.help.as_deref())
}

fn refinements(chart: &Chart, faults: &mut Vec<Diagnostic>) {
    for shape in chart.machines.iter().flat_map(|machine| &machine.shapes) {
        if let Some(refinement) = &shape.refinement {
            faults.push(fault::to_refine(shape.span, &shape.name, refinement.by.as_deref()));
        }
    }
}

fn rule_named(model: &Model, name: &str) -> Option<RuleId> {
    model.rules.iter().position(|rule| rule.name == name).map(|index| RuleId(index as u32))
}

fn one(chart: &Chart, machine: &Machine, probe: &str, model: &Model, faults: &mut Vec<Diagnostic>) {
    let name = rule_name(machine);
    let place = machine.rule.as_ref().map_or(machine.span, |link| link.span);
    let (Some(rule), Some(probe)) = (rule_named(model, &name), rule_named(model, probe)) else {
        faults.push(fault::broken_link(place, &format!("there is no rule `{name}`"), None));
        return;
    };
    if model.rule(rule).parameters.len() != machine.parameters.len() {
        let message = format!("`{name}` takes {} parameters", model.rule(rule).parameters.len());
        faults.push(fault::broken_link(place, &message, None));
        return;
    }
    let declared = model.rule(rule);
    for (id, parameter) in declared.parameters.iter().zip(&machine.parameters) {
        let domain = model.domains.display(declared.variables[id.0 as usize].domain);
        if domain != parameter.domain {
            let message = format!("the parameter `{}` of `{name}` is in {domain}", parameter.variable);
            faults.push(fault::broken_link(
                place,
                &message,
                Some("declare the machine's parameter in the same domain"),
            ));
            return;
        }
    }
    let names: Vec<String> = machine.parameters.iter().map(|parameter| parameter.variable.clone()).collect();
    let location = compared(machine, model, probe);
    let controlled = location.as_ref().map(|(id, _)| *id);
    if let Some(otherwise) = begin::otherwise(chart, machine, model, rule, controlled) {
        let first = machine.initial().map_or(machine.span, |id| machine.shape(id).span);
        faults.push(match otherwise {
            Otherwise::NotRun => fault::beginning::machine_not_run(place, &name, declared.span),
            Otherwise::In { drawn, written, place } => {
                fault::beginning::other_beginning(first, &drawn, &written, place)
            }
            Otherwise::Computed { drawn, place } => fault::beginning::beginning_not_compared(first, &drawn, place),
        });
    }
    for early in begin::too_early(chart, machine, model) {
        faults.push(match early.given {
            Initial::Value(written, at) => {
                fault::beginning::begins_too_early(early.span, (&early.function, early.until), &written, at)
            }
            Initial::Computed(at) => {
                fault::beginning::undef_not_compared(early.span, (&early.function, early.until), at)
            }
        });
    }
    for (function, rule, span) in begin::intruders(chart, machine, model) {
        faults.push(fault::beginning::set_elsewhere(place, &function, &rule, span));
    }
    let (function, location, origins) = match location {
        Some((id, location)) => (id, location, origins(model, id)),
        None => (FunctionId(u32::MAX), String::new(), vec![String::new()]),
    };
    for origin in origins {
        let explorer = Explorer::new(model, function, location.clone(), origin.clone(), Depth::Full);
        match (explorer.rule(probe, &names), explorer.rule(rule, &names)) {
            (Ok(drawn), Ok(written)) => {
                let side = Side {
                    chart,
                    machine: machine.flat(),
                    origin: &origin,
                    control: &location,
                    rule: model.rule(rule).span,
                };
                side.compare(&drawn, &written, faults);
            }
            (_, Err(reason)) | (Err(reason), _) => {
                faults.push(fault::not_control_state(place, &name, reason_span(reason)));
                return;
            }
        }
    }
}

/// The control location of a machine as its own rule, which is given, writes it. The rule may also set other locations of the same
/// function, in what it calls.
fn compared(machine: &Machine, model: &Model, probe: RuleId) -> Option<(FunctionId, String)> {
    let control = control_location(machine)?;
    let bare = |text: &str| text.replace(char::is_whitespace, "");
    let name = |text: &str| text.split('(').next().map(bare);
    let same = controls(model, probe).into_iter().filter(|(_, location)| name(location) == name(&control));
    let (exactly, others): (Vec<_>, Vec<_>) = same.partition(|(_, location)| bare(location) == bare(&control));
    exactly.into_iter().chain(others).next()
}

fn reason_span(reason: Reason) -> Option<Span> {
    match reason {
        Reason::Hidden(span) | Reason::Computed(span) => Some(span),
        Reason::Large => None,
    }
}

/// One control state of a machine, on both sides.
struct Side<'c> {
    chart: &'c Chart,
    machine: &'c Machine,
    origin: &'c str,
    control: &'c str,
    /// The rule's name.
    rule: Span,
}

impl Side<'_> {
    fn compare(&self, drawn: &[Guarded], written: &[Guarded], faults: &mut Vec<Diagnostic>) {
        let (in_chart, in_rule) =
            (by_effect(drawn, self.control, self.origin), by_effect(written, self.control, self.origin));
        let keys: BTreeSet<&str> = in_chart.keys().chain(in_rule.keys()).map(String::as_str).collect();
        for key in keys {
            let nothing = (Vec::new(), None);
            let (drawn_here, _) = in_chart.get(key).unwrap_or(&nothing);
            let (written_here, place) = in_rule.get(key).unwrap_or(&nothing);
            let Some((case, chart_does)) = difference(drawn_here, written_here) else { continue };
            let mut instead = written.iter().filter(|guarded| consistent(&guarded.path, &case));
            let rule = match (chart_does, place) {
                (false, Some(place)) => (*place, "the rule does it here"),
                (_, Some(place)) => (*place, "the rule does it in other cases"),
                (_, None) => match instead.next() {
                    Some(guarded) => (guarded.span, "in this case the rule does this"),
                    None => (self.rule, "in this case the rule does nothing"),
                },
            };
            let transition = self.transition(&case);
            faults.push(fault::chart_differs(
                Sides { state: self.place(), transition, rule },
                self.origin,
                key,
                &case,
                chart_does,
            ));
        }
    }

    /// The end of the chart's transition in a case, if there is exactly one.
    fn transition(&self, case: &Path) -> Option<Span> {
        let bare = |text: &str| text.replace(char::is_whitespace, "");
        let fits = |one: &&crate::flow::Transition| {
            let here = match one.origin {
                Origin::Enter => self.origin == "undef",
                Origin::State(id) | Origin::Left(id) => state_value(self.chart, self.machine, id) == self.origin,
            };
            let guards: Path = one
                .guards
                .iter()
                .map(|(id, holds)| (bare(&call(self.machine, self.machine.shape(*id))), *holds))
                .collect();
            let case: Path = case.iter().map(|(atom, holds)| (bare(atom), *holds)).collect();
            here && consistent(&guards, &case)
        };
        let all = transitions(self.chart, self.machine);
        let mut fitting = all.iter().filter(fits);
        let first = fitting.next()?;
        fitting.next().is_none().then_some(first.span)
    }

    /// The state in the chart.
    fn place(&self) -> Span {
        let machine = self.machine;
        let state = machine.numbered().find(|(id, shape)| {
            let holds_value = matches!(shape.kind, ShapeKind::State { .. } | ShapeKind::Instance(_));
            holds_value && state_value(self.chart, machine, *id) == self.origin
        });
        state.map_or(machine.span, |(_, shape)| shape.span)
    }
}
