//! Checks a machine's arrows: every path leads from a control state to another, unambiguously and without a circle.

use std::collections::{BTreeMap, BTreeSet};

use syntax::{Diagnostic, Span};

use crate::chart::{Arrow, Composite, Control, End, History, Machine, Shape, ShapeId, ShapeKind};
use crate::fault;
use crate::flow::is_beside;

/// Shapes by the value of their control state, for faults about values.
type ByValue<'m> = BTreeMap<&'m str, &'m Shape>;

/// The faults of a machine; `sound` if all names in its paths are known.
pub(super) fn faults(machine: &Machine, sound: bool) -> Vec<Diagnostic> {
    let mut faults = Vec::new();
    control(machine, &mut faults);
    values(machine, &mut faults);
    if sound {
        composites(machine, &mut faults);
        ends(machine, &mut faults);
        forks(machine, &mut faults);
        dead_ends(machine, &mut faults);
        circles(machine, &mut faults);
        unreachable(machine, &mut faults);
    }
    faults
}

fn control(machine: &Machine, faults: &mut Vec<Diagnostic>) {
    let states = || machine.numbered().filter(|(_, shape)| matches!(shape.kind, ShapeKind::State { .. }));
    if states().next().is_some() && machine.control.is_none() {
        faults.push(fault::no_control(machine.span, &machine.name));
    }
    let starts = |around: Option<ShapeId>| -> Vec<Span> {
        let starts = machine.shapes.iter().filter(|shape| shape.inside == around && shape.is_initial());
        starts.map(|shape| shape.span).collect()
    };
    let initial = starts(None);
    if machine.is_pattern {
        faults.extend(initial.iter().map(|span| fault::needless_initial(*span, None)));
    } else if initial.is_empty() && states().next().is_some() {
        faults.push(fault::no_initial(machine.span, &machine.name));
    } else {
        faults.extend(initial.iter().skip(1).map(|span| fault::needless_initial(*span, initial.first().copied())));
    }
    for (id, shape) in machine.numbered().filter(|(_, shape)| shape.composite().is_some()) {
        let inner = starts(Some(id));
        faults.extend(inner.iter().skip(1).map(|span| fault::needless_initial(*span, inner.first().copied())));
        let is_target = machine.arrows.iter().any(|arrow| arrow.to == End::Shape(id));
        if inner.is_empty() && (is_target || shape.is_initial()) {
            faults.push(fault::no_initial_inside(shape.span, &shape.name));
        }
    }
}

/// What composite states must not hold, and actions that are done by themselves on a path.
fn composites(machine: &Machine, faults: &mut Vec<Diagnostic>) {
    for (id, shape) in machine.numbered() {
        if let Some(Composite { history: Some(History::Made), .. }) = shape.composite()
            && let Some(Control::Linked(_)) = machine.control
        {
            faults.push(fault::unlinked_history(shape.span, &shape.name));
        }
        if shape.inside.is_some() && is_beside(machine, id) {
            faults.push(fault::beside_in_composite(shape.span, &shape.name));
        }
        if machine.is_apart(id) {
            let end = End::Shape(id);
            let on_path = machine.arrows.iter().find(|arrow| arrow.from == end || arrow.to == end);
            faults.extend(on_path.map(|arrow| fault::apart_on_path(arrow.span, &shape.name)));
        }
    }
}

/// Whether it has control states.
pub(super) fn has_states(machine: &Machine) -> bool {
    machine.shapes.iter().any(|shape| matches!(shape.kind, ShapeKind::State { .. }))
}

/// No two control states have the same value.
fn values(machine: &Machine, faults: &mut Vec<Diagnostic>) {
    let mut seen: ByValue<'_> = BTreeMap::new();
    for shape in machine.shapes.iter().filter(|shape| matches!(shape.kind, ShapeKind::State { .. })) {
        let Some(link) = &shape.link else { continue };
        if let Some(first) = seen.get(link.text.as_str()) {
            faults.push(fault::same_value(shape.span, &link.text, first.span));
        } else {
            seen.insert(&link.text, shape);
        }
    }
}

/// Only patterns are entered and left.
fn ends(machine: &Machine, faults: &mut Vec<Diagnostic>) {
    if machine.is_pattern {
        if !machine.arrows.iter().any(|arrow| arrow.from == End::Enter) {
            let reason = "a pattern is entered over a path that starts at `enter`";
            faults.push(fault::misplaced_exit(machine.span, "endpattern", reason));
        }
        return;
    }
    let reason = "this is a machine, which is never entered nor left";
    for arrow in &machine.arrows {
        if arrow.from == End::Enter {
            faults.push(fault::misplaced_exit(arrow.span, "enter", reason));
        }
        if arrow.to == End::Exit {
            faults.push(fault::misplaced_exit(arrow.span, "exit", reason));
        }
    }
}

