//! Every letter of every scalar of the repository's YAML files stands where it is said to stand, or an escape of it does.

use inputs::node::{Node, Shape, read};
use syntax::FileId;
use testkit::repository;

#[test]
fn every_letter_stands_at_its_place() {
    let mut letters = 0;
    for folder in ["examples", "library", "shells/cli/tests"] {
        for path in repository::files(folder, &["yaml"]) {
            let source = repository::text(&path);
            // Some of them are there to be refused.
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
