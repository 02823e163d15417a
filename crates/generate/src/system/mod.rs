//! Generates a C++20 program from a system, over the runtime of `cpp/`: one thread per task, the chart's channels, a
//! hook class per component for the user's own code.
//!
//! In: a chart whose system has no errors. Out: [`Generated`]: files that are overwritten each time, and files of the
//! user's that are written once. What cannot be generated is refused with its name and place. The runtime implements
//! the phases (`cpp/include/groundstate/phases.hpp`); this module only selects them.

mod bounds;
mod cycle;
mod files;
mod header;
mod machines;
mod map;
mod names;
mod plan;
mod refuse;

use chart::system::System;
use syntax::Span;

use crate::names::{namespace, snake};

pub use plan::{Form, MachineClass};
pub use refuse::ungenerated;

/// The files of a program.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Generated {
    /// Overwritten each time: the path within the folder, and the text.
    pub decided: Vec<(String, String)>,
    /// The user's files: written if missing, never touched again.
    pub once: Vec<(String, String)>,
    /// Lines of the first file, counted from 1, and the parts of the chart that they stand for.
    pub lines: Vec<(u32, Span)>,
}

/// The program of a system for which [`ungenerated`] is empty. Comments call the chart `file`.
pub fn generate(system: &System, file: &str, form: &Form) -> Generated {
    let name = snake(&system.name);
    let space = form.namespace.clone().unwrap_or_else(|| space(&system.name, form));
    let header = header::header(system, file, &space, form);
    let lines = map::lines(system, &header);
    let mut once = vec![
        ("CMakeLists.txt".to_string(), files::cmake(file, &name, !form.classes.is_empty())),
        ("main.cpp".to_string(), files::main(system, &space)),
        ("data.hpp".to_string(), files::data(system, &space)),
    ];
    once.extend(system.components.iter().enumerate().map(|(index, component)| {
        let text = match machines::class_of(system, index, form) {
            Some(class) => machines::file(system, index, class, &name, &space, form),
            None => files::component(component, &name, &space),
        };
        (format!("{}.hpp", component.name), text)
    }));
    let mut decided = vec![(format!("generated/{name}.hpp"), header)];
    if machines::has_messages(system) {
        decided.push(("generated/messages.hpp".to_string(), machines::messages(system, file, &space)));
    }
    let computing = machines::header(system, file, &name, &space, form);
    decided.extend(computing.map(|text| (format!("generated/{name}_machines.hpp"), text)));
    Generated { decided, once, lines }
}

/// The namespace of a system of this name: none that the C library or the class of a component's machine has.
fn space(name: &str, form: &Form) -> String {
    let space = namespace(name);
    let is_taken = form.classes.iter().any(|class| class.name == space);
    if is_taken { format!("{space}_system") } else { space }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_system_has_a_namespace_of_its_own() {
        let class = |name: &str| MachineClass {
            file: "Rover.asm".to_string(),
            machine: "Rover".to_string(),
            name: name.to_string(),
            header: String::new(),
            renamed: Vec::new(),
            domains: Vec::new(),
        };
        let form =
            |classes: &[&str]| Form { classes: classes.iter().map(|name| class(name)).collect(), ..Form::default() };
        assert_eq!(space("rover", &form(&["planner"])), "rover");
        assert_eq!(space("rover", &form(&["planner", "rover"])), "rover_system");
        for (name, own) in
            [("time", "time_1"), ("System", "system_1"), ("main", "main_1"), ("visionSystem", "vision_system")]
        {
            assert_eq!(space(name, &form(&[])), own);
        }
    }
}
