//! The transitions of a machine: what its arrows mean, step by step (spec/charts.md, "Meaning").
//!
//! In: a machine without errors, and its chart. Out: one [`Transition`] for each path that begins at a control state,
//! at the entering arrow or at a block that has been left, and leads over guards and actions to the end of the step.

use syntax::Span;

use crate::chart::{Chart, End, Machine, ShapeId, ShapeKind};

/// Where a transition starts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Origin {
    /// The control variable is undef.
    Enter,
    /// The control variable has the value of this state.
    State(ShapeId),
    /// The machine is in this block, and its pattern has been left.
    Left(ShapeId),
}

/// Where a transition ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Target {
    /// A control state.
    State(ShapeId),
    /// A block of a pattern that takes steps: it is entered in this step.
    Block(ShapeId),
    /// The control variable becomes undef.
    Exit,
}

/// One path from a control state to the next.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Transition {
    /// Where it starts.
    pub origin: Origin,
    /// The guards on the path, and whether each holds.
    pub guards: Vec<(ShapeId, bool)>,
    /// The actions on the path.
    pub actions: Vec<ShapeId>,
    /// Guards, with whether they hold, and actions, in the order of the path.
    pub stops: Vec<(ShapeId, Option<bool>)>,
    /// Where it ends.
    pub target: Target,
    /// The place of its last stop.
    pub span: Span,
}

/// LIMIT: the most transitions of one machine that are considered; paths that split and join double each time.
pub const MAX_TRANSITIONS: usize = 10_000;

/// LIMIT: the most stops on all of them; in a chart with errors, paths may split without leading anywhere.
const MAX_STOPS: usize = 100 * MAX_TRANSITIONS;

/// The transitions of a machine, over the shapes of [`Machine::flat`]; those of one origin are in the order of its arrows. A path that returns to itself,
/// which is an error, is left out.
pub fn transitions(chart: &Chart, machine: &Machine) -> Vec<Transition> {
    let machine = machine.flat();
    paths_from(chart, machine, origins(chart, machine))
}

/// The transitions as they are drawn, those that start at composite states, too. The machine has no answers.
pub(crate) fn drawn_transitions(chart: &Chart, machine: &Machine) -> Vec<Transition> {
    let composites = machine.numbered().filter(|(_, shape)| shape.composite().is_some());
    let mut origins = origins(chart, machine);
    origins.extend(composites.map(|(id, _)| Origin::State(id)));
    paths_from(chart, machine, origins)
}

fn paths_from(chart: &Chart, machine: &Machine, origins: Vec<Origin>) -> Vec<Transition> {
    let mut found = Vec::new();
    let mut budget = MAX_STOPS;
    for origin in origins {
        let start = match origin {
            Origin::Enter => End::Enter,
            Origin::State(id) | Origin::Left(id) => End::Shape(id),
        };
        for arrow in machine.out_of(start) {
            let mut open: Vec<Way> = vec![(arrow.to, arrow.span, Vec::new())];
            while let Some(way) = open.pop() {
                if found.len() >= MAX_TRANSITIONS || budget == 0 {
                    return found;
                }
                budget -= 1;
                follow(chart, machine, origin, way, &mut open, &mut found);
            }
        }
    }
    found
}

type Way = (End, Span, Vec<(ShapeId, Option<bool>)>);

