//! Parses every model and scenario under the folders given, and prints the faults and the counts.
//!
//! Use: `cargo run --release -p syntax --example parse_all -- [--list] [--format] FOLDER…`; `--list` names each file with
//! its number of errors instead of showing the faults; `--format` checks that formatting keeps each file's tokens and
//! comments, and that formatting twice is formatting once.

#![allow(clippy::disallowed_methods, clippy::disallowed_macros, reason = "a developer's tool, not part of the library")]

use std::path::{Path, PathBuf};
use syntax::{FileId, Parse, Severity, SourceFile, Sources};

fn main() {
    let mut arguments: Vec<String> = std::env::args().skip(1).collect();
    let list = arguments.iter().any(|argument| argument == "--list");
    let format = arguments.iter().any(|argument| argument == "--format");
    arguments.retain(|argument| !argument.starts_with("--"));
    let mut files = Vec::new();
    for folder in &arguments {
        collect(Path::new(folder), &mut files);
    }
    files.sort();
    let (mut clean, mut faulty, mut lossy, mut bytes) = (0, 0, 0, 0);
    let mut seconds = 0.0;
    for path in &files {
        let Ok(content) = std::fs::read(path) else { continue };
        let text = String::from_utf8_lossy(&content).into_owned();
        let mut sources = Sources::default();
        let file = sources.add(SourceFile::new(path.display().to_string(), text.as_str()));
        let start = std::time::Instant::now();
        let parse = parse(file, path, &text);
        seconds += start.elapsed().as_secs_f64();
        bytes += text.len();
        lossy += usize::from(parse.syntax().text() != text.as_str());
        let errors = parse.diagnostics.iter().filter(|fault| fault.severity == Severity::Error).count();
        if errors == 0 {
            clean += 1
        } else {
            faulty += 1
        }
        if format && errors == 0 {
            check_format(path, &text, &parse);
        }
        if list {
            println!("{}\t{errors}", path.display());
        } else {
            for fault in &parse.diagnostics {
                println!("{}: [{}] {}", sources.position(fault.primary.span), fault.id, fault.message);
            }
        }
    }
    let rate = bytes as f64 / 1e6 / seconds;
    eprintln!("{clean} without errors, {faulty} with errors, {lossy} not lossless; {bytes} bytes, {rate:.1} MB/s");
}

/// Says whether a file is formatted; that formatting keeps its meaning is asserted elsewhere, and here tried.
fn check_format(path: &Path, text: &str, parse: &Parse) {
    syntax::assert_invariants(text.as_bytes());
    if syntax::format(parse) == text {
        println!("{}: is formatted", path.display());
    }
}

fn parse(file: FileId, path: &Path, text: &str) -> Parse {
    if path.extension().is_some_and(|extension| extension == "avalla") {
        syntax::parse_avalla(file, text)
    } else {
        syntax::parse_asmetal(file, text)
    }
}

fn collect(path: &Path, files: &mut Vec<PathBuf>) {
    if path.is_dir() {
        for entry in std::fs::read_dir(path).into_iter().flatten().flatten() {
            collect(&entry.path(), files);
        }
    } else if path.extension().is_some_and(|extension| extension == "asm" || extension == "avalla") {
        files.push(path.to_path_buf());
    }
}
