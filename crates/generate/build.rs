//! Gathers the headers of the C++ runtime, so that a generated project is complete wherever the program runs.
//!
//! Out: `headers.rs`, two tables of file name and text, sorted by name.
#![allow(
    clippy::disallowed_methods,
    clippy::disallowed_macros,
    reason = "the headers are files, and cargo is told by printing"
)]

use std::fmt::Write;
use std::path::{Path, PathBuf};

fn main() {
    let runtime = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cpp/include/groundstate");
    let machine = runtime.join("machine");
    let mut code = table("RUNTIME", "Of the runtime that the tasks of a system run on.", &runtime);
    code += &table("MACHINE", "Of the values and functions that the class of a model uses.", &machine);
    let target = PathBuf::from(std::env::var_os("OUT_DIR").expect("cargo sets it")).join("headers.rs");
    std::fs::write(target, code).expect("cargo made the folder");
}

/// A constant with the names and texts of a folder's headers.
fn table(constant: &str, says: &str, folder: &Path) -> String {
    println!("cargo::rerun-if-changed={}", folder.display());
    let entries = std::fs::read_dir(folder).expect("the runtime is beside the crates");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let mut headers: Vec<PathBuf> =
        paths.filter(|path| path.extension().is_some_and(|ending| ending == "hpp")).collect();
    headers.sort();
    let mut code = format!("/// {says}\npub const {constant}: Headers = &[\n");
    for header in headers {
        let header = header.canonicalize().expect("it is there");
        let name = header.file_name().unwrap_or_default().to_string_lossy();
        writeln!(code, "    ({name:?}, include_str!({:?})),", header.display().to_string())
            .expect("writing to a string");
    }
    code + "];\n"
}
