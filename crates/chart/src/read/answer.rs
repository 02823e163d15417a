//! Checks patterns that answer yes or no, the blocks of such patterns, and what is said to refine guards and actions.
//!
//! In: a chart whose machines are read, in which it is known which of them take steps. A pattern that answers does so on each path, can
//! give both answers, and is at work after the step that enters it. INVARIANT: what is `to refine` is never in error, since what refines
//! it may come later; so it is warned of.

use syntax::{Diagnostic, Span};

use super::{Reader, structure};
use crate::chart::{Chart, End, Machine, Shape, ShapeId, ShapeKind};
use crate::fault::answer as fault;
use crate::flow::is_block;

impl Reader {
    /// The faults of patterns that answer, and of their blocks.
    pub(super) fn answers(&mut self, chart: &Chart) {
        for machine in &chart.machines {
            if machine.is_pattern && machine.answers() {
                self.faults.extend(of_pattern(chart, machine));
            }
            for arrow in &machine.arrows {
                let End::Shape(id) = arrow.from else { continue };
                let shape = machine.shape(id);
                let Some(pattern) = chart.pattern_of(shape) else { continue };
                match (pattern.answers(), arrow.branch) {
                    (true, None) => self.faults.push(fault::bare_block(arrow.span, &shape.name, &pattern.name)),
                    (false, Some(_)) => {
                        self.faults.push(fault::needless_branch(arrow.span, &shape.name, &pattern.name));
                    }
                    _ => {}
                }
            }
        }
    }

    /// Warns of what cannot refine a shape.
    pub(super) fn refinements(&mut self, chart: &Chart) {
        for machine in &chart.machines {
            for shape in &machine.shapes {
                let by = shape.refinement.as_ref().and_then(|refinement| refinement.by.as_deref());
                let unfit = by.and_then(|by| Some((by, unfit(chart, machine, shape, by)?)));
                if let Some((by, (reason, help))) = unfit {
                    self.faults.push(fault::unfit(shape.span, &shape.name, by, &reason, help));
                }
            }
        }
    }
}

fn of_pattern(chart: &Chart, machine: &Machine) -> Vec<Diagnostic> {
    let name = &machine.name;
    let exits = || machine.arrows.iter().filter(|arrow| arrow.to == End::Exit);
    let Some(with) = exits().find(|arrow| arrow.answer.is_some()) else { return Vec::new() };
    let without = exits().filter(|arrow| arrow.answer.is_none());
    let mut faults: Vec<Diagnostic> = without.map(|arrow| fault::sometimes(arrow.span, name, with.span)).collect();
    if !machine.takes_steps() {
        faults.push(fault::at_once(machine.span, name));
        return faults;
    }
    let reached = structure::reached(machine);
    for answer in [true, false] {
        if !exits().any(|arrow| arrow.answer == Some(answer) && reached.contains(&arrow.from)) {
            faults.push(fault::always(machine.span, name, answer));
        }
    }
    faults.extend(
        not_entered(chart, machine).map(|(span, guard, missing)| fault::not_entered(span, name, guard, missing)),
    );
    faults
}

/// A guard on the way into a pattern that has no exit for a value: its place, its name and the value.
fn not_entered<'m>(chart: &Chart, machine: &'m Machine) -> Option<(Span, &'m str, bool)> {
    let mut open = vec![End::Enter];
    let mut seen: Vec<ShapeId> = Vec::new();
    while let Some(end) = open.pop() {
        for arrow in machine.out_of(end) {
            let End::Shape(id) = arrow.to else { continue };
            let shape = machine.shape(id);
            let goes_on = match &shape.kind {
                ShapeKind::Guard => {
                    let missing = [true, false].into_iter().find(|branch| machine.branch(id, *branch).is_none());
                    if let Some(missing) = missing {
                        return Some((shape.span, &shape.name, missing));
                    }
                    true
                }
                ShapeKind::Action => true,
                ShapeKind::Instance(_) => !is_block(chart, machine, id),
                ShapeKind::State { .. } | ShapeKind::Composite(_) => false,
            };
            if goes_on && !seen.contains(&id) {
                seen.push(id);
                open.push(End::Shape(id));
            }
        }
    }
    None
}

/// Why a shape of a machine cannot be refined by what is named, and what to do.
fn unfit(chart: &Chart, machine: &Machine, shape: &Shape, by: &str) -> Option<(String, String)> {
    if !matches!(shape.kind, ShapeKind::Guard | ShapeKind::Action) {
        return None;
    }
    let Some(pattern) = chart.all_patterns().find(|pattern| pattern.name == by) else {
        if chart.machine(by).is_some() {
            let help = "declare it as a `pattern`, with paths from `enter` to `exit`".to_string();
            return Some(("it is a machine, which is never left".to_string(), help));
        }
        if chart.beyond.iter().any(|name| name == by) {
            let reason = "the pattern stands in a chart that an imported chart imports".to_string();
            return Some((reason, "import that chart here, too".to_string()));
        }
        // A name that nothing has yet is a plan; one that is nearly that of a pattern is a slip.
        let close = model::nearest(by, chart.all_patterns().map(|pattern| pattern.name.as_str()))?;
        return Some(("there is no such pattern".to_string(), format!("did you mean `{close}`?")));
    };
    if let Some(over) = way_back(chart, by, &machine.name) {
        let help = "let another pattern refine it, or lead a path back to a control state".to_string();
        return Some((format!("the pattern leads back to `{}`: {}", machine.name, over.join(" \u{2192} ")), help));
    }
    match (&shape.kind, pattern.answers()) {
        (ShapeKind::Guard, false) => Some((
            "a guard has two exits, and the pattern is left without an answer".to_string(),
            "let the paths of the pattern end at `exit yes` and `exit no`".to_string(),
        )),
        (ShapeKind::Action, true) => Some((
            "the pattern answers yes or no, and an action has one way on".to_string(),
            "let the paths of the pattern end at `exit`; or declare a guard instead of the action".to_string(),
        )),
        _ => None,
    }
}

/// The patterns, by instances and by refinements, through which a pattern leads to a machine; if it does.
fn way_back(chart: &Chart, from: &str, to: &str) -> Option<Vec<String>> {
    let mut open = vec![vec![from.to_string()]];
    let mut seen = vec![from.to_string()];
    while let Some(way) = open.pop() {
        let last = way.last()?;
        if last == to {
            return Some(way);
        }
        let Some(machine) = chart.machine(last) else { continue };
        for shape in &machine.shapes {
            let next = match &shape.kind {
                ShapeKind::Instance(pattern) => Some(&pattern.name),
                _ => shape.refinement.as_ref().and_then(|refinement| refinement.by.as_ref()),
            };
            if let Some(next) = next.filter(|next| !seen.contains(next)) {
                seen.push(next.clone());
                open.push(way.iter().cloned().chain([next.clone()]).collect());
            }
        }
    }
    None
}