fn follow(
    chart: &Chart,
    machine: &Machine,
    origin: Origin,
    (end, span, mut stops): Way,
    open: &mut Vec<Way>,
    found: &mut Vec<Transition>,
) {
    let target = match end {
        End::Exit => Some(Target::Exit),
        End::Enter => return,
        End::Shape(id) => match machine.shape(id).kind {
            ShapeKind::State { .. } | ShapeKind::Composite(_) => Some(Target::State(id)),
            ShapeKind::Instance(_) if is_block(chart, machine, id) => Some(Target::Block(id)),
            _ => None,
        },
    };
    match (target, end) {
        (None, End::Shape(id)) if stops.iter().any(|(stop, _)| *stop == id) => {}
        (Some(target), _) => found.push(Transition {
            origin,
            guards: stops.iter().filter_map(|(id, branch)| Some((*id, (*branch)?))).collect(),
            actions: stops.iter().filter(|(_, branch)| branch.is_none()).map(|(id, _)| *id).collect(),
            stops,
            target,
            span,
        }),
        (None, End::Shape(id)) if machine.shape(id).kind == ShapeKind::Guard => {
            for branch in [false, true] {
                if let Some(arrow) = machine.branch(id, branch) {
                    let mut stops = stops.clone();
                    stops.push((id, Some(branch)));
                    open.push((arrow.to, arrow.span, stops));
                }
            }
        }
        (None, End::Shape(id)) => {
            stops.push((id, None));
            open.extend(machine.out_of(end).next().map(|arrow| (arrow.to, arrow.span, stops)));
        }
        (None, _) => {}
    }
}

/// Where transitions of a machine start, in the order of its shapes.
pub(crate) fn origins(chart: &Chart, machine: &Machine) -> Vec<Origin> {
    let enter = machine.is_pattern.then_some(Origin::Enter);
    let shapes = machine.numbered().filter_map(|(id, shape)| match shape.kind {
        ShapeKind::State { .. } => Some(Origin::State(id)),
        ShapeKind::Instance(_) if is_block(chart, machine, id) => Some(Origin::Left(id)),
        _ => None,
    });
    enter.into_iter().chain(shapes).collect()
}

/// Determines which machines of a chart take steps. Returns the machines that contain themselves, by index, with the
/// patterns through which they do.
pub(crate) fn settle(chart: &mut Chart) -> Vec<(usize, Vec<String>)> {
    for machine in &mut chart.machines {
        machine.steps = machine.shapes.iter().any(|shape| matches!(shape.kind, ShapeKind::State { .. }));
    }
    loop {
        let stays = |machine: &&Machine| machine.numbered().any(|(id, _)| is_block(chart, machine, id));
        let news = chart.machines.iter().position(|machine| !machine.steps && stays(&machine));
        let Some(index) = news else { break };
        chart.machines[index].steps = true;
    }
    (0..chart.machines.len()).filter_map(|index| Some((index, circle(chart, &chart.machines[index])?))).collect()
}

/// The patterns through which a machine contains itself; its own name is first and last.
fn circle(chart: &Chart, machine: &Machine) -> Option<Vec<String>> {
    let inner = |machine: &Machine| -> Vec<String> {
        let patterns = machine.shapes.iter().filter_map(|shape| chart.pattern_of(shape));
        patterns.map(|pattern| pattern.name.clone()).collect()
    };
    let mut open = vec![vec![machine.name.clone()]];
    let mut seen = Vec::new();
    while let Some(way) = open.pop() {
        let Some(last) = way.last().and_then(|name| chart.machine(name)) else { continue };
        for name in inner(last) {
            let longer: Vec<String> = way.iter().cloned().chain([name.clone()]).collect();
            if name == machine.name {
                return Some(longer);
            }
            if !seen.contains(&name) {
                seen.push(name);
                open.push(longer);
            }
        }
    }
    None
}

/// Whether a shape is an instance on a path, of a pattern that takes steps: the machine stays in it until the pattern
/// is left.
pub(crate) fn is_block(chart: &Chart, machine: &Machine, id: ShapeId) -> bool {
    let shape = machine.shape(id);
    let steps = chart.pattern_of(shape).is_none_or(Machine::takes_steps);
    matches!(shape.kind, ShapeKind::Instance(_)) && steps && !is_beside(machine, id)
}

/// Whether a shape is an instance that no path leads to: its rule runs in every step, parallel to the paths.
pub(crate) fn is_beside(machine: &Machine, id: ShapeId) -> bool {
    matches!(machine.shape(id).kind, ShapeKind::Instance(_))
        && !machine.arrows.iter().any(|arrow| arrow.to == End::Shape(id) || arrow.from == End::Shape(id))
}
