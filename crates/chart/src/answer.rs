//! The same machine without answers (spec/charts.md, "Patterns that answer").
//!
//! In: a machine without errors, and its chart. Out: a machine in which an exit with an answer is an action that sets the answer, and
//! then an exit; and in which the exits of a block of a pattern that answers are those of a guard behind it, which looks at the answer.
//! Its first shapes are those of the given machine. INVARIANT: a block is entered anew by an answer for which it has no exit, as a
//! state is not left by a guard that has no exit for its value.

use syntax::Span;

use crate::build::{answer_location, of_instance};
use crate::chart::{Arrow, Chart, End, Machine, Shape, ShapeId, ShapeKind};
use crate::flow::is_beside;
use crate::link::Link;

/// The machine without answers; `None` if it has none.
pub(crate) fn without_answers(chart: &Chart, machine: &Machine) -> Option<Machine> {
    let asks = |(id, shape): &(ShapeId, &Shape)| answering(chart, shape).is_some() && !is_beside(machine, *id);
    let blocks: Vec<ShapeId> = machine.numbered().filter(asks).map(|(id, _)| id).collect();
    if blocks.is_empty() && !machine.answers() {
        return None;
    }
    let mut plain = machine.clone();
    for answer in [true, false] {
        let given = |arrow: &&Arrow| arrow.answer == Some(answer);
        let Some(span) = machine.arrows.iter().find(given).map(|arrow| arrow.span) else { continue };
        let word = if answer { "yes" } else { "no" };
        let rule = format!("{} := {answer}", answer_location(machine));
        let kind = ShapeKind::Action;
        let action = push(&mut plain, &machine.name, machine.span, kind, format!("Answer {word}"), rule);
        for arrow in plain.arrows.iter_mut().filter(|arrow| arrow.answer == Some(answer)) {
            (arrow.to, arrow.answer) = (End::Shape(action), None);
        }
        plain.arrows.push(Arrow { from: End::Shape(action), branch: None, to: End::Exit, answer: None, span });
    }
    for block in blocks {
        let shape = machine.shape(block);
        let Some(pattern) = answering(chart, shape) else { continue };
        let term = of_instance(pattern, shape, &answer_location(pattern));
        let text = format!("{} answers yes", shape.text);
        let guard = push(&mut plain, &shape.name, shape.span, ShapeKind::Guard, text, term);
        for arrow in plain.arrows.iter_mut().filter(|arrow| arrow.from == End::Shape(block)) {
            arrow.from = End::Shape(guard);
        }
        let arrow = |from, branch, to| Arrow { from: End::Shape(from), branch, to, answer: None, span: shape.span };
        plain.arrows.push(arrow(block, None, End::Shape(guard)));
        for branch in [true, false] {
            if machine.branch(block, branch).is_none() {
                plain.arrows.push(arrow(guard, Some(branch), End::Shape(block)));
            }
        }
    }
    Some(plain)
}

/// The pattern of an instance, if it answers.
pub(crate) fn answering<'c>(chart: &'c Chart, shape: &Shape) -> Option<&'c Machine> {
    chart.pattern_of(shape).filter(|pattern| pattern.answers())
}

/// A shape that no text declares.
fn push(machine: &mut Machine, of: &str, span: Span, kind: ShapeKind, text: String, link: String) -> ShapeId {
    let id = ShapeId(machine.shapes.len());
    machine.shapes.push(Shape {
        name: format!("{of}_{}", id.0),
        text,
        kind,
        link: Some(Link { name: of.to_string(), text: link, is_application: false, span }),
        refinement: None,
        inside: None,
        span,
    });
    id
}
