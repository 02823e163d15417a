//! Files are found at any depth, in order, by their endings.
//!
//! A folder that is not there is a panic: a test that looks at nothing must not pass.

use testkit::repository::{files, root, text};

#[test]
fn files_of_the_library() {
    let found = files("library", &["asm", "chart"]);
    assert!(found.is_sorted());
    for path in ["library/patterns/Task.asm", "library/patterns/DataProducer.chart"] {
        assert!(found.contains(&root().join(path)), "{path}");
    }
    assert!(found.iter().all(|path| path.extension().is_some_and(|ending| ending != "avalla")));
    assert!(text("library/patterns/Task.asm").contains("module Task"));
}

#[test]
#[should_panic(expected = "no-such-folder")]
fn a_missing_folder_is_not_an_empty_one() {
    files("no-such-folder", &["asm"]);
}
