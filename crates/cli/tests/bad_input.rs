//! Bad inputs that are made rather than kept: every one gets a message, the right exit code, no panic.
#![allow(clippy::disallowed_methods, reason = "the test makes the files it gives to the command")]

use std::fs;
use std::io::{Read, Write};
use std::path::Path;
use std::process::{Command, Output, Stdio};

fn groundstate(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_groundstate"));
    command.args(arguments).current_dir(folder).stdin(Stdio::null()).output().expect("it starts")
}

/// The exit code, and what must be said.
fn check(folder: &Path, arguments: &[&str], code: i32, says: &str) {
    let output = groundstate(folder, arguments);
    let text = format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    let shown: String = text.chars().take(2_000).collect();
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {shown}");
    assert!(text.contains(says), "{arguments:?}: `{says}` is not in: {shown}");
    assert!(!text.contains("panicked"), "{arguments:?}: {shown}");
    assert!(text.len() < 200_000, "{arguments:?}: {} bytes of output", text.len());
}

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

fn write(folder: &Path, name: &str, text: impl AsRef<[u8]>) {
    fs::write(folder.join(name), text).expect("the file can be written");
}

/// A model whose main rule is this.
fn model(name: &str, rule: &str) -> String {
    format!(
        "asm {name}\nimport StandardLibrary\nsignature:\n\tcontrolled x: Integer\ndefinitions:\n\tmain rule r_Main = {rule}\n\
         default init s0:\n\tfunction x = 0\n"
    )
}

#[test]
fn invalid_utf8() {
    let folder = folder();
    write(folder.path(), "Bytes.asm", b"asm Bytes\n\xff\xfe\0");
    check(folder.path(), &["check", "Bytes.asm"], 2, "not UTF-8 text: byte 10");
    write(folder.path(), "Bytes.asm", b"asm Bytes\n\xff\xfe");
    check(folder.path(), &["check", "Bytes.asm"], 1, "byte 0xFF at offset 10");
}

#[test]
fn a_file_that_is_too_large() {
    let folder = folder();
    let path = folder.path().join("Large.asm");
    fs::File::create(&path).and_then(|file| file.set_len(100 << 20)).expect("a sparse file");
    check(folder.path(), &["check", "Large.asm"], 2, "larger than 16777216 bytes");
    check(folder.path(), &["check", "Large.asm"], 2, "--max-file-size");
}

#[test]
fn an_import_that_is_too_large() {
    let folder = folder();
    write(folder.path(), "Main.asm", "asm Main\nimport Large\nsignature:\ndefinitions:\n\tmain rule r_Main = skip\n");
    let path = folder.path().join("Large.asm");
    fs::File::create(&path).and_then(|file| file.set_len(100 << 20)).expect("a sparse file");
    check(folder.path(), &["check", "Main.asm"], 1, "larger than 16777216 bytes");
}

#[test]
fn ten_thousand_parentheses() {
    let folder = folder();
    let (open, close) = ("(".repeat(10_000), ")".repeat(10_000));
    write(folder.path(), "Deep.asm", model("Deep", &format!("x := {open}1{close}")));
    check(folder.path(), &["check", "Deep.asm"], 1, "Deep.asm:6");
    check(folder.path(), &["run", "Deep.asm"], 1, "Deep.asm:6");
}

#[test]
fn a_line_of_many_operators() {
    let folder = folder();
    write(folder.path(), "Wide.asm", model("Wide", &format!("x := 1{}", " + 1".repeat(200_000))));
    let output = groundstate(folder.path(), &["check", "Wide.asm"]);
    assert!(matches!(output.status.code(), Some(0 | 1)), "{output:?}");
}

#[test]
fn a_thousand_faults() {
    let folder = folder();
    let updates = "y := 1 ".repeat(1_000);
    write(folder.path(), "Many.asm", model("Many", &format!("par {updates} endpar")));
    check(folder.path(), &["check", "Many.asm"], 1, "more");
}

#[test]
fn endless_recursion() {
    let folder = folder();
    let text = "asm Recurse\nimport StandardLibrary\nsignature:\n\tcontrolled x: Integer\ndefinitions:\n\t\
                turbo rule r_down($n in Integer) = r_down($n + 1)\n\tmain rule r_Main = r_down(x)\n\
                default init s0:\n\tfunction x = 0\n";
    write(folder.path(), "Recurse.asm", text);
    check(folder.path(), &["run", "Recurse.asm"], 1, "--max-depth");
    check(folder.path(), &["run", "Recurse.asm", "--max-depth", "50000"], 1, "limit of 50000");
    check(folder.path(), &["run", "Recurse.asm", "--max-depth", "1000000000"], 2, "200000");
}

