//! Extracts charts from AsmetaL: finds rules in control-state form by what they do, not by how they are written.
//!
//! In: a checked model. Out: a [`Chart`] with a machine for each rule that tests and sets a control location (an enum
//! value or undef), in any nesting of `if`, `switch`, `let` and macro calls; for other rules that set such a location,
//! why they are no machines. Equal tails of paths share their shapes; [`nest()`] also finds composite states.
//!
//! INVARIANT: the written chart has no faults, and its rules do what the model's rules do ([`agrees`] checks this).

mod agrees;
mod decisions;
mod graph;
mod nest;
mod region;
mod shapes;

use std::collections::BTreeSet;
use std::sync::Arc;

use model::{Call, DomainKind, FunctionId, Model, RuleId, RuleKind};

use crate::begin::{Initial, UNDEF, initial_value};
use crate::chart::{Chart, Control, End, Machine, ShapeKind};
use crate::defined::always_defined;
use crate::flat::flattened;
use crate::symbolic::{Depth, Effect, Explorer, Guarded, Reason};
use graph::Graph;
use region::Region;
use shapes::unused;

/// The result of an extraction.
#[derive(Debug)]
pub struct Extracted {
    /// The machines.
    pub chart: Chart,
    /// Rules that set a control location but are not in control-state form, and why.
    pub others: Vec<(String, String)>,
    /// Rules that are also machines over further locations, and these locations: a chart has one machine per rule.
    pub further: Vec<(String, String)>,
}

/// Extracts the machines of a model's own rules, or of the rule `only`.
///
/// Without `control`, the control location is searched: one on which everything that the rule does depends; if a rule
/// has none, one on which some of it depends. With `control`, it is a location of that function. Rules that are parts
/// of machines get no machine of their own, unless they are named by `only`.
pub fn extract(model: &Model, only: Option<&str>, control: Option<&str>) -> Extracted {
    let chart = Chart { name: model.name.clone(), ..Chart::default() };
    let mut found = Extracted { chart, others: Vec::new(), further: Vec::new() };
    let mut judge = agrees::Judge::new(model);
    let mut left: Vec<(RuleId, FunctionId, String)> = Vec::new();
    for (index, rule) in model.rules.iter().enumerate() {
        let own = rule.span.file == model.root && !rule.turbo;
        if !only.map_or(own, |name| name == rule.name) {
            continue;
        }
        let id = RuleId(index as u32);
        let wanted = |function: FunctionId| control.is_none_or(|name| model.function(function).name == name);
        for (function, location) in controls(model, id).into_iter().filter(|(function, _)| wanted(*function)) {
            match machine(model, id, function, &location, control.is_none()) {
                Ok(Some(machine)) => match judge.refusal(&machine, id, function, &location) {
                    None => found.chart.machines.push(machine),
                    Some(reason) => found.others.push((rule.name.clone(), reason)),
                },
                Ok(None) => left.push((id, function, location)),
                Err(reason) => found.others.push((rule.name.clone(), told(reason))),
            }
        }
    }
    if only.is_none() {
        without_parts(model, &mut found.chart.machines);
    }
    mixed(model, left, &mut judge, &mut found);
    one_each(&mut found);
    found
}

/// Draws what several states do alike, before anything else that they do, as the path of a composite state around them. A machine
/// of which that cannot be said stays as it is.
pub fn nest(model: &Model, found: &mut Extracted) {
    let mut judge = agrees::Judge::new(model);
    for machine in &mut found.chart.machines {
        if let Some(nested) = nested(model, machine, &mut judge) {
            *machine = nested;
        }
    }
}

