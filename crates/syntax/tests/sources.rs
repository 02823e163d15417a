//! Every model, scenario and chart of this repository parses without a fault, is kept by its tree and by the formatter.

use syntax::{FileId, assert_invariants, parse_asmetal, parse_avalla, parse_chart};
use testkit::repository;

#[test]
fn sources_of_the_repository() {
    let files = ["library", "examples"].map(|folder| repository::files(folder, &["asm", "avalla", "chart"]));
    let files = files.concat();
    assert!(!files.is_empty());
    for path in files {
        let text = repository::text(&path);
        let parse = match path.extension().and_then(|extension| extension.to_str()) {
            Some("avalla") => parse_avalla(FileId(0), &text),
            Some("chart") => parse_chart(FileId(0), &text),
            _ => parse_asmetal(FileId(0), &text),
        };
        assert_eq!(parse.diagnostics, [], "{}", path.display());
        assert_invariants(text.as_bytes());
    }
}