#[test]
fn endless_while() {
    let folder = folder();
    write(folder.path(), "Spin.asm", model("Spin", "whilerec true do x := x"));
    check(folder.path(), &["run", "Spin.asm", "--max-iterations", "10000"], 1, "--max-iterations");
}

#[test]
fn a_huge_collection() {
    let folder = folder();
    write(folder.path(), "Huge.asm", model("Huge", "forall $n in {1 : 1000000000} do x := 1"));
    check(folder.path(), &["run", "Huge.asm", "--max-collection", "100000"], 1, "--max-collection");
}

#[test]
fn nothing_is_left_half_written() {
    let folder = folder();
    write(folder.path(), "Count.asm", model("Count", "x := x + 1"));
    check(folder.path(), &["run", "Count.asm", "--trace", "no/such/folder/x.trace"], 2, "no/such/folder");
    check(folder.path(), &["run", "Count.asm", "--trace", "."], 2, "is a folder");
    let left: Vec<_> =
        fs::read_dir(folder.path()).expect("the folder").map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(left, ["Count.asm"]);
}

#[test]
fn traces_that_are_none() {
    let folder = folder();
    write(folder.path(), "Count.asm", model("Count", "x := x + 1"));
    check(folder.path(), &["run", "Count.asm", "-n", "3", "--trace", "t", "--quiet"], 0, "");
    let trace = fs::read_to_string(folder.path().join("t")).expect("a trace");
    let lines: Vec<&str> = trace.lines().collect();
    write(folder.path(), "cut", lines[..3].join("\n"));
    check(folder.path(), &["replay", "cut"], 2, "it has no end");
    write(folder.path(), "half", &trace[..trace.len() - 10]);
    check(folder.path(), &["replay", "half"], 2, "line 6");
    write(folder.path(), "empty", "");
    check(folder.path(), &["replay", "empty"], 2, "it is empty");
    write(folder.path(), "newer", trace.replace("\"version\":1", "\"version\":99"));
    check(folder.path(), &["replay", "newer"], 2, "version 99");
    write(folder.path(), "other", trace.replace("\"to\":\"2\"", "\"to\":\"7\""));
    check(folder.path(), &["replay", "other"], 1, "parts from the trace at step 2");
    write(folder.path(), "Count.asm", model("Count", "x := x + 2"));
    check(folder.path(), &["replay", "t"], 1, "the model has changed");
}

#[test]
fn a_closed_pipe_is_quiet() {
    let folder = folder();
    write(folder.path(), "Count.asm", model("Count", "x := x + 1"));
    let mut child = Command::new(env!("CARGO_BIN_EXE_groundstate"))
        .args(["run", "Count.asm", "-n", "200000"])
        .current_dir(folder.path())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("it starts");
    let mut first = [0; 64];
    child.stdout.take().expect("a pipe").read_exact(&mut first).expect("some output");
    let output = child.wait_with_output().expect("it ends");
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
    assert_eq!(output.status.code(), Some(0));
}

#[test]
fn standard_input_that_is_no_terminal_is_not_asked() {
    let folder = folder();
    let text = "asm Ask\nimport StandardLibrary\nsignature:\n\tmonitored go: Boolean\n\tcontrolled x: Integer\n\
                definitions:\n\tmain rule r_Main = if go then x := 1 endif\n";
    write(folder.path(), "Ask.asm", text);
    let mut child = Command::new(env!("CARGO_BIN_EXE_groundstate"))
        .args(["run", "Ask.asm"])
        .current_dir(folder.path())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("it starts");
    child.stdin.take().expect("a pipe").write_all(b"true\n").ok();
    let output = child.wait_with_output().expect("it ends");
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("--random"));
}

#[test]
fn files_of_another_kind() {
    let folder = folder();
    write(folder.path(), "Model.asm", model("Model", "skip"));
    write(folder.path(), "Scenario.avalla", "scenario Scenario\nload Model.asm\nstep\n");
    check(folder.path(), &["run", "Scenario.avalla"], 2, "Scenario.avalla is a scenario");
    check(folder.path(), &["bench", "Scenario.avalla"], 2, "`groundstate test` runs scenarios");
    check(folder.path(), &["test", "Model.asm"], 2, "Model.asm is a model");
    check(folder.path(), &["replay", "Model.asm"], 2, "--trace FILE` writes one");
    check(folder.path(), &["run", "Model"], 2, "is Model.asm meant?");
    check(folder.path(), &["run", "Model.asm", "--steps", "-3"], 2, "write a whole number");
}
