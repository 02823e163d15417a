//! Embeds the pages of spec/faults/ and the headers of the C++ runtime, so that the installed command needs no other
//! files.

#![allow(clippy::disallowed_methods, clippy::disallowed_macros, reason = "a build script works on files")]

use std::fmt::Write;
use std::path::Path;
use std::{env, fs};

fn main() {
    embed("../../spec/faults", ".md", "PAGES", "fault_pages.rs");
    embed("../../cpp/include/groundstate", ".hpp", "HEADERS", "runtime_headers.rs");
    embed("../../cpp/include/groundstate/machine", ".hpp", "MACHINE_HEADERS", "machine_headers.rs");
}

/// Writes a constant with the names and texts of a folder's files that have this ending; page names are stored without
/// it.
fn embed(folder: &str, ending: &str, constant: &str, to: &str) {
    let root = env::var("CARGO_MANIFEST_DIR").expect("cargo sets it");
    let folder = Path::new(&root).join(folder);
    println!("cargo::rerun-if-changed={}", folder.display());
    let mut files: Vec<(String, String)> = fs::read_dir(&folder)
        .into_iter()
        .flatten()
        .filter_map(|entry| {
            let path = entry.ok()?.path();
            let name = path.file_name()?.to_str()?;
            let id = name.strip_suffix(ending)?;
            let name = if ending == ".md" { id } else { name }.to_string();
            Some((name, fs::canonicalize(&path).ok()?.to_str()?.to_string()))
        })
        .filter(|(id, _)| id != "README")
        .collect();
    files.sort();
    let mut code = format!("const {constant}: &[(&str, &str)] = &[\n");
    for (id, path) in &files {
        let _ = writeln!(code, "    ({id:?}, include_str!({path:?})),");
    }
    code.push_str("];\n");
    let out = env::var("OUT_DIR").expect("cargo sets it");
    fs::write(Path::new(&out).join(to), code).expect("the build folder can be written");
}
