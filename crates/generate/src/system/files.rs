//! Generates the user's files, which are written only once: data types, a hook class per component, the main function,
//! the build.

use std::fmt::Write;

use chart::system::{Action, Component, System};

use super::names::{datum, hook, member, pascal, readers};

pub(super) fn data(system: &System, space: &str) -> String {
    let mut text = format!(
        "// What goes through the channels. This file is yours: it is written once, and never touched again.\n\
         //\n// A function `bool valid(const T&)` beside a type says which data may be handed over: one that is not valid is not\n\
         // published, but counted.\n#pragma once\n\nnamespace {space} {{\n"
    );
    for channels in system.drawn_channels().filter(|channels| channels[0].message.is_none()) {
        let from = &system.components[channels[0].from].name;
        let to = readers(system, channels);
        let _ = write!(text, "\n/// From {from} to {to}.\nstruct {} {{\n}};\n", datum(system, &channels[0].drawn));
    }
    let _ = writeln!(text, "\n}}  // namespace {space}");
    text
}

pub(super) fn component(component: &Component, name: &str, space: &str) -> String {
    let class = pascal(&component.name);
    let mut text = format!(
        "// {}. This file is yours: it is written once, and never touched again.\n#pragma once\n\n\
         #include \"generated/{name}.hpp\"\n\nnamespace {space} {{\n\nclass {class}Hooks final : public {class} {{\n  public:\n",
        component.text.split_whitespace().collect::<Vec<_>>().join(" ")
    );
    for phase in component.phases.iter().filter(|phase| matches!(phase.action, Action::Elaborate(_))) {
        let _ = writeln!(
            text,
            "    bool {}(const Cycle& /*cycle*/, const In& /*in*/, Out& /*out*/) override {{ return true; }}",
            hook(&phase.subject)
        );
    }
    let _ = writeln!(text, "}};\n\n}}  // namespace {space}");
    text
}

pub(super) fn main(system: &System, space: &str) -> String {
    let mut text = "// The program. This file is yours: it is written once, and never touched again.\n".to_string();
    for component in &system.components {
        let _ = writeln!(text, "#include \"{}.hpp\"", component.name);
    }
    text.push_str("\nint main(int count, char** words) {\n");
    for component in &system.components {
        let _ = writeln!(text, "    {space}::{}Hooks {};", pascal(&component.name), member(&component.name));
    }
    let hooks: Vec<String> = system.components.iter().map(|component| member(&component.name)).collect();
    let _ = write!(
        text,
        "    return groundstate::run_program<{space}::System>(count, words, {space}::Hooks{{{}}});\n}}\n",
        hooks.join(", ")
    );
    text
}

pub(super) fn cmake(chart: &str, name: &str, machines: bool) -> String {
    let (find, sources, rounding) = match machines {
        false => ("", "", ""),
        true => (
            "file(GLOB machines CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/generated/machines/*.cpp)\n",
            " ${machines}",
            " -ffp-contract=off",
        ),
    };
    format!(
        "# The program of {chart}. This file is yours: it is written once, and never touched again.\n\
         cmake_minimum_required(VERSION 3.16)\nproject({name} LANGUAGES CXX)\n\n\
         set(GROUNDSTATE_CPP \"\" CACHE PATH \"A folder of the C++ runtime, with include/ in it; empty: what was generated\")\n\
         set({name}_runtime \"${{CMAKE_CURRENT_SOURCE_DIR}}/generated\")\nif(GROUNDSTATE_CPP)\n  \
         set({name}_runtime \"${{GROUNDSTATE_CPP}}\")\nendif()\n\
         if(NOT CMAKE_BUILD_TYPE)\n  set(CMAKE_BUILD_TYPE RelWithDebInfo)\nendif()\n\
         find_package(Threads REQUIRED)\n\n{find}add_executable({name} main.cpp{sources})\n\
         target_include_directories({name} PRIVATE ${{CMAKE_CURRENT_SOURCE_DIR}} ${{{name}_runtime}}/include)\n\
         target_compile_features({name} PRIVATE cxx_std_20)\n\
         target_compile_options({name} PRIVATE -Wall -Wextra -Wconversion{rounding})\n\
         target_link_libraries({name} PRIVATE Threads::Threads)\n"
    )
}
