//! What is to be drawn, before anything has a place: shapes with their sizes and texts, and arrows between them.
//!
//! In: a machine. Out: a [`Scene`]. Its order is that in which a reader meets the shapes, depth first from the start, by
//! which the layout keeps the first path straight.

use std::collections::BTreeSet;

use chart::{Chart, Composite, End, Link, Machine, ShapeId, ShapeKind};

use crate::measure::{SMALL, SMALL_LEADING, TEXT, extent, in_circle, link_width, radius_of, text_width, wrapped};
use crate::picture::{Detail, Figure};

/// A shape to be placed.
#[derive(Debug, Clone)]
pub struct Node {
    /// The name in the chart; `enter`; or `exit`, an answer if it gives one, and a number.
    pub id: String,
    pub figure: Figure,
    pub dashed: bool,
    /// Drawn in long dashes: what refines it is named.
    pub named: bool,
    pub lines: Vec<String>,
    /// Small lines below.
    pub details: Vec<Detail>,
    /// With its braces.
    pub link: Option<String>,
    pub width: f64,
    pub height: f64,
    /// Where its centre has to lie.
    pub place: Option<(f64, f64)>,
    /// The machine starts here.
    pub initial: bool,
    /// The composite state around it. That one's own size follows from what lies in it.
    pub inside: Option<usize>,
}

impl Node {
    /// All its lines of text.
    pub fn told(&self) -> impl Iterator<Item = String> {
        let detail = |detail: &Detail| match &detail.right {
            Some(right) => format!("{}, {right}", detail.text),
            None => detail.text.clone(),
        };
        self.lines.iter().cloned().chain(self.details.iter().map(detail))
    }
}

/// An arrow to be routed.
#[derive(Debug, Clone)]
pub struct Edge {
    pub from: usize,
    pub branch: Option<bool>,
    pub to: usize,
}

/// What is to be drawn.
#[derive(Debug, Clone, Default)]
pub struct Scene {
    pub nodes: Vec<Node>,
    pub edges: Vec<Edge>,
    /// Arrows may meet shapes anywhere.
    pub free: bool,
}

/// The scene of a machine.
pub fn of_machine(chart: &Chart, machine: &Machine) -> Scene {
    let order = reading_order(machine);
    let radius = machine.shapes.iter().filter(|shape| matches!(shape.kind, ShapeKind::State { .. }));
    let radius = radius.map(|shape| radius_of(&shape.text, shape.is_initial())).fold(34.0, f64::max).ceil();
    let mut scene = Scene::default();
    for end in &order {
        let mut node = match end {
            End::Shape(id) => node(chart, machine, *id, radius),
            _ => point("enter".to_string(), Figure::Enter),
        };
        node.place = chart.layouts.get(&machine.name).and_then(|places| places.get(&node.id)).copied();
        scene.nodes.push(node);
    }
    let around = |end: &End| match end {
        End::Shape(id) => machine.shape(*id).inside.map(End::Shape),
        End::Enter | End::Exit => None,
    };
    for (index, end) in order.iter().enumerate() {
        scene.nodes[index].inside = around(end).and_then(|outer| order.iter().position(|known| *known == outer));
    }
    let place = |end: End| order.iter().position(|known| *known == end);
    // Drawn in the order of the shapes they start at, `yes` before `no`.
    let mut arrows: Vec<_> = machine.arrows.iter().collect();
    arrows.sort_by_key(|arrow| (place(arrow.from), arrow.branch.map(|yes| !yes)));
    for arrow in arrows {
        let Some(from) = place(arrow.from) else { continue };
        let to = match arrow.to {
            End::Exit => {
                let count = scene.nodes.iter().filter(|node| node.figure == Figure::Exit).count();
                scene.nodes.push(exit(count + 1, arrow.answer));
                scene.nodes.len() - 1
            }
            end => match place(end) {
                Some(index) => index,
                None => continue,
            },
        };
        scene.edges.push(Edge { from, branch: arrow.branch, to });
    }
    scene
}

/// The ends as a reader meets them: depth first from the start, then what no path leads to.
fn reading_order(machine: &Machine) -> Vec<End> {
    let start = if machine.is_pattern { Some(End::Enter) } else { machine.initial().map(End::Shape) };
    let mut order = Vec::new();
    let mut seen = BTreeSet::new();
    let rest = machine.numbered().filter(|(id, _)| !machine.is_told_in_frame(*id)).map(|(id, _)| End::Shape(id));
    for root in start.into_iter().chain(rest) {
        let mut open = vec![root];
        while let Some(end) = open.pop() {
            if end == End::Exit || !seen.insert(end) {
                continue;
            }
            order.push(end);
            let mut next: Vec<_> = machine.out_of(end).collect();
            next.sort_by_key(|arrow| arrow.branch.map(|yes| !yes));
            open.extend(next.iter().rev().map(|arrow| arrow.to));
            // Whoever enters a composite state reads on where it begins.
            if let End::Shape(id) = end
                && machine.shape(id).composite().is_some()
            {
                open.extend(machine.first_in(Some(id)).map(End::Shape));
            }
        }
    }
    order
}

/// The invisible end of a floating arrow.
fn point(id: String, figure: Figure) -> Node {
    Node {
        id,
        figure,
        dashed: false,
        named: false,
        lines: Vec::new(),
        details: Vec::new(),
        link: None,
        width: 2.0,
        height: 2.0,
        place: None,
        initial: false,
        inside: None,
    }
}

