//! The language server and what a disk and an editor can do to it: folders of equal names, links, large texts.

#![allow(clippy::disallowed_methods, reason = "tests write files")]

use serde_json::json;

use crate::lsp::{Editor, LAMP};

const PART: &str = "module Part\nimport StandardLibrary\nexport *\nsignature:\n\tcontrolled n: Integer\ndefinitions:\n";
const MAIN: &str =
    "asm Main\nimport StandardLibrary\nimport Part\nsignature:\ndefinitions:\n\tmain rule r_Main = n := 1\n";

#[test]
fn two_folders_of_the_same_name_are_two() {
    let other = PART.replace("n: Integer", "n: Boolean");
    let files = [
        ("one/models/Part.asm", PART),
        ("one/models/Main.asm", MAIN),
        ("two/models/Part.asm", &other),
        ("two/models/Main.asm", MAIN),
    ];
    let mut editor = Editor::plain("equal", &files);
    // The folders of the editor are these two now, both called `models`.
    let (one, two) = (editor.uri("one/models"), editor.uri("two/models"));
    let all = editor.uri("");
    let added = [json!({ "uri": one, "name": "models" }), json!({ "uri": two, "name": "models" })];
    let removed = [json!({ "uri": all.trim_end_matches('/'), "name": "test" })];
    editor.tell("workspace/didChangeWorkspaceFolders", json!({ "event": { "added": added, "removed": removed } }));
    editor.open("one/models/Main.asm", MAIN);
    assert_eq!(editor.faults("one/models/Main.asm", 1), [""; 0]);
    editor.open("two/models/Main.asm", MAIN);
    assert_eq!(editor.faults("two/models/Main.asm", 1).len(), 1);
    // A name leads to its own folder, and is renamed in that one alone.
    let at = editor.at("one/models/Main.asm", 5, 20);
    let found = editor.ask("textDocument/definition", at.clone());
    assert_eq!(found["result"][0]["uri"], editor.uri("one/models/Part.asm"), "{found}");
    let mut renaming = at;
    renaming["newName"] = json!("count");
    let renamed = editor.ask("textDocument/rename", renaming);
    let changes = renamed["result"]["changes"].as_object().unwrap_or_else(|| panic!("{renamed}"));
    let mut files: Vec<String> = changes.keys().cloned().collect();
    files.sort();
    assert_eq!(files, [editor.uri("one/models/Main.asm"), editor.uri("one/models/Part.asm")], "{renamed}");
    editor.end();
}

#[cfg(unix)]
#[test]
fn links_are_followed_to_files_and_never_in_a_circle() {
    use std::os::unix::fs::symlink;
    let mut editor = Editor::plain("links", &[("parts/Part.asm", PART), ("work/Main.asm", MAIN)]);
    let folder = editor.folder.clone();
    // A file behind a link is a file; a folder that holds itself, and a link to nothing, are left alone.
    symlink(folder.join("parts/Part.asm"), folder.join("work/Part.asm")).expect("a link");
    symlink(&folder, folder.join("work/again")).expect("a link");
    symlink(folder.join("nowhere.asm"), folder.join("work/Gone.asm")).expect("a link");
    symlink(folder.join("work/Round.asm"), folder.join("work/Round.asm")).expect("a link");
    editor.open("work/Main.asm", MAIN);
    assert_eq!(editor.faults("work/Main.asm", 1), [""; 0]);
    let round = MAIN.replace("import Part", "import Round");
    editor.change("work/Main.asm", 2, json!({ "text": round }));
    assert!(editor.faults("work/Main.asm", 2).contains(&"import-not-found".to_string()));
    let found = editor.ask("workspace/symbol", json!({ "query": "r_Main" }));
    let again = found["result"].as_array().expect("a list").iter().filter(|one| one.to_string().contains("again"));
    assert_eq!(again.count(), 0, "{found}");
    // The link comes to lead elsewhere under the open text.
    std::fs::remove_file(folder.join("work/Part.asm")).expect("it is gone");
    std::fs::write(folder.join("work/Other.asm"), PART.replace("n: Integer", "m: Integer")).expect("a file");
    symlink(folder.join("work/Other.asm"), folder.join("work/Part.asm")).expect("a link");
    editor.change("work/Main.asm", 3, json!({ "text": MAIN }));
    assert!(!editor.faults("work/Main.asm", 3).is_empty());
    editor.end();
}

#[test]
fn a_text_of_sixteen_megabytes_is_answered() {
    let mut editor = Editor::plain("sixteen", &[]);
    // Just below the mark: a comment of one line, so that positions in it are far out.
    let comment = "😀".repeat((15 << 20) / 4);
    let text = LAMP.replace("// Turns", &format!("// {comment} Turns"));
    editor.open("Lamp.asm", &text);
    assert_eq!(editor.faults("Lamp.asm", 1), [""; 0]);
    let units = 2 * (15 << 20) / 4 + 4;
    let far = json!({ "line": 7, "character": units });
    let edit = json!({ "range": { "start": far, "end": far }, "text": "\n\twrong\n//" });
    editor.change("Lamp.asm", 2, edit);
    assert!(!editor.faults("Lamp.asm", 2).is_empty());
    let hover = editor.ask("textDocument/hover", editor.at("Lamp.asm", 11, 38));
    assert_eq!(hover["result"]["range"]["start"]["line"], 11, "{hover}");
    editor.end();
}
