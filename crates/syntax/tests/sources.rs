//! Every model, scenario and chart of this repository parses without a fault, is kept by its tree and by the formatter.

#![allow(clippy::disallowed_methods, reason = "a test reads the repository's own files")]

use std::path::{Path, PathBuf};
use syntax::{FileId, assert_invariants, parse_asmetal, parse_avalla, parse_chart};

fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    for path in entries.map(|entry| entry.path()) {
        if path.is_dir() {
            collect(&path, files);
        } else if path
            .extension()
            .is_some_and(|extension| ["asm", "avalla", "chart"].iter().any(|known| extension == *known))
        {
            files.push(path);
        }
    }
}

#[test]
fn sources_of_the_repository() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut files = Vec::new();
    for folder in ["library", "examples"] {
        collect(&root.join(folder), &mut files);
    }
    assert!(!files.is_empty());
    for path in files {
        let text = std::fs::read_to_string(&path).expect("a source is UTF-8");
        let parse = match path.extension().and_then(|extension| extension.to_str()) {
            Some("avalla") => parse_avalla(FileId(0), &text),
            Some("chart") => parse_chart(FileId(0), &text),
            _ => parse_asmetal(FileId(0), &text),
        };
        assert_eq!(parse.diagnostics, [], "{}", path.display());
        assert_invariants(text.as_bytes());
    }
}