/// The end of a floating exit arrow, with the answer that it gives.
fn exit(number: usize, answer: Option<bool>) -> Node {
    let Some(answer) = answer else { return point(format!("exit {number}"), Figure::Exit) };
    let word = if answer { "yes" } else { "no" };
    let (width, height) = branch_size(answer);
    // Even, so that the middle lies on a whole pixel.
    let (width, height) = (2.0 * (width / 2.0).ceil() + 4.0, height);
    let point = point(format!("exit {word} {number}"), Figure::Exit);
    Node { lines: vec![word.to_string()], width, height, ..point }
}

/// What is done when a composite state is entered or left.
fn doings(machine: &Machine, composite: &Composite) -> Vec<Detail> {
    let told = |word: &str, actions: &[ShapeId]| -> Vec<Detail> {
        let text = |id: &ShapeId| format!("{word} / {}", machine.shape(*id).text.replace('\n', " "));
        actions.iter().map(|id| Detail { text: text(id), ..Detail::default() }).collect()
    };
    let history = composite.history.as_ref().map(|_| Detail { text: "history".to_string(), ..Detail::default() });
    history.into_iter().chain(told("entry", &composite.entry)).chain(told("exit", &composite.exit)).collect()
}

fn node(chart: &Chart, machine: &Machine, id: ShapeId, radius: f64) -> Node {
    let shape = machine.shape(id);
    let mut details = Vec::new();
    let (figure, lines, width, height) = match &shape.kind {
        ShapeKind::State { .. } => (Figure::Circle, in_circle(&shape.text).0, 2.0 * radius, 2.0 * radius),
        ShapeKind::Composite(composite) => {
            let lines = vec![shape.text.replace('\n', " ")];
            details = doings(machine, composite);
            let widest = details.iter().map(|detail| text_width(&detail.text, SMALL)).fold(extent(&lines).0, f64::max);
            (Figure::Composite, lines, widest + 40.0, frame_top(details.len()) + 40.0)
        }
        ShapeKind::Guard => {
            let lines = wrapped(&shape.text, 120.0);
            let (width, height) = extent(&lines);
            let height = (height + 20.0).max(44.0);
            (Figure::Hexagon, lines, width + 2.0 * corner(height) + 12.0, height)
        }
        ShapeKind::Action => {
            let done =
                if machine.aborts.contains(&id) { format!("abort / {}", shape.text) } else { shape.text.clone() };
            let lines = wrapped(&done, 140.0);
            let (width, height) = extent(&lines);
            (Figure::Rectangle, lines, (width + 28.0).max(96.0), (height + 20.0).max(40.0))
        }
        ShapeKind::Instance(pattern) => {
            let mut lines = wrapped(&shape.text, 150.0);
            let of = chart.machine(&pattern.name).map_or(pattern.name.as_str(), |pattern| pattern.text.as_str());
            if of != shape.text {
                lines.extend(wrapped(of, 150.0));
            }
            let (width, height) = extent(&lines);
            (Figure::Block, lines, (width + 52.0).max(120.0), (height + 24.0).max(48.0))
        }
    };
    let rule = chart.pattern_of(shape).and_then(|pattern| pattern.rule.as_ref());
    let link = shape.link.as_ref().or(rule);
    Node {
        id: shape.name.clone(),
        figure,
        dashed: shape.refinement.is_some(),
        named: shape.refinement.as_ref().is_some_and(|refinement| refinement.by.is_some()),
        lines,
        details,
        place: None,
        inside: None,
        link: link.map(|link| format!("{{{}}}", shown(link, &shape.kind))),
        // Even, so that the middle lies on a whole pixel and straight arrows are straight.
        width: 2.0 * (width / 2.0).ceil(),
        height: 2.0 * (height / 2.0).ceil(),
        initial: shape.is_initial(),
    }
}

/// LIMIT: a longer predicate is shown without arguments; if it is too long then, too, by its first name.
const PREDICATE: usize = 40;

/// What a picture shows of a link: of a guard the whole predicate, else a name.
fn shown(link: &Link, kind: &ShapeKind) -> String {
    match kind {
        ShapeKind::Guard if link.is_application || link.text == link.name => link.name.clone(),
        ShapeKind::Guard => {
            let fits = |text: &String| text.chars().count() <= PREDICATE;
            let forms = [link.text.clone(), without_arguments(&link.text)];
            forms.into_iter().find(fits).unwrap_or_else(|| format!("{} \u{2026}", link.name))
        }
        _ => link.name.clone(),
    }
}

/// `action(currentPhase($c)) = WRITING` as `action(…) = WRITING`.
fn without_arguments(text: &str) -> String {
    let mut out = String::new();
    let mut depth = 0;
    for letter in text.chars() {
        let is_name = out.ends_with(|before: char| before.is_alphanumeric() || before == '_');
        match letter {
            '(' if depth > 0 || is_name => {
                if depth == 0 {
                    out.push_str("(\u{2026})");
                }
                depth += 1;
            }
            ')' if depth > 0 => depth -= 1,
            _ if depth == 0 => out.push(letter),
            _ => {}
        }
    }
    out
}

/// The room that the words of a composite state with so many details take above what lies in it.
pub fn frame_top(details: usize) -> f64 {
    30.0 + details as f64 * SMALL_LEADING
}

/// Between the frame of a composite state and what lies in it.
pub const FRAME: f64 = 20.0;

/// How far the two corners of a hexagon reach out.
pub fn corner(height: f64) -> f64 {
    (height * 0.34).round()
}

/// The size of the label of a link.
pub fn link_size(link: &str) -> (f64, f64) {
    (link_width(link).ceil(), 14.0)
}

/// The size of `yes` and `no`.
pub fn branch_size(branch: bool) -> (f64, f64) {
    (text_width(if branch { "yes" } else { "no" }, TEXT - 1.5).ceil() + 2.0, 14.0)
}
