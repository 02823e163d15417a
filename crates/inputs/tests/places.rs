//! Every letter of every scalar of the repository's YAML files stands where it is said to stand, or an escape of it does.

use inputs::node::{Node, Shape, read};
use syntax::FileId;
use testkit::repository;

#[test]
fn every_letter_stands_at_its_place() {
    let mut letters = 0;
    for folder in ["examples", "library", "shells/cli/tests"] {
        for path in repository::files(folder, &["yaml"]) {
            // Some of them are there to be refused: one is no text, others say nothing that can be read.
            let Some(source) = repository::text_if_utf8(&path) else { continue };
            if let Ok(node) = read(FileId(0), &source, "id") {
                letters += walk(&source, &node);
            }
        }
    }
    assert!(letters > 1_000, "{letters} letters");
}

fn walk(source: &str, node: &Node) -> usize {
    match &node.shape {
        Shape::List(items) => items.iter().map(|item| walk(source, item)).sum(),
        Shape::Map(entries) => entries.iter().map(|(_, value)| walk(source, value)).sum(),
        Shape::Text(scalar) => {
            let mut letters = 0;
            for (at, letter) in scalar.char_indices().filter(|(_, letter)| !letter.is_whitespace()) {
                let place = scalar.place(at as u32..(at + letter.len_utf8()) as u32);
                let written = &source[place.range()];
                assert!(written == letter.to_string() || written.starts_with(['\\', '\'']), "{written}: {scalar:?}");
                letters += 1;
            }
            letters
        }
    }
}

/// What stands behind a second mark would be read by nobody.
#[test]
fn a_file_has_one_document() {
    for more in ["---\ninvariants:\n  - n < 2\n", "---\n", "...\n---\n- 1\n"] {
        let source = format!("---\ninvariants:\n  - n < 5\n{more}");
        let fault = read(FileId(0), &source, "id").expect_err(&source);
        assert_eq!(fault.message, "a second document begins here; a file has one");
    }
    assert!(read(FileId(0), "---\ninvariants: [n < 5]\n...\n", "id").is_ok());
}
