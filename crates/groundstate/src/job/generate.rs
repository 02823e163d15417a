//! Generates C++ from models and systems, as jobs that make folders in memory.
//!
//! In: a program with its texts under the names to show, or a chart with a system. Out: the files of a [`Folder`], with
//! those of the runtime; what cannot be generated, as diagnostics. The caller writes the files and creates the folder.

use std::io;
use std::sync::Arc;

use chart::Chart;
use generate::headers;
use generate::model::{Generated, Options};
use generate::system::{Form, MachineClass, ungenerated};
use machine::{Closed, Limits, Machine};
use program::Program;
use serde_json::{Value, json};
use syntax::{Diagnostic, Sources, Span};

use crate::fingerprint::text_fingerprint;
use crate::job::{Cancel, Job, Port};

/// The generated files: paths within the folder, and texts.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Folder {
    /// Overwritten each time; the most important file comes first.
    pub decided: Vec<(String, String)>,
    /// The user's own files: written once if missing, never touched again.
    pub once: Vec<(String, String)>,
    /// Names that differ in C++: `(the model's, C++'s)`.
    pub renamed: Vec<(String, String)>,
}

/// Why there is no folder.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum NotGenerated {
    /// This cannot be generated.
    Refused(Vec<Diagnostic>),
    /// The chart has no system.
    NoSystem,
    /// The job was cancelled.
    Cancelled,
}

/// A file has been generated, at this path.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct GenerateEvent(pub String);

/// A generation.
pub type GenerateJob = Job<GenerateEvent, Result<Folder, NotGenerated>>;

/// Starts to generate the class of a model. The source map shows the names in `sources`.
///
/// # Errors
/// The system cannot start a thread.
pub fn generate_model(
    program: Arc<Program>,
    sources: Sources,
    options: Options,
    cancel: Cancel,
) -> io::Result<GenerateJob> {
    let limits = machine_limits(&cancel);
    Job::start("generate", cancel, move |port| {
        let mut started = Machine::new(Arc::clone(&program), limits);
        // If an initial value asks the environment or fails, it does so again when the program starts.
        let _ = started.start(&mut Closed);
        go_on(&port)?;
        let generated =
            generate::model::generate(&program, &sources, &mut started, &options).map_err(NotGenerated::Refused)?;
        let map = serde_json::to_string_pretty(&source_map(&generated, &sources)).unwrap_or_default();
        let runtime =
            |(name, text): &(&str, &str)| (format!("runtime/include/groundstate/machine/{name}"), (*text).to_string());
        let files = generated.files.into_iter().map(|file| (file.name, file.text));
        let maps = [("source-map.json".to_string(), map)];
        let decided = files.chain(headers::MACHINE.iter().map(runtime)).chain(maps).collect();
        told(&port, Folder { decided, once: Vec::new(), renamed: generated.renamed })
    })
}

/// What [`generate_model`] made of a component's machine, for the program of its system: the class for [`Form::classes`], and the files
/// within the program's folder. `file` is the machine's file as the chart's system names it.
pub fn machine_of_component(
    file: String,
    machine: String,
    program: &Program,
    folder: Folder,
) -> (MachineClass, Vec<(String, String)>) {
    let numbered = program.domains.iter().zip(0..).map(|(domain, number)| (domain.name.clone(), number));
    let domains = numbered.filter(|(name, _)| !name.is_empty()).collect();
    let header = folder.decided.iter().find(|(path, _)| path.ends_with(".hpp") && !path.contains('/'));
    let (path, header) = header.cloned().unwrap_or_default();
    let name = path.trim_end_matches(".hpp").to_string();
    let runtime = "runtime/include/";
    let files = folder.decided.into_iter().filter_map(|(path, text)| match path.as_str() {
        "CMakeLists.txt" | "replay.cpp" => None,
        "source-map.json" => Some((format!("generated/machines/{name}-map.json"), text)),
        other => match other.strip_prefix(runtime) {
            Some(header) => Some((format!("generated/include/{header}"), text)),
            None => Some((format!("generated/machines/{other}"), text)),
        },
    });
    let files = files.collect();
    (MachineClass { file, machine, name, header, renamed: folder.renamed, domains }, files)
}

