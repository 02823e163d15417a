//! Extracts charts from AsmetaL: finds rules in control-state form by what they do, not by how they are written.
//!
//! In: a checked model. Out: a [`Chart`] with a machine for each rule that tests and sets a control location (an enum
//! value or undef), in any nesting of `if`, `switch`, `let` and macro calls; for other rules that set such a location,
//! why they are no machines. Equal tails of paths share their shapes.
//!
//! INVARIANT: the written chart has no faults, and its rules do what the model's rules do ([`agrees`] checks this).

mod agrees;

use std::collections::{BTreeMap, BTreeSet};

use model::{Call, DomainKind, FunctionId, Model, RuleId, RuleKind};

use crate::begin::{Initial, UNDEF, initial_value};
use crate::chart::{Arrow, Chart, Control, End, Machine, Parameter, Shape, ShapeId, ShapeKind, WORDS};
use crate::defined::always_defined;
use crate::link::Link;
use crate::read::spoken;
use crate::symbolic::{Depth, Effect, Explorer, Guarded, Path, Reason, consistent};

/// LIMIT: how many guards, actions and states a machine may have.
const MAX_SHAPES: usize = 1000;

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
    let declared = model.rule(rule);
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
    let mut graph = Graph { control, nodes: Vec::new(), index: BTreeMap::new() };
    let enter = if is_pattern { graph.trees(&undef, UNDEF)? } else { Vec::new() };
    let mut starts = Vec::new();
    for (value, effects) in &steps {
        starts.extend(graph.trees(effects, value)?.into_iter().map(|node| (value.clone(), node)));
    }
    if !is_pattern {
        starts.extend(graph.trees(&undef, UNDEF)?.into_iter().map(|node| (UNDEF.to_string(), node)));
    }
    let parameters = declared.parameters.iter().map(|id| {
        let variable = &declared.variables[id.0 as usize];
        Parameter { variable: variable.name.clone(), domain: model.domains.display(variable.domain) }
    });
    let link = Link { text: control.to_string(), name: name_of(control), is_application: true, span: declared.span };
    let mut machine = Machine {
        name: declared.name.trim_start_matches("r_").to_string(),
        is_pattern,
        parameters: parameters.collect(),
        text: spoken(declared.name.trim_start_matches("r_")),
        rule: Some(Link {
            text: declared.name.clone(),
            name: declared.name.clone(),
            is_application: true,
            span: declared.span,
        }),
        control: Some(Control::Linked(link)),
        shapes: Vec::new(),
        arrows: Vec::new(),
        sequences: Vec::new(),
        aborts: Vec::new(),
        flattened: None,
        steps: true,
        span: declared.span,
    };
    graph.shapes(&mut machine, &enter, &starts, initial.as_deref());
    Ok((!machine.arrows.is_empty()).then_some(machine))
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

fn name_of(text: &str) -> String {
    text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_')
        .find(|word| !word.is_empty())
        .unwrap_or(text)
        .to_string()
}

/// An effect with its remaining tests.
type Open<'e> = (Path, &'e Guarded);

#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
enum Node {
    Guard(String, Option<usize>, Option<usize>),
    Action(String, usize),
    /// A value of the control variable; `undef` is the exit.
    Target(String),
}

/// Guards, actions and targets; equal nodes are shared.
struct Graph<'c> {
    control: &'c str,
    nodes: Vec<Node>,
    index: BTreeMap<Node, usize>,
}

