//! `groundstate generate cpp MODEL.asm`: the class of a model, what it needs of the runtime, and the source map.

use std::io::Write;
use std::path::{Component, Path};
use std::sync::Arc;

use generate::model::{Generated, Options};
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
    let program = Arc::clone(&loaded.program);
    let mut started = Machine::new(Arc::clone(&program), Limits::default());
    // An initial value that asks the environment, or is at fault, does so again when the program starts.
    let _ = started.start(&mut Closed);
    let options = Options { bare: arguments.bare, capacities: arguments.capacity.clone() };
    let folder = &arguments.output;
    std::fs::create_dir_all(folder).map_err(|error| Failure::of_file("write", folder, error))?;
    let placed = placed(&loaded.sources, folder);
    let generated = match generate::model::generate(&program, &placed, &mut started, &options) {
        Ok(generated) => generated,
        Err(refused) => {
            shell.diagnostics(&loaded.sources, &refused)?;
            return Ok(Exit::Model);
        }
    };
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
        if !generated.renamed.is_empty() {
            let names: Vec<String> = generated.renamed.iter().map(|(model, cpp)| format!("{model} is {cpp}")).collect();
            writeln!(shell.out(), "called otherwise in C++: {}", names.join(", "))?;
        }
    }
    Ok(Exit::Good)
}

/// The texts under their paths from the folder that is written to: the same wherever the command runs and the two folders lie.
fn placed(sources: &Sources, folder: &Path) -> Sources {
    let mut placed = Sources::default();
    let whole = |path: &Path| std::fs::canonicalize(path).or_else(|_| std::path::absolute(path)).unwrap_or(path.into());
    let folder = whole(folder);
    for (_, file) in sources.iter() {
        let name =
            if file.name.starts_with('<') { file.name.clone() } else { from(&folder, &whole(Path::new(&file.name))) };
        placed.add(SourceFile::new(name, Arc::clone(&file.text)));
    }
    placed
}

/// The way from a folder to a file, with `/` between its parts; the file's own path where there is none.
fn from(folder: &Path, file: &Path) -> String {
    let (here, there): (Vec<Component>, Vec<Component>) = (folder.components().collect(), file.components().collect());
    let shared = here.iter().zip(&there).take_while(|(a, b)| a == b).count();
    if shared == 0 {
        return file.display().to_string();
    }
    let up = here[shared..].iter().map(|_| "..".to_string());
    let down = there[shared..].iter().map(|part| part.as_os_str().to_string_lossy().into_owned());
    up.chain(down).collect::<Vec<_>>().join("/")
}

/// Which generated lines stand for which places of the model, which place each number in a fault is, and which names are
/// others in C++.
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
    let names: Vec<Value> =
        generated.renamed.iter().map(|(model, cpp)| json!({ "model": model, "generated": cpp })).collect();
    json!({ "lines": lines, "sites": sites, "names": names })
}
