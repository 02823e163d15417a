//! Which lines of a system's header stand for which parts of the chart.
//!
//! In: a system and the header made of it. Out: for each component its class, the hooks of its elaborations, its task and its cycle.
//! The lines are found by the declarations that [`super::header`] writes; a test holds every component and elaboration to have theirs.

use chart::system::{Action, System};
use syntax::Span;

use super::names::{hook, pascal};

/// The lines, counted from 1, and what each stands for.
pub(super) fn lines(system: &System, header: &str) -> Vec<(u32, Span)> {
    let mut out = Vec::new();
    let mut within = None;
    for (line, number) in header.lines().zip(1..) {
        let begins = |component: &&chart::system::Component| line == format!("struct {} {{", pascal(&component.name));
        if let Some(component) = system.components.iter().find(begins) {
            within = Some(component);
            out.push((number, component.span));
            continue;
        }
        if line == "};" {
            within = None;
        }
        if let Some(component) = within {
            let declared = |name: &str| line.contains(&format!(" bool {}(", hook(name)));
            let phase = component.phases.iter();
            let phase = phase.filter(|phase| matches!(phase.action, Action::Elaborate(_)));
            let found = phase.into_iter().find(|phase| declared(&phase.subject));
            out.extend(found.map(|phase| (number, phase.span)));
            continue;
        }
        let task = |component: &&chart::system::Component| {
            line.contains(&format!("{{.name = \"{}\",", component.name))
                || line.contains(&format!(" void {}_cycle(", component.name))
        };
        out.extend(system.components.iter().find(task).map(|component| (number, component.span)));
    }
    out
}
