//! System → a C++20 program over the runtime of `cpp/`: one thread a task, the channels as the chart has them, a hook
//! class a component for the user's own code.
//!
//! In: a chart whose system is without errors. Out: [`Generated`]: files that are written anew each time, and files of
//! the user's that are written once. What cannot be generated is refused by name and position. The phases themselves are
//! the runtime's (`cpp/include/groundstate/phases.hpp`); here is only decided which of them each phase is.

mod cycle;
mod files;
mod header;
mod names;

use syntax::{Diagnostic, Span};

use crate::build::system::late;
use crate::chart::Chart;
use crate::fault;
use crate::system::{Action, System};

/// The files of a program.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Generated {
    /// Written anew each time: the path within the folder, and the text.
    pub decided: Vec<(String, String)>,
    /// The user's: written where they are missing, and never touched again.
    pub once: Vec<(String, String)>,
}

/// Options of the program.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Form {
    /// Buffers are handed over by one atomic exchange instead of the protocol with a lock.
    pub wait_free: bool,
    /// The namespace of the generated classes and of the user's; made of the system's name where none is given.
    pub namespace: Option<String>,
}

/// What of a system cannot be generated; the places are those of the chart.
pub fn ungenerated(system: &System) -> Vec<Diagnostic> {
    let mut faults = late(system);
    for component in &system.components {
        let mut hooks: Vec<String> = Vec::new();
        for phase in &component.phases {
            match phase.action {
                Action::Elaborate(_) if hooks.contains(&cpp_names::snake(&phase.subject)) => {
                    faults.push(fault::not_generated(
                        phase.span,
                        format!("a second elaboration `{}` of `{}` cannot be generated", phase.subject, component.name),
                        "each elaboration is a function of the component's hook class",
                        "rename one of them",
                    ))
                }
                Action::Elaborate(_) => hooks.push(cpp_names::snake(&phase.subject)),
                Action::Write(_) if hooks.is_empty() => faults.push(fault::not_generated(
                    phase.span,
                    format!("`{}` writes `{}` before it has elaborated anything", component.name, phase.subject),
                    "what is written comes from the component's hook, and there is none before this phase",
                    "put an `elaborate` phase before it",
                )),
                _ => {}
            }
        }
    }
    let mut types: Vec<(String, Span)> = Vec::new();
    let all = system.channels.iter().map(|channel| (&channel.name, channel.span));
    for (name, span) in all.chain(system.components.iter().map(|component| (&component.name, component.span))) {
        let made = names::pascal(name);
        match types.iter().find(|(known, _)| *known == made) {
            Some(_) => faults.push(fault::not_generated(
                span,
                format!("`{name}` and another name make one type `{made}`"),
                "components and channels are types of the generated code",
                "rename one of them",
            )),
            None => types.push((made, span)),
        }
    }
    faults
}

/// The program of a system of which nothing is [`ungenerated`]. `file` names the chart in comments.
pub fn generate(chart: &Chart, system: &System, file: &str, form: &Form) -> Generated {
    let name = cpp_names::snake(&system.name);
    let space = form.namespace.clone().unwrap_or_else(|| name.clone());
    let header = header::header(system, file, &space, form);
    let mut once = vec![
        ("CMakeLists.txt".to_string(), files::cmake(&chart.name, &name)),
        ("main.cpp".to_string(), files::main(system, &space)),
        ("data.hpp".to_string(), files::data(system, &space)),
    ];
    once.extend(
        system
            .components
            .iter()
            .map(|component| (format!("{}.hpp", component.name), files::component(component, &name, &space))),
    );
    Generated { decided: vec![(format!("generated/{name}.hpp"), header)], once }
}
