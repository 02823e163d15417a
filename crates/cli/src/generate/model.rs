//! `groundstate generate cpp MODEL.asm`: the class of a model, what it needs of the runtime, and the source map.

use std::io::Write;
use std::sync::Arc;

use generate::{Generated, Options};
use machine::{Closed, Limits, Machine};
use serde_json::{Value, json};
use syntax::{SourceFile, Sources, Span};

use super::{Cpp, write};
use crate::exit::Exit;
use crate::failure::Failure;
use crate::load::load;
use crate::shell::Shell;

include!(concat!(env!("OUT_DIR"), "/machine_headers.rs"));

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Cpp) -> Result<Exit, Failure> {
    let loaded = match load(shell, &arguments.file)? {
        Ok(loaded) => loaded,
        Err(exit) => return Ok(exit),
    };
    let program = Arc::new(loaded.program);
    let mut started = Machine::new(Arc::clone(&program), Limits::default());
    // An initial value that asks the environment, or is at fault, does so again when the program starts.
    let _ = started.start(&mut Closed);
    let options = Options { bare: arguments.bare, capacities: arguments.capacity.clone() };
    let placed = placed(&loaded.sources);
    let generated = match generate::generate(&program, &placed, &mut started, &options) {
        Ok(generated) => generated,
        Err(refused) => {
            shell.diagnostics(&loaded.sources, &refused)?;
            return Ok(Exit::Model);
        }
    };
    let folder = &arguments.output;
    for file in &generated.files {
        write(shell, &folder.join(&file.name), &file.text)?;
    }
    for (name, text) in MACHINE_HEADERS {
        write(shell, &folder.join("runtime/include/groundstate/machine").join(name), text)?;
    }
    let map = serde_json::to_string_pretty(&source_map(&generated, &placed)).unwrap_or_default();
    write(shell, &folder.join("source-map.json"), &map)?;
    if shell.talks() {
        writeln!(shell.out(), "{}", folder.join(format!("{}.hpp", generated.name)).display())?;
    }
    Ok(Exit::Good)
}

/// The texts under paths that a debugger finds wherever it is started.
fn placed(sources: &Sources) -> Sources {
    let mut placed = Sources::default();
    for (_, file) in sources.iter() {
        let path = std::path::absolute(&file.name).map(|path| path.display().to_string());
        let name = if file.name.starts_with('<') { file.name.clone() } else { path.unwrap_or(file.name.clone()) };
        placed.add(SourceFile::new(name, Arc::clone(&file.text)));
    }
    placed
}

/// Which generated lines stand for which places of the model, and which place each number in a fault is.
fn source_map(generated: &Generated, sources: &Sources) -> Value {
    let place = |span: Span| {
        let file = sources.file(span.file);
        let (start, end) = (file.line_column(span.start), file.line_column(span.end));
        json!({
            "file": file.name,
            "line": start.line, "column": start.column,
            "end_line": end.line, "end_column": end.column,
        })
    };
    let lines: Vec<Value> = generated
        .files
        .iter()
        .flat_map(|file| {
            let name = file.name.clone();
            file.mappings
                .iter()
                .map(move |mapping| json!({ "generated": { "file": name, "line": mapping.line }, "model": place(mapping.span) }))
        })
        .collect();
    let sites: Vec<Value> = generated
        .sites
        .iter()
        .enumerate()
        .map(|(index, span)| json!({ "site": index + 1, "model": place(*span) }))
        .collect();
    json!({ "lines": lines, "sites": sites })
}