impl Graph<'_> {
    fn node(&mut self, node: Node) -> Result<usize, Reason> {
        if let Some(index) = self.index.get(&node) {
            return Ok(*index);
        }
        if self.nodes.len() >= MAX_SHAPES {
            return Err(Reason::Large);
        }
        self.nodes.push(node.clone());
        self.index.insert(node, self.nodes.len() - 1);
        Ok(self.nodes.len() - 1)
    }

    /// The decisions and actions of some effects; empty if there are none. There are several trees only if one case
    /// sets the control location to several values: such updates clash, and so do the paths.
    fn trees(&mut self, effects: &[Guarded], origin: &str) -> Result<Vec<usize>, Reason> {
        let effects: Vec<Open<'_>> = effects.iter().map(|guarded| (guarded.path.clone(), guarded)).collect();
        let mut found = Vec::new();
        while let Some(tree) = self.tree(&effects, origin, found.len())? {
            found.push(tree);
        }
        Ok(found)
    }

    fn tree(&mut self, effects: &[Open<'_>], origin: &str, layer: usize) -> Result<Option<usize>, Reason> {
        if effects.is_empty() {
            return Ok(None);
        }
        let Some((path, _)) = effects.iter().find(|(path, _)| !path.is_empty()) else {
            return self.leaf(effects, origin, layer);
        };
        let atom = path[0].0.clone();
        let side = |wanted: bool| -> Vec<Open<'_>> {
            let fits = effects.iter().filter(|(path, _)| consistent(path, &vec![(atom.clone(), wanted)]));
            fits.map(|(path, guarded)| (path.iter().filter(|(known, _)| *known != atom).cloned().collect(), *guarded))
                .collect()
        };
        let (yes, no) = (self.tree(&side(true), origin, layer)?, self.tree(&side(false), origin, layer)?);
        match (yes, no) {
            (yes, no) if yes == no => Ok(yes),
            (yes, no) => self.node(Node::Guard(atom, yes, no)).map(Some),
        }
    }

    /// What is done in one case. Further layers contain only the further values of the control location.
    fn leaf(&mut self, effects: &[Open<'_>], origin: &str, layer: usize) -> Result<Option<usize>, Reason> {
        let mut targets: Vec<&str> = Vec::new();
        let mut actions: Vec<String> = Vec::new();
        for (_, guarded) in effects {
            match &guarded.effect {
                Effect::Update { location, value, .. } if location == self.control => {
                    if !targets.contains(&value.as_str()) {
                        targets.push(value);
                    }
                }
                Effect::Update { location, value, .. } => actions.push(format!("{location} := {value}")),
                Effect::Rule(text) => actions.push(text.clone()),
            }
        }
        let target = targets.get(layer).copied().or((layer == 0).then_some(origin));
        let Some(target) = target else { return Ok(None) };
        let mut next = self.node(Node::Target(target.to_string()))?;
        let mut seen = BTreeSet::new();
        for action in actions.into_iter().rev().filter(|_| layer == 0) {
            if seen.insert(action.clone()) {
                next = self.node(Node::Action(action, next))?;
            }
        }
        Ok(Some(next))
    }

    /// The shapes and arrows of a machine.
    fn shapes(&self, machine: &mut Machine, enter: &[usize], starts: &[(String, usize)], initial: Option<&str>) {
        let mut ends: BTreeMap<usize, End> = BTreeMap::new();
        let mut states: BTreeMap<&str, ShapeId> = BTreeMap::new();
        let targets = self.nodes.iter().filter_map(|node| match node {
            Node::Target(value) => Some(value.as_str()),
            _ => None,
        });
        // The state in which the model begins is shown even if this rule does nothing in it.
        let begins = initial.filter(|_| !machine.is_pattern);
        let starting: Vec<&str> = starts.iter().map(|(value, _)| value.as_str()).collect();
        let unknown = begins.filter(|value| !starting.contains(value));
        let values = unknown.into_iter().chain(starting).chain(targets);
        // Only a pattern may be outside of its states when its control location is undef; another machine needs a state
        // for it.
        let values: Vec<&str> = values.filter(|value| !machine.is_pattern || *value != UNDEF).collect();
        let first = begins.or(values.first().copied());
        for value in &values {
            if !states.contains_key(value) {
                let kind = ShapeKind::State { initial: !machine.is_pattern && first == Some(value) };
                let (name, text) = match *value {
                    UNDEF => ("undefined".to_string(), "Undefined".to_string()),
                    literal => (camel(literal), sentence(literal)),
                };
                states.insert(value, add(machine, kind, &name, &text, value));
            }
        }
        for (index, node) in self.nodes.iter().enumerate() {
            let end = match node {
                Node::Target(value) => states.get(value.as_str()).map_or(End::Exit, |id| End::Shape(*id)),
                Node::Guard(atom, ..) => {
                    let name = name_of(atom.trim_start_matches("not "));
                    End::Shape(add(machine, ShapeKind::Guard, &name, &said(atom, &name), atom))
                }
                Node::Action(text, _) => {
                    let name = name_of(text).trim_start_matches("r_").to_string();
                    let shown = said(text, &name);
                    let shown = if shown == *text { shown } else { shown.to_uppercase() };
                    End::Shape(add(machine, ShapeKind::Action, &name, &shown, text))
                }
            };
            ends.insert(index, end);
        }
        let span = machine.span;
        let mut lead = |from: End, branch: Option<bool>, to: Option<usize>| {
            if let Some(to) = to {
                machine.arrows.push(Arrow { from, branch, to: ends[&to], answer: None, span });
            }
        };
        enter.iter().for_each(|node| lead(End::Enter, None, Some(*node)));
        for (value, node) in starts {
            lead(End::Shape(states[value.as_str()]), None, Some(*node));
        }
        for (index, node) in self.nodes.iter().enumerate() {
            match node {
                Node::Guard(_, yes, no) => {
                    lead(ends[&index], Some(true), *yes);
                    lead(ends[&index], Some(false), *no);
                }
                Node::Action(_, next) => lead(ends[&index], None, Some(*next)),
                Node::Target(_) => {}
            }
        }
    }
}

