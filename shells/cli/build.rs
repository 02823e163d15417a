//! Embeds the pages of spec/faults/, so that the installed command needs no other files.

#![allow(clippy::disallowed_methods, clippy::disallowed_macros, reason = "a build script works on files")]

use std::fmt::Write;
use std::path::Path;
use std::{env, fs};

/// Writes a constant with the pages' names, without their ending, and texts.
fn main() {
    let root = env::var("CARGO_MANIFEST_DIR").expect("cargo sets it");
    let folder = Path::new(&root).join("../../spec/faults");
    println!("cargo::rerun-if-changed={}", folder.display());
    let mut pages: Vec<(String, String)> = fs::read_dir(&folder)
        .into_iter()
        .flatten()
        .filter_map(|entry| {
            let path = entry.ok()?.path();
            let id = path.file_name()?.to_str()?.strip_suffix(".md")?.to_string();
            Some((id, fs::canonicalize(&path).ok()?.to_str()?.to_string()))
        })
        .filter(|(id, _)| id != "README")
        .collect();
    pages.sort();
    let mut code = "const PAGES: &[(&str, &str)] = &[\n".to_string();
    for (id, path) in &pages {
        let _ = writeln!(code, "    ({id:?}, include_str!({path:?})),");
    }
    code.push_str("];\n");
    let out = env::var("OUT_DIR").expect("cargo sets it");
    fs::write(Path::new(&out).join("fault_pages.rs"), code).expect("the build folder can be written");
}
