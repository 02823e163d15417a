//! Generates the CMake project around generated code.

use crate::model::generator::Options;
use crate::model::text::Text;

/// `CMakeLists.txt`
pub(crate) fn project(name: &str, options: &Options) -> Text {
    let mut text = Text::default();
    let target = format!("{name}_machine");
    text.line(
        "# Made by groundstate. Link groundstate::NAME_machine, in a project of its own or by add_subdirectory."
            .replace("NAME", name),
    );
    text.line("cmake_minimum_required(VERSION 3.21)");
    text.line(format!("project({target} LANGUAGES CXX)\n"));
    text.line("set(CMAKE_CXX_STANDARD 20)\nset(CMAKE_CXX_STANDARD_REQUIRED ON)\nset(CMAKE_CXX_EXTENSIONS OFF)");
    text.line("if(NOT CMAKE_BUILD_TYPE)\n    set(CMAKE_BUILD_TYPE Release)\nendif()");
    // The same text as in a system's program (crates/generate/src/system/files.rs), since one project may contain both.
    text.line("set(GROUNDSTATE_CPP \"\" CACHE PATH \"A folder of the C++ runtime, with include/ in it; empty: what was generated\")");
    text.line(format!(
        "set({target}_runtime \"${{CMAKE_CURRENT_SOURCE_DIR}}/runtime\")\nif(GROUNDSTATE_CPP)\n    \
         set({target}_runtime \"${{GROUNDSTATE_CPP}}\")\nendif()\n"
    ));
    text.line(format!("add_library({target} {name}.cpp)\nadd_library(groundstate::{target} ALIAS {target})"));
    text.line(format!("target_include_directories({target} PUBLIC ${{CMAKE_CURRENT_SOURCE_DIR}})"));
    text.line(format!("target_include_directories({target} SYSTEM PUBLIC ${{{target}_runtime}}/include)"));
    text.line(format!("target_compile_options({target} PRIVATE -Wall -Wextra -Wconversion)"));
    text.line("# Products and sums are rounded one by one, as the machine's are.");
    text.line(format!("target_compile_options({target} PUBLIC -ffp-contract=off)"));
    if options.bare {
        text.line(format!(
            "target_compile_options({target} PUBLIC -fno-exceptions -fno-rtti)\n\
             target_compile_definitions({target} PUBLIC GROUNDSTATE_BARE GROUNDSTATE_SINGLE_THREADED)"
        ));
    } else {
        text.line(format!(
            "\nadd_executable({name}_replay replay.cpp)\ntarget_link_libraries({name}_replay PRIVATE {target})"
        ));
    }
    text
}