fn nested(model: &Model, flat: &Machine, judge: &mut agrees::Judge<'_>) -> Option<Machine> {
    let Some(Control::Linked(control)) = &flat.control else { return None };
    let id = RuleId(model.rules.iter().position(|rule| rule.name == rule_of(flat))? as u32);
    let (function, location) = controls(model, id).into_iter().find(|(_, location)| *location == control.text)?;
    let trees = trees(model, id, function, &location, false).ok()??;
    let trees = nest::nested(trees).ok()??;
    let mut machine = shapes::machine(model, id, &location, &trees);
    machine.name.clone_from(&flat.name);
    machine.flattened = flattened(&Chart::default(), &machine).ok()?.map(Arc::new);
    judge.refusal(&machine, id, function, &location).is_none().then_some(machine)
}

/// Keeps one machine per rule, that of the location that the text sets first, and gives each machine a unique name.
fn one_each(found: &mut Extracted) {
    let mut rules: BTreeSet<String> = BTreeSet::new();
    let mut names: BTreeSet<String> = BTreeSet::new();
    let further = &mut found.further;
    found.chart.machines.retain_mut(|machine| {
        let rule = rule_of(machine).to_string();
        if !rules.insert(rule.clone()) {
            let location = match &machine.control {
                Some(Control::Linked(link)) => link.text.clone(),
                _ => String::new(),
            };
            further.push((rule, location));
            return false;
        }
        machine.name = unused(&machine.name, "rule", |name| names.contains(name));
        names.insert(machine.name.clone());
        true
    });
}

/// Adds machines of rules that also do something independently of the state: for each rule that has no machine, is not
/// a part of one, and contains none.
fn mixed(model: &Model, left: Vec<(RuleId, FunctionId, String)>, judge: &mut agrees::Judge<'_>, found: &mut Extracted) {
    let strict: Vec<String> = found.chart.machines.iter().map(|machine| rule_of(machine).to_string()).collect();
    let parts: BTreeSet<String> = strict.iter().flat_map(|name| called(model, name)).collect();
    let mut more: Vec<Machine> = Vec::new();
    for (id, function, location) in left {
        let name = &model.rule(id).name;
        let calls = called(model, name);
        let known = |name: &String| strict.contains(name) || more.iter().any(|machine| rule_of(machine) == name);
        // A location whose arguments are themselves looked up is not what people call the state of this rule.
        let looked_up = location.matches('(').count() > 1;
        if looked_up || known(name) || parts.contains(name) || strict.iter().any(|machine| calls.contains(machine)) {
            continue;
        }
        if let Ok(Some(machine)) = machine(model, id, function, &location, false) {
            // A single control state makes no machine.
            let states = machine.shapes.iter().filter(|shape| matches!(shape.kind, ShapeKind::State { .. }));
            if states.count() < 2 && !machine.is_pattern {
                continue;
            }
            match judge.refusal(&machine, id, function, &location) {
                None => more.push(machine),
                Some(reason) => found.others.push((name.clone(), reason)),
            }
        }
    }
    without_parts(model, &mut more);
    found.chart.machines.extend(more);
}

/// Removes machines that are parts of others: rules for one control state that another machine of the same control
/// function calls. Also removes callers whose machine equals that of the rule they call.
fn without_parts(model: &Model, machines: &mut Vec<Machine>) {
    let names: Vec<String> = machines.iter().map(|machine| rule_of(machine).to_string()).collect();
    let calls: Vec<BTreeSet<String>> = names.iter().map(|name| called(model, name)).collect();
    let mut part = vec![false; machines.len()];
    for (caller, inner) in machines.iter().enumerate() {
        for (callee, outer) in machines.iter().enumerate() {
            let same_control = control_of(inner) == control_of(outer);
            if caller == callee || !same_control || !calls[caller].contains(&names[callee]) {
                continue;
            }
            if same_machine(inner, outer) {
                part[caller] = true;
            } else if !goes_on(outer) {
                part[callee] = true;
            }
        }
    }
    let mut index = 0;
    machines.retain(|_| {
        index += 1;
        !part[index - 1]
    });
}