/// Starts to generate the program of a chart's system; comments call the chart `file`. The source map shows the names in `sources`.
///
/// # Errors
/// The system cannot start a thread.
pub fn generate_system(
    chart: Chart,
    sources: Sources,
    file: String,
    form: Form,
    cancel: Cancel,
) -> io::Result<GenerateJob> {
    Job::start("generate", cancel, move |port| {
        let system = chart.system.as_ref().ok_or(NotGenerated::NoSystem)?;
        let faults = ungenerated(system);
        if !faults.is_empty() {
            return Err(NotGenerated::Refused(faults));
        }
        go_on(&port)?;
        let generate::system::Generated { mut decided, once, lines } = generate::system::generate(system, &file, &form);
        let header = decided.first().map(|(path, _)| path.trim_start_matches("generated/").to_string());
        let header = header.unwrap_or_default();
        let lines: Vec<Value> =
            lines.iter().map(|(line, span)| mapped(&header, *line, place(&sources, *span))).collect();
        let map = json!({ "lines": lines, "sites": [], "names": [], "texts": texts(&sources) });
        decided.push(("generated/source-map.json".to_string(), serde_json::to_string_pretty(&map).unwrap_or_default()));
        let runtime =
            |(name, text): &(&str, &str)| (format!("generated/include/groundstate/{name}"), (*text).to_string());
        decided.extend(headers::RUNTIME.iter().map(runtime));
        told(&port, Folder { decided, once, renamed: Vec::new() })
    })
}

fn machine_limits(cancel: &Cancel) -> Limits {
    Limits { interrupt: cancel.interrupt().clone(), ..Limits::default() }
}

fn go_on(port: &Port<GenerateEvent>) -> Result<(), NotGenerated> {
    if port.is_cancelled() { Err(NotGenerated::Cancelled) } else { Ok(()) }
}

fn told(port: &Port<GenerateEvent>, folder: Folder) -> Result<Folder, NotGenerated> {
    for (path, _) in folder.decided.iter().chain(&folder.once) {
        go_on(port)?;
        port.add(GenerateEvent(path.clone()), false);
    }
    Ok(folder)
}

/// Maps generated lines to places of the model, the numbers in faults to places, and C++ names to the model's.
fn source_map(generated: &Generated, sources: &Sources) -> Value {
    let of = |file: &generate::model::File| {
        let lines = file.mappings.iter();
        lines.map(|mapping| mapped(&file.name, mapping.line, place(sources, mapping.span))).collect::<Vec<Value>>()
    };
    let lines: Vec<Value> = generated.files.iter().flat_map(of).collect();
    let sites = generated.sites.iter().enumerate();
    let sites: Vec<Value> =
        sites.map(|(index, span)| json!({ "site": index + 1, "model": place(sources, *span) })).collect();
    let names = generated.renamed.iter().map(|(model, cpp)| json!({ "model": model, "generated": cpp }));
    json!({ "lines": lines, "sites": sites, "names": names.collect::<Vec<_>>(), "texts": texts(sources) })
}

fn mapped(file: &str, line: u32, model: Value) -> Value {
    json!({ "generated": { "file": file, "line": line }, "model": model })
}

fn place(sources: &Sources, span: Span) -> Value {
    let file = sources.file(span.file);
    let (start, end) = (file.line_column(span.start), file.line_column(span.end));
    json!({
        "file": file.name,
        "line": start.line, "column": start.column,
        "end_line": end.line, "end_column": end.column,
    })
}

/// The texts that the code was made from, each with its fingerprint; the built-in libraries are those of the program.
fn texts(sources: &Sources) -> Vec<Value> {
    let own = sources.iter().filter(|(_, file)| !file.name.starts_with('<'));
    own.map(|(_, file)| json!({ "file": file.name, "fingerprint": text_fingerprint(&file.text) })).collect()
}
