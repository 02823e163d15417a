//! Gathers this project's own models, so that a property can import them without reading a disk.
//!
//! Out: `models.rs`, a table of file name without ending and text, sorted by name.
#![allow(
    clippy::disallowed_methods,
    clippy::disallowed_macros,
    reason = "the models are files, and cargo is told by printing"
)]

use std::fmt::Write;
use std::path::{Path, PathBuf};

fn main() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut models = Vec::new();
    for folder in ["library", "examples"] {
        println!("cargo::rerun-if-changed=../../{folder}");
        gather(&root.join(folder), &mut models);
    }
    models.sort_by(|a, b| a.file_stem().cmp(&b.file_stem()).then(a.cmp(b)));
    let mut table = String::from("&[\n");
    for model in &models {
        let name = model.file_stem().unwrap_or_default().to_string_lossy();
        writeln!(table, "    ({name:?}, include_str!({:?})),", model.display().to_string())
            .expect("writing to a string");
    }
    table.push(']');
    let target = PathBuf::from(std::env::var_os("OUT_DIR").expect("cargo sets it")).join("models.rs");
    std::fs::write(target, table).expect("cargo made the folder");
}

fn gather(folder: &Path, models: &mut Vec<PathBuf>) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for path in entries.filter_map(|entry| Some(entry.ok()?.path())) {
        if path.is_dir() {
            gather(&path, models);
        } else if path.extension().is_some_and(|ending| ending == "asm") {
            models.push(path);
        }
    }
}