/// Whether paths start from more than one control state.
fn goes_on(machine: &Machine) -> bool {
    let starts = |end: End| match end {
        End::Enter => true,
        End::Shape(id) => matches!(machine.shape(id).kind, ShapeKind::State { .. }),
        End::Exit => false,
    };
    let origins: BTreeSet<End> = machine.arrows.iter().map(|arrow| arrow.from).filter(|from| starts(*from)).collect();
    origins.len() > 1
}

fn rule_of(machine: &Machine) -> &str {
    machine.rule.as_ref().map_or("", |link| link.name.as_str())
}

fn control_of(machine: &Machine) -> &str {
    match &machine.control {
        Some(Control::Linked(link)) => &link.name,
        _ => "",
    }
}

/// Whether the shapes are the same, up to the names of parameters.
fn same_machine(one: &Machine, other: &Machine) -> bool {
    let kinds = |machine: &Machine| -> Vec<(String, ShapeKind)> {
        let shapes = machine.shapes.iter();
        shapes
            .map(|shape| (shape.link.as_ref().map_or(String::new(), |link| link.name.clone()), shape.kind.clone()))
            .collect()
    };
    let arrows = |machine: &Machine| -> Vec<(End, Option<bool>, End)> {
        machine.arrows.iter().map(|arrow| (arrow.from, arrow.branch, arrow.to)).collect()
    };
    kinds(one) == kinds(other) && arrows(one) == arrows(other)
}

/// The rules that a rule calls, directly or through others.
fn called(model: &Model, name: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut open = vec![name.to_string()];
    while let Some(name) = open.pop() {
        let Some(rule) = model.rules.iter().find(|rule| rule.name == name) else { continue };
        rule.body.walk(&mut |rule| {
            if let RuleKind::MacroCall(Call { rule, .. }) | RuleKind::TurboCall(Call { rule, .. }) = &rule.kind {
                let name = &model.rule(*rule).name;
                if found.insert(name.clone()) {
                    open.push(name.clone());
                }
            }
        });
    }
    found
}

fn told(reason: Reason) -> String {
    match reason {
        Reason::Hidden(_) => "it sets the control location inside `seq`, `forall`, `choose` or the like".to_string(),
        Reason::Computed(_) => "it sets the control location to a computed value".to_string(),
        Reason::Large => "it is too large".to_string(),
    }
}

/// The possible values of a control function, undef first; `None` if the function cannot be one.
pub(crate) fn values(model: &Model, function: FunctionId) -> Option<Vec<String>> {
    match model.domains.kind(model.function(function).codomain) {
        DomainKind::Enum { literals } => {
            Some(["undef".to_string()].into_iter().chain(literals.iter().cloned()).collect())
        }
        _ => None,
    }
}

/// The values that a location of the function can have.
pub(crate) fn origins(model: &Model, function: FunctionId) -> Vec<String> {
    let values = values(model, function).unwrap_or_default();
    let defined = !values.is_empty() && always_defined(model, function);
    values.into_iter().skip(usize::from(defined)).collect()
}

/// The locations that a rule sets to a literal or undef, in the order of the text.
pub(crate) fn controls(model: &Model, rule: RuleId) -> Vec<(FunctionId, String)> {
    let mut found: Vec<(FunctionId, String)> = Vec::new();
    let mut named: BTreeSet<&str> = BTreeSet::new();
    let explorer = Explorer::new(model, FunctionId(u32::MAX), String::new(), String::new(), Depth::Full);
    let Ok(effects) = explorer.rule(rule, &[]) else { return found };
    for guarded in &effects {
        let Effect::Update { location, constant: true, .. } = &guarded.effect else { continue };
        if !named.insert(location) {
            continue;
        }
        let name = location.split('(').next().unwrap_or_default();
        let function = model.functions().find(|(_, function)| function.name == name && !function.library);
        if let Some((id, _)) = function.filter(|(id, _)| values(model, *id).is_some()) {
            found.push((id, location.clone()));
        }
    }
    found
}

