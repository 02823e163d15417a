//! Generates C++ from a model: its state, its step and its environment as one class.
//!
//! In: a [`program::Program`] with its texts, a machine that has made the initial state, [`Options`]. Out: the
//! [`Generated`] files, or the parts that cannot be generated, each with its place. The machine defines the meaning of
//! rules; agreement tests compare the generated code with it step by step. It must not know files or compilers.

mod accessors;
mod assumptions;
mod body;
mod choice;
mod class;
mod code;
mod collected;
mod driver;
mod form;
mod generator;
mod interval;
mod members;
mod nesting;
mod operation;
mod plan;
mod project;
mod range;
mod reach;
mod recursion;
mod renamed;
pub mod replay;
mod rule;
mod selection;
mod settle;
mod sites;
mod storage;
mod term;
mod text;
mod types;
mod writes;

use program::Program;
use syntax::{Diagnostic, Sources, Span};

pub use generator::Options;
pub use text::Mapping;

/// One generated file.
#[derive(Debug, Clone)]
pub struct File {
    /// Its name within the output folder.
    pub name: String,
    /// Its text.
    pub text: String,
    /// Which of its lines correspond to which places of the model.
    pub mappings: Vec<Mapping>,
}

/// The files generated from a model.
#[derive(Debug, Clone)]
pub struct Generated {
    /// The namespace of the code and the stem of the files' names.
    pub name: String,
    /// Files that are overwritten each time.
    pub files: Vec<File>,
    /// The places that faults name by number; the first has number 1.
    pub sites: Vec<Span>,
    /// Names that C++ or the class has already and that were changed: `(model's, class's)`.
    pub renamed: Vec<(String, String)>,
}

/// Generates a model.
///
/// # Errors
/// What cannot be generated, each with its place.
pub fn generate(
    program: &Program,
    sources: &Sources,
    started: &mut machine::Machine,
    options: &Options,
) -> Result<Generated, Vec<Diagnostic>> {
    let program = &settle::settled(program);
    let plan = plan::plan(program, started);
    let writes = writes::Writes::new(program);
    let forms = form::forms(program, &writes);
    let reach = reach::Reach::new(program, &plan, &writes);
    let bodies = body::bodies(program, &plan, &writes, &forms, &reach, options, started)?;
    let name = plan.namespace.clone();
    let title = sources.iter().next().map_or(program.name.clone(), |(_, file)| file.name.clone());
    let mut files = Vec::new();
    let mut add = |name: String, text: &text::Text| {
        let (text, mappings) = text.finish(&name, sources);
        files.push(File { name, text, mappings });
    };
    let source = class::source(&bodies, &name);
    add(format!("{name}.hpp"), &class::header(&bodies, file_name(&title)));
    add(format!("{name}.cpp"), &source);
    if !options.bare {
        add("replay.cpp".to_string(), &driver::driver(&bodies, &name));
    }
    add("CMakeLists.txt".to_string(), &project::project(&name, options));
    let sites = bodies.generator.sites.spans().to_vec();
    Ok(Generated { name, files, sites, renamed: renamed::renamed(&bodies.generator) })
}

/// The last part of a path.
fn file_name(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path)
}
