//! The shapes and arrows that stand for the control states, tests and actions of a rule, and their names.

use std::collections::BTreeMap;

use model::{Model, RuleId};

use super::Trees;
use super::graph::Node;
use super::region::{Region, is_within};
use crate::begin::UNDEF;
use crate::chart::{Arrow, Composite, Control, End, History, Machine, Parameter, Shape, ShapeId, ShapeKind, WORDS};
use crate::link::Link;
use crate::read::spoken;

/// The machine of a rule over a control location.
pub(super) fn machine(model: &Model, rule: RuleId, control: &str, trees: &Trees<'_>) -> Machine {
    let declared = model.rule(rule);
    let parameters = declared.parameters.iter().map(|id| {
        let variable = &declared.variables[id.0 as usize];
        Parameter { variable: variable.name.clone(), domain: model.domains.display(variable.domain) }
    });
    let link = Link { text: control.to_string(), name: name_of(control), is_application: true, span: declared.span };
    let machine = Machine {
        name: declared.name.trim_start_matches("r_").to_string(),
        is_pattern: trees.is_pattern,
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
    let mut drawing = Drawing { trees, machine, states: BTreeMap::new(), regions: Vec::new() };
    drawing.states();
    drawing.regions();
    drawing.paths();
    drawing.machine
}

struct Drawing<'t, 'c> {
    trees: &'t Trees<'c>,
    machine: Machine,
    states: BTreeMap<&'t str, ShapeId>,
    regions: Vec<ShapeId>,
}

impl Drawing<'_, '_> {
    fn states(&mut self) {
        let trees = self.trees;
        let targets = trees.graph.nodes.iter().filter_map(|node| match node {
            Node::Target(value) => Some(value.as_str()),
            _ => None,
        });
        // The state in which the model begins is shown even if this rule does nothing in it.
        let first = trees.first();
        let starting: Vec<&str> = trees.starts.iter().map(|(value, _)| value.as_str()).collect();
        let held = trees.regions.iter().flat_map(|region| region.states.iter().map(String::as_str));
        let unknown = first.filter(|value| !starting.contains(value));
        let values = unknown.into_iter().chain(starting.iter().copied()).chain(held).chain(targets);
        // Only a pattern may be outside of its states when its control location is undef; another machine needs a state
        // for it.
        let values: Vec<&str> = values.filter(|value| !trees.is_pattern || *value != UNDEF).collect();
        for value in &values {
            if !self.states.contains_key(value) {
                let begins = trees.regions.iter().any(|region| region.initial.as_deref() == Some(value));
                let kind = ShapeKind::State { initial: first == Some(value) || begins };
                let (name, text) = match *value {
                    UNDEF => ("undefined".to_string(), "Undefined".to_string()),
                    literal => (camel(literal), sentence(literal)),
                };
                let id = add(&mut self.machine, kind, &name, &text, value);
                self.states.insert(value, id);
            }
        }
    }

    fn regions(&mut self) {
        let trees = self.trees;
        for region in &trees.regions {
            let (name, text) = self.region_name(region);
            let id = add(&mut self.machine, ShapeKind::Composite(Composite::default()), &name, &text, "");
            let around = region.around.map(|around| self.regions[around]);
            self.regions.push(id);
            self.machine.shapes[id.0].link = None;
            self.machine.shapes[id.0].inside = around;
            let [entry, exit] = [&region.entry, &region.exit]
                .map(|actions| actions.iter().map(|text| self.action(text, Some(id))).collect::<Vec<ShapeId>>());
            // It begins in what holds its first state.
            let begins_here =
                |outer: &Region| outer.initial.as_ref().is_some_and(|first| region.states.contains(first));
            let initial = match region.around {
                Some(outer) => begins_here(&trees.regions[outer]),
                None => trees.first().is_some_and(|first| region.states.iter().any(|value| value == first)),
            };
            let history = region.history.as_ref().map(|text| {
                History::Linked(Link {
                    text: text.clone(),
                    name: name_of(text),
                    is_application: true,
                    span: self.machine.span,
                })
            });
            self.machine.shapes[id.0].kind = ShapeKind::Composite(Composite { initial, history, entry, exit });
        }
        for (value, id) in &self.states {
            let inner = trees.regions.iter().rposition(|region| region.states.iter().any(|held| held == value));
            self.machine.shapes[id.0].inside = inner.map(|inner| self.regions[inner]);
        }
    }

    /// What is left over a test is told by that.
    fn region_name(&self, region: &Region) -> (String, String) {
        if let Some(name) =
            region.history.as_deref().and_then(|memory| name_of(memory).strip_suffix("Left").map(str::to_string))
            && !name.is_empty()
        {
            return (name.clone(), spoken(&name));
        }
        match &self.trees.graph.nodes[region.path] {
            Node::Guard(atom, yes, _) => {
                let word = if yes.is_some() { "until" } else { "while" };
                let name = name_of(atom.trim_start_matches("not "));
                let told = said(atom, &name);
                let told = if told == *atom { told } else { told.to_lowercase() };
                let mut letters = name.chars();
                let name = letters.next().map(|first| first.to_uppercase().chain(letters).collect::<String>());
                (format!("{word}{}", name.unwrap_or_default()), format!("{} {told}", spoken(word)))
            }
            _ => ("region".to_string(), "Region".to_string()),
        }
    }

    fn action(&mut self, text: &str, inside: Option<ShapeId>) -> ShapeId {
        let name = name_of(text).trim_start_matches("r_").to_string();
        let shown = said(text, &name);
        let shown = if shown == *text { shown } else { shown.to_uppercase() };
        let id = add(&mut self.machine, ShapeKind::Action, &name, &shown, text);
        self.machine.shapes[id.0].inside = inside;
        id
    }

    fn paths(&mut self) {
        let trees = self.trees;
        let homes = homes(trees);
        let mut ends: Vec<End> = Vec::new();
        for (index, node) in trees.graph.nodes.iter().enumerate() {
            let home = homes[index].map(|region| self.regions[region]);
            ends.push(match node {
                Node::Target(value) => self.states.get(value.as_str()).map_or(End::Exit, |id| End::Shape(*id)),
                Node::Region(region) => End::Shape(self.regions[*region]),
                Node::Guard(atom, ..) => {
                    let name = name_of(atom.trim_start_matches("not "));
                    let id = add(&mut self.machine, ShapeKind::Guard, &name, &said(atom, &name), atom);
                    self.machine.shapes[id.0].inside = home;
                    End::Shape(id)
                }
                Node::Action(text, _) => End::Shape(self.action(text, home)),
            });
        }
        let span = self.machine.span;
        let arrows = &mut self.machine.arrows;
        let mut lead = |from: End, branch: Option<bool>, to: Option<usize>| {
            if let Some(to) = to {
                arrows.push(Arrow { from, branch, to: ends[to], answer: None, span });
            }
        };
        trees.enter.iter().for_each(|node| lead(End::Enter, None, Some(*node)));
        for (value, node) in &trees.starts {
            lead(End::Shape(self.states[value.as_str()]), None, Some(*node));
        }
        for (region, id) in trees.regions.iter().zip(&self.regions) {
            lead(End::Shape(*id), None, Some(region.path));
        }
        for (index, node) in trees.graph.nodes.iter().enumerate() {
            match node {
                Node::Guard(_, yes, no) => {
                    lead(ends[index], Some(true), *yes);
                    lead(ends[index], Some(false), *no);
                }
                Node::Action(_, next) => lead(ends[index], None, Some(*next)),
                Node::Target(_) | Node::Region(_) => {}
            }
        }
    }
}

/// The innermost region that holds all that leads to a part, and all that it leads to.
fn homes(trees: &Trees<'_>) -> Vec<Option<usize>> {
    /// What is reached from nowhere yet stands nowhere.
    #[derive(Clone, Copy, PartialEq)]
    enum Home {
        Open,
        In(Option<usize>),
    }
    let both = |one: Home, other: Home| match (one, other) {
        (Home::Open, home) | (home, Home::Open) => home,
        (Home::In(one), Home::In(other)) => {
            let mut outer = one;
            while let Some(region) = outer
                && !other.is_some_and(|other| is_within(&trees.regions, other, region))
            {
                outer = trees.regions[region].around;
            }
            Home::In(outer)
        }
    };
    let of_state =
        |value: &str| Home::In(trees.regions.iter().rposition(|region| region.states.iter().any(|held| held == value)));
    let nodes = &trees.graph.nodes;
    let mut homes = vec![Home::Open; nodes.len()];
    let sources = trees.starts.iter().map(|(value, node)| (of_state(value), *node));
    let sources = sources.chain(trees.enter.iter().map(|node| (Home::In(None), *node)));
    for (home, node) in sources.chain(trees.regions.iter().map(|region| (Home::In(region.around), region.path))) {
        homes[node] = both(homes[node], home);
    }
    // What a part leads to stands before it.
    for index in (0..nodes.len()).rev() {
        for next in nodes[index].next() {
            homes[next] = both(homes[next], homes[index]);
        }
    }
    for index in 0..nodes.len() {
        let own = match &nodes[index] {
            Node::Target(value) => of_state(value),
            Node::Region(region) => Home::In(trees.regions[*region].around),
            Node::Guard(..) | Node::Action(..) => {
                nodes[index].next().fold(homes[index], |home, next| both(home, homes[next]))
            }
        };
        homes[index] = own;
    }
    homes.into_iter().map(|home| if let Home::In(region) = home { region } else { None }).collect()
}

fn name_of(text: &str) -> String {
    text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_')
        .find(|word| !word.is_empty())
        .unwrap_or(text)
        .to_string()
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

/// Whether a text is a function with its arguments, if it has any.
pub(super) fn is_application(text: &str) -> bool {
    let rest = text.trim_start_matches(|c: char| c.is_ascii_alphanumeric() || c == '_');
    rest.len() < text.len() && (rest.is_empty() || is_closed(rest))
}

/// A name that is neither taken nor a word of charts; `other` replaces what cannot be a name.
pub(super) fn unused(name: &str, other: &str, taken: impl Fn(&str) -> bool) -> String {
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
