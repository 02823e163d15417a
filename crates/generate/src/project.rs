//! The CMake project around generated code.

use crate::generator::Options;
use crate::text::Text;

/// `CMakeLists.txt`
pub(crate) fn project(name: &str, options: &Options) -> Text {
    let mut text = Text::default();
    text.line("# Made by groundstate. GROUNDSTATE_CPP is the folder that holds include/groundstate.");
    text.line("cmake_minimum_required(VERSION 3.21)");
    text.line(format!("project({name} LANGUAGES CXX)\n"));
    text.line("set(CMAKE_CXX_STANDARD 20)\nset(CMAKE_CXX_STANDARD_REQUIRED ON)\nset(CMAKE_CXX_EXTENSIONS OFF)");
    text.line("if(NOT CMAKE_BUILD_TYPE)\n    set(CMAKE_BUILD_TYPE Release)\nendif()");
    text.line(
        "set(GROUNDSTATE_CPP \"${CMAKE_CURRENT_SOURCE_DIR}/runtime\" CACHE PATH \"The folder of the runtime\")\n",
    );
    text.line(format!("add_library({name} {name}.cpp)"));
    text.line(format!("target_include_directories({name} PUBLIC ${{CMAKE_CURRENT_SOURCE_DIR}})"));
    text.line(format!("target_include_directories({name} SYSTEM PUBLIC ${{GROUNDSTATE_CPP}}/include)"));
    text.line(format!("target_compile_options({name} PRIVATE -Wall -Wextra -Wconversion)"));
    text.line("# Products and sums are rounded one by one, as the machine's are.");
    text.line(format!("target_compile_options({name} PUBLIC -ffp-contract=off)"));
    if options.bare {
        text.line(format!(
            "target_compile_options({name} PUBLIC -fno-exceptions -fno-rtti)\n\
             target_compile_definitions({name} PUBLIC GROUNDSTATE_BARE GROUNDSTATE_SINGLE_THREADED)"
        ));
    } else {
        text.line(format!(
            "\nadd_executable({name}_replay replay.cpp)\ntarget_link_libraries({name}_replay PRIVATE {name})"
        ));
    }
    text
}