fn forks(machine: &Machine, faults: &mut Vec<Diagnostic>) {
    let mut first: BTreeMap<(End, Option<bool>), &Arrow> = BTreeMap::new();
    for arrow in &machine.arrows {
        let (kind, name) = match arrow.from {
            End::Shape(id) if matches!(machine.shape(id).kind, ShapeKind::State { .. } | ShapeKind::Composite(_)) => {
                continue;
            }
            End::Shape(id) => (kind_of(machine, id), machine.shape(id).name.as_str()),
            _ => continue,
        };
        match first.get(&(arrow.from, arrow.branch)) {
            Some(first) => faults.push(fault::forked_path(arrow.span, kind, name, first.span)),
            None => _ = first.insert((arrow.from, arrow.branch), arrow),
        }
    }
}

/// The word for a shape.
pub(crate) fn kind_of(machine: &Machine, id: ShapeId) -> &'static str {
    match machine.shape(id).kind {
        ShapeKind::State { .. } => "control state",
        ShapeKind::Composite(_) => "composite state",
        ShapeKind::Guard => "guard",
        ShapeKind::Action => "action",
        ShapeKind::Instance(_) => "instance",
    }
}

fn dead_ends(machine: &Machine, faults: &mut Vec<Diagnostic>) {
    for (id, shape) in machine.numbered() {
        let leads_on = machine.out_of(End::Shape(id)).next().is_some();
        let is_reached = machine.arrows.iter().any(|arrow| arrow.to == End::Shape(id));
        // A control state may be final; an instance without arrows runs parallel to the paths.
        let ends = match shape.kind {
            ShapeKind::State { .. } | ShapeKind::Composite(_) => false,
            ShapeKind::Action if machine.is_apart(id) => false,
            ShapeKind::Instance(_) => is_reached && !leads_on,
            _ => !leads_on,
        };
        if ends {
            faults.push(fault::dead_end(shape.span, kind_of(machine, id), &shape.name));
        }
    }
}

/// A path never returns to one of its own guards or actions.
fn circles(machine: &Machine, faults: &mut Vec<Diagnostic>) {
    let mut done = BTreeSet::new();
    for (id, _) in machine.numbered().filter(|(id, _)| is_inner(machine, *id)) {
        let mut path = Vec::new();
        circle_from(machine, id, &mut path, &mut done, faults);
    }
}

/// Whether a step continues after a shape.
fn is_inner(machine: &Machine, id: ShapeId) -> bool {
    matches!(machine.shape(id).kind, ShapeKind::Guard | ShapeKind::Action)
}

fn circle_from(
    machine: &Machine,
    start: ShapeId,
    path: &mut Vec<(ShapeId, usize)>,
    done: &mut BTreeSet<ShapeId>,
    faults: &mut Vec<Diagnostic>,
) {
    if !done.insert(start) {
        return;
    }
    path.push((start, 0));
    while let Some((id, next)) = path.pop() {
        let Some(arrow) = machine.out_of(End::Shape(id)).nth(next) else { continue };
        path.push((id, next + 1));
        let End::Shape(to) = arrow.to else { continue };
        if !is_inner(machine, to) {
            continue;
        }
        if path.iter().any(|(on, _)| *on == to) {
            faults.push(fault::circular_path(arrow.span, &machine.shape(to).name));
        } else if done.insert(to) {
            path.push((to, 0));
        }
    }
}

/// Where paths lead.
pub(super) fn reached(machine: &Machine) -> BTreeSet<End> {
    let mut open = vec![if machine.is_pattern { Some(End::Enter) } else { machine.initial().map(End::Shape) }];
    // Other rules may also set a location of the specification, so they may lead to any control state.
    if let Some(Control::Linked(_)) = machine.control {
        let states = machine.numbered().filter(|(_, shape)| matches!(shape.kind, ShapeKind::State { .. }));
        open.extend(states.map(|(id, _)| Some(End::Shape(id))));
    }
    let mut seen: BTreeSet<End> = BTreeSet::new();
    while let Some(end) = open.pop().flatten() {
        if !seen.insert(end) {
            continue;
        }
        for arrow in machine.out_of(end) {
            open.push(Some(arrow.to));
            // An arrow to a composite state leads to where that begins.
            if let End::Shape(to) = arrow.to
                && machine.shape(to).composite().is_some()
            {
                open.push(machine.first_in(Some(to)).map(End::Shape));
            }
        }
        // Whoever is in a state is in those around it.
        if let End::Shape(id) = end
            && !matches!(machine.shape(id).kind, ShapeKind::Guard | ShapeKind::Action)
        {
            open.extend(machine.shape(id).inside.map(|around| Some(End::Shape(around))));
        }
    }
    seen
}

fn unreachable(machine: &Machine, faults: &mut Vec<Diagnostic>) {
    let seen = reached(machine);
    if seen.is_empty() {
        return; // there is no initial state, and that is said
    }
    for (id, shape) in machine.numbered().filter(|(id, _)| !seen.contains(&End::Shape(*id))) {
        let beside = matches!(shape.kind, ShapeKind::Instance(_)) && machine.out_of(End::Shape(id)).next().is_none();
        if !beside && !machine.is_apart(id) {
            faults.push(fault::unreachable(shape.span, kind_of(machine, id), &shape.name));
        }
    }
}
