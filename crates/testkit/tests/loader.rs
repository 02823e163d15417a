//! Imports lead to one file under one name.
//!
//! A path is relative to the importing file, with or without `.asm`, with either slash; what is not there is an error.

use model::Loader;
use syntax::SourceFile;
use testkit::{Disk, EditedDisk, NoFiles, Patterns, Texts, repository};

fn name(loader: &mut dyn Loader, importer: &str, path: &str) -> Result<String, String> {
    loader.load(&SourceFile::new(importer, ""), path).map(|file| file.name)
}

#[test]
fn texts_are_found_beside_the_importing_file() {
    let mut texts = Texts::of([("a/b/C.asm", "module C"), ("D.asm", "module D"), ("a/E.chart", "chart E")]);
    for (importer, path, found) in [
        ("a/b/X.asm", "C", "a/b/C.asm"),
        ("a/X.asm", "b\\C.asm", "a/b/C.asm"),
        ("a/b/X.asm", "../../D", "D.asm"),
        ("X.asm", "./D", "D.asm"),
        ("a/X.chart", "E.chart", "a/E.chart"),
    ] {
        assert_eq!(name(&mut texts, importer, path).as_deref(), Ok(found), "{path} in {importer}");
    }
    assert!(name(&mut texts, "X.asm", "C").is_err());
    assert!(name(&mut NoFiles, "X.asm", "D").is_err());
}

#[test]
fn files_have_one_name_however_they_are_reached() {
    let found = repository::root().join("library/patterns/Task.asm").display().to_string();
    let importer = repository::root().join("library/std/X.asm").display().to_string();
    assert_eq!(name(&mut Disk, &importer, "../patterns/Task"), Ok(found.clone()));
    assert_eq!(name(&mut Disk, &found, "./Task.asm"), Ok(found));
    assert!(name(&mut Disk, &importer, "Task").is_err());
}

#[test]
fn an_edited_disk_replaces_a_text() {
    let path = repository::root().join("library/patterns/Task.asm");
    let edited = EditedDisk { from: "module Task".to_string(), to: "module Other".to_string() };
    let file = edited.read(&path).expect("the pattern is there");
    assert!(file.text.contains("module Other") && !file.text.contains("module Task"));
}

#[test]
fn patterns_are_found_from_anywhere() {
    assert_eq!(name(&mut Patterns, "X.asm", "patterns/Task").as_deref(), Ok("patterns/Task.asm"));
    assert_eq!(name(&mut Patterns, "patterns/Task.asm", "Scheduler").as_deref(), Ok("patterns/Scheduler.asm"));
    assert!(name(&mut Patterns, "X.asm", "patterns/Tusk").is_err());
}
