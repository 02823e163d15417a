//! Tells which shape of a picture lights up in a state of the specification: the term to evaluate, and the shape for
//! each of its values. Used by pages that show a run.

use crate::build::state_value;
use crate::chart::{Control, ShapeKind};
use crate::subject::{Part, Subject};
use crate::system::{Component, Phase};

/// Something whose light moves from shape to shape: a machine running for one element, or a component of a system.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Lights {
    /// The element or the component; empty if there is only one.
    pub name: String,
    /// The control variable, for this element.
    pub term: String,
    /// The shapes for its values.
    pub shapes: Vec<Light>,
}

/// A shape that is lit while the control variable has a value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Light {
    /// The value, as the specification writes it.
    pub value: String,
    /// The name of the shape in `data-shape`.
    pub shape: String,
    /// The label in words.
    pub label: String,
}

impl Subject<'_> {
    /// What lights up in the picture. A machine with parameters is listed once for each of `elements`, which replace
    /// the parameters (several are separated by commas); a system's components light up by their present phase. A
    /// machine without a control variable has no lights.
    pub fn lights(&self, elements: &[String]) -> Vec<Lights> {
        let (chart, machine) = match self.part {
            Part::Machine(machine) => (self.chart, machine),
            Part::System(system) => {
                let phase = |component: &Component, phase: &Phase| Light {
                    value: phase.name.clone(),
                    shape: format!("{}/{}", component.name, phase.drawn),
                    label: phase.name.clone(),
                };
                let component = |component: &Component| Lights {
                    name: component.text.clone(),
                    // The function in models built from systems, see `build::system`.
                    term: format!("scheduler_currentPhase({})", component.name),
                    shapes: component.phases.iter().map(|one| phase(component, one)).collect(),
                };
                return system.components.iter().map(component).collect();
            }
        };
        let Some(control) = &machine.control else { return Vec::new() };
        let stays = machine.numbered().filter(|(_, shape)| !matches!(shape.kind, ShapeKind::Guard | ShapeKind::Action));
        let shapes: Vec<Light> = stays
            .map(|(id, shape)| Light {
                value: state_value(chart, machine, id),
                shape: shape.name.clone(),
                label: shape.text.replace('\n', " "),
            })
            .collect();
        let one = [String::new()];
        let elements = if machine.parameters.is_empty() { &one } else { elements };
        let of = |element: &String| {
            let arguments: Vec<&str> = element.split(',').map(str::trim).filter(|text| !text.is_empty()).collect();
            let term = match control {
                Control::Made { name, .. } if arguments.is_empty() => name.clone(),
                Control::Made { name, .. } => format!("{name}({})", arguments.join(", ")),
                Control::Linked(link) => {
                    let variables = machine.parameters.iter().map(|parameter| parameter.variable.as_str());
                    variables
                        .zip(&arguments)
                        .fold(link.text.clone(), |term, (variable, argument)| put_in(&term, variable, argument))
                }
            };
            Lights { name: element.clone(), term, shapes: shapes.clone() }
        };
        elements.iter().map(of).collect()
    }
}

/// A term in which an argument replaces a variable.
fn put_in(term: &str, variable: &str, argument: &str) -> String {
    let mut out = String::new();
    let mut rest = term;
    while let Some(at) = rest.find(variable) {
        let after = &rest[at + variable.len()..];
        let whole = !after.starts_with(|c: char| c.is_alphanumeric() || c == '_');
        out.push_str(&rest[..at]);
        out.push_str(if whole { argument } else { variable });
        rest = after;
    }
    out + rest
}

#[cfg(test)]
mod tests {
    use super::*;
    use syntax::{FileId, parse_chart};

    #[test]
    fn parameters_are_replaced() {
        assert_eq!(put_in("state(phase($c), $clock)", "$c", "robot"), "state(phase(robot), $clock)");
        let text = "chart A machine m($c in Crane) control arm initial state toReach state held {HELD} \
                    guard g toReach -> g yes -> held endmachine";
        let (chart, _) = crate::read(FileId(0), &parse_chart(FileId(0), text));
        let subject = crate::subjects(&chart).next().expect("the machine");
        let lights = subject.lights(&["left".to_string(), "right".to_string()]);
        assert_eq!(lights[1].term, "arm(right)");
        let values: Vec<&str> = lights[1].shapes.iter().map(|light| light.value.as_str()).collect();
        assert_eq!(values, ["TO_REACH", "HELD"]);
    }
}
