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
mod plan;
mod refuse;

use chart::Chart;
use chart::system::System;

use crate::names::snake;

pub use plan::Form;
pub use refuse::ungenerated;

/// The files of a program.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Generated {
    /// Written anew each time: the path within the folder, and the text.
    pub decided: Vec<(String, String)>,
    /// The user's: written where they are missing, and never touched again.
    pub once: Vec<(String, String)>,
}

/// The program of a system of which nothing is [`ungenerated`]. `file` names the chart in comments.
pub fn generate(chart: &Chart, system: &System, file: &str, form: &Form) -> Generated {
    let name = snake(&system.name);
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