/// The text that a picture shows for a term or rule: its name in words if it is an application, else all of it.
fn said(text: &str, name: &str) -> String {
    let plain = text.strip_prefix(name).or(text.strip_prefix("r_").and_then(|rest| rest.strip_prefix(name)));
    match plain {
        Some(rest) if rest.is_empty() || is_closed(rest) => spoken(name),
        _ => text.to_string(),
    }
}

/// Whether one pair of parentheses encloses the whole text.
fn is_closed(text: &str) -> bool {
    let mut depth = 0;
    for (at, letter) in text.char_indices() {
        match letter {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return at + 1 == text.len();
        }
    }
    false
}

/// A name that is neither taken nor a word of charts; `other` replaces what cannot be a name.
fn unused(name: &str, other: &str, taken: impl Fn(&str) -> bool) -> String {
    let name = if name.starts_with(|c: char| c.is_alphabetic()) { name } else { other };
    let taken = |name: &str| WORDS.contains(&name) || taken(name);
    let mut unique = name.to_string();
    let mut count = 2;
    while taken(&unique) {
        unique = format!("{name}{count}");
        count += 1;
    }
    unique
}

fn add(machine: &mut Machine, kind: ShapeKind, name: &str, text: &str, link: &str) -> ShapeId {
    let unique = unused(name, "shape", |name| machine.shapes.iter().any(|shape| shape.name == name));
    let is_application = is_closed(link.trim_start_matches(|c: char| c.is_ascii_alphanumeric() || c == '_'));
    let link = Link { text: link.to_string(), name: name_of(link), is_application, span: machine.span };
    machine.shapes.push(Shape {
        inside: None,
        name: unique,
        text: text.to_string(),
        kind,
        link: Some(link),
        refinement: None,
        span: machine.span,
    });
    ShapeId(machine.shapes.len() - 1)
}

/// `MANAGING_SB` as `managingSb`.
fn camel(literal: &str) -> String {
    let mut out = String::new();
    for (index, word) in literal.split('_').filter(|word| !word.is_empty()).enumerate() {
        let word = word.to_lowercase();
        let mut letters = word.chars();
        match letters.next() {
            Some(first) if index > 0 => out.extend(first.to_uppercase().chain(letters)),
            Some(_) => out.push_str(&word),
            None => {}
        }
    }
    out
}

/// `MANAGING_SB` as `Managing sb`.
fn sentence(literal: &str) -> String {
    spoken(&literal.to_lowercase())
}
