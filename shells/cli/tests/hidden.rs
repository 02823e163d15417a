//! A system whose modules hide what they keep: no command takes a hidden function for another one of its name, and none writes a text that
//! cannot be read again.

#![allow(clippy::disallowed_methods, reason = "a test runs the command on files")]

use std::fs;
use std::path::Path;
use std::process::Command;

/// It keeps a count of its own, and a colour that nobody else knows.
const MODULE: &str = "module Tray
import StandardLibrary
export r_paint
signature:
	enum domain Colour = {RED | BLUE}
	controlled colour: Colour
	controlled count: Integer
definitions:
	rule r_paint = par colour := RED count := 2 endpar
";

const MODEL: &str = "asm Line
import StandardLibrary
import Tray
signature:
	controlled count: Boolean
	controlled turn: Integer
definitions:
	main rule r_Main = if turn < 2 then par r_paint[] count := not count turn := turn + 1 endpar endif
default init s0:
	function count = false
	function turn = 0
";

fn said(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_groundstate")).args(arguments).current_dir(folder).output();
    let output = output.expect("it starts");
    let text = format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    (output.status.code(), text)
}

#[test]
fn what_is_hidden_is_not_mistaken() {
    let place = tempfile::tempdir().expect("a folder");
    let folder = place.path();
    fs::write(folder.join("Tray.asm"), MODULE).expect("written");
    fs::write(folder.join("Line.asm"), MODEL).expect("written");
    let (code, text) = said(folder, &["run", "Line.asm", "--steps", "3", "--trace", "line.trace"]);
    assert_eq!(code, Some(0), "{text}");
    assert!(text.contains("  Tray.count: undef -> 2\n") && text.contains("  count: false -> true\n"), "{text}");
    let (code, text) = said(folder, &["replay", "line.trace"]);
    assert_eq!(code, Some(0), "{text}");
    let (code, text) = said(folder, &["report", "Line.asm", "-o", "line.html"]);
    assert_eq!(code, Some(0), "{text}");
    // The deadlock fails where it is, by what can be said of it.
    let (code, text) = said(folder, &["verify", "Line.asm", "--counterexample", "found/"]);
    assert_eq!(code, Some(1), "{text}");
    let scenario = fs::read_to_string(folder.join("found/no-deadlock.avalla")).expect("written");
    for unsaid in ["// colour stays RED, which no scenario can say", "// Tray.count stays 2, which no scenario can say"]
    {
        assert!(scenario.contains(unsaid), "{scenario}");
    }
    let (code, text) = said(folder, &["test", "found"]);
    assert!(code == Some(1) && text.contains("check failed after 3 steps"), "{text}");
    let (code, text) = said(folder, &["generate-tests", "Line.asm", "-o", "tests"]);
    assert_eq!(code, Some(0), "{text}");
    let (code, text) = said(folder, &["test", "tests"]);
    assert!(code == Some(0) && text.contains("1 passed"), "{text}");
    // What a module hides is a part of what a machine does.
    let (code, text) = said(folder, &["refine", "Line.asm", "Line.asm"]);
    assert!(code == Some(0) && text.contains("abstract.colour = concrete.colour"), "{text}");
    fs::create_dir(folder.join("other")).expect("made");
    fs::write(folder.join("other/Tray.asm"), MODULE.replace("count := 2", "count := 3")).expect("written");
    fs::write(folder.join("other/Line.asm"), MODEL).expect("written");
    let (code, text) = said(folder, &["refine", "Line.asm", "other/Line.asm"]);
    assert!(code == Some(1) && text.contains("abstract.count = 2, concrete.count = 3"), "{text}");
}