fn machine(
    model: &Model,
    rule: RuleId,
    function: FunctionId,
    control: &str,
    strict: bool,
) -> Result<Option<Machine>, Reason> {
    let trees = trees(model, rule, function, control, strict)?;
    Ok(trees.map(|trees| shapes::machine(model, rule, control, &trees)).filter(|machine| !machine.arrows.is_empty()))
}

/// What a rule does in its control states, before shapes stand for it.
struct Trees<'c> {
    graph: Graph<'c>,
    /// What is done when a pattern is entered.
    enter: Vec<usize>,
    /// What is done in the states. A state has several only if the updates of the control location clash.
    starts: Vec<(String, usize)>,
    is_pattern: bool,
    /// The state in which the model begins.
    initial: Option<String>,
    /// Composite states.
    regions: Vec<Region>,
}

fn trees<'c>(
    model: &Model,
    rule: RuleId,
    function: FunctionId,
    control: &'c str,
    strict: bool,
) -> Result<Option<Trees<'c>>, Reason> {
    let values = values(model, function).unwrap_or_default();
    let mut steps: Vec<(String, Vec<Guarded>)> = Vec::new();
    let mut tested = false;
    for value in values {
        let explorer = Explorer::new(model, function, control.to_string(), value.clone(), Depth::Control);
        let effects = explorer.rule(rule, &[])?;
        tested |= explorer.reads() > 0;
        steps.push((value, effects));
    }
    // A rule that does the same in every state has no control states.
    if !tested || strict && does_always(&steps) {
        return Ok(None);
    }
    let undef = if always_defined(model, function) { Vec::new() } else { steps[0].1.clone() };
    steps.remove(0);
    let initial = match initial_value(model, function) {
        Some(Initial::Value(value, _)) => Some(value),
        Some(Initial::Computed(_)) | None => None,
    };
    // A pattern is entered when undef. A machine that starts in a state and is never left is never undef.
    let leaves = |guarded: &Guarded| matches!(&guarded.effect, Effect::Update { value, .. } if value == "undef");
    let left = steps.iter().flat_map(|(_, effects)| effects).any(|found| is_update_of(found, control) && leaves(found));
    let begins = initial.as_deref().is_some_and(|value| value != UNDEF);
    let is_pattern = undef.iter().any(|guarded| is_update_of(guarded, control)) && (left || !begins);
    // The main rule is called by nobody, so nobody enters or leaves it.
    if is_pattern && model.main == Some(rule) {
        return Ok(None);
    }
    let mut graph = Graph::new(control);
    let enter = if is_pattern { graph.trees(&undef, UNDEF)? } else { Vec::new() };
    let mut starts = Vec::new();
    for (value, effects) in &steps {
        starts.extend(graph.trees(effects, value)?.into_iter().map(|node| (value.clone(), node)));
    }
    if !is_pattern {
        starts.extend(graph.trees(&undef, UNDEF)?.into_iter().map(|node| (UNDEF.to_string(), node)));
    }
    Ok(Some(Trees { graph, enter, starts, is_pattern, initial, regions: Vec::new() }))
}

impl Trees<'_> {
    /// The state in which the machine begins: where the model does not say so, the first one.
    fn first(&self) -> Option<&str> {
        let first = self.starts.first().map(|(value, _)| value.as_str());
        self.initial.as_deref().or(first).filter(|_| !self.is_pattern)
    }
}

/// Whether something is done under the same tests in every state, so that the rule does more than its machine.
fn does_always(steps: &[(String, Vec<Guarded>)]) -> bool {
    let Some(((_, first), rest)) = steps.split_first() else { return false };
    let in_all = |guarded: &Guarded| {
        let same = |other: &Guarded| other.effect == guarded.effect && other.path == guarded.path;
        rest.iter().all(|(_, effects)| effects.iter().any(same))
    };
    first.iter().any(in_all)
}

fn is_update_of(guarded: &Guarded, control: &str) -> bool {
    matches!(&guarded.effect, Effect::Update { location, .. } if location == control)
}
