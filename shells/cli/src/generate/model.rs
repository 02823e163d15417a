//! `groundstate generate cpp MODEL.asm`: writes the class of a model, the runtime headers it needs, and the source map.

use std::io::Write;
use std::path::{Component, Path};
use std::sync::Arc;

use generate::model::Options;
use groundstate::job::{self, Cancel, Folder};
use syntax::{SourceFile, Sources};

use super::{Cpp, finished, write};
use crate::exit::Exit;
use crate::failure::Failure;
use crate::interrupt;
use crate::load::load;
use crate::shell::Shell;

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Cpp) -> Result<Exit, Failure> {
    let loaded = match load(shell, &arguments.file)? {
        Ok(loaded) => loaded,
        Err(exit) => return Ok(exit),
    };
    let options = Options { bare: arguments.bare, capacities: arguments.capacity.clone() };
    let folder = &arguments.output;
    std::fs::create_dir_all(folder).map_err(|error| Failure::of_file("write", folder, error))?;
    let placed = placed(&loaded.sources, folder);
    let cancel = Cancel::from(interrupt::request().clone());
    let job = job::generate_model(loaded.program, placed, options, cancel);
    let Folder { decided, renamed, .. } = match finished(shell, &loaded.sources, job)? {
        Ok(folder) => folder,
        Err(exit) => return Ok(exit),
    };
    for (path, text) in &decided {
        write(shell, &folder.join(path), text)?;
    }
    if shell.talks() {
        writeln!(shell.out(), "{}", folder.join(&decided[0].0).display())?;
        if !renamed.is_empty() {
            let names: Vec<String> = renamed.iter().map(|(model, cpp)| format!("{model} is {cpp}")).collect();
            writeln!(shell.out(), "renamed in C++: {}", names.join(", "))?;
        }
    }
    Ok(Exit::Good)
}

/// The texts, named by their paths relative to the output folder, so that the names do not depend on the working
/// folder.
pub fn placed(sources: &Sources, folder: &Path) -> Sources {
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

/// The relative path from a folder to a file, with `/` between its parts; the file's own path if there is none.
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
