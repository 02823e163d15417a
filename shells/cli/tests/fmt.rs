//! `fmt` on standard input, and what it preserves of a file: line ends, permissions.
#![allow(clippy::disallowed_methods, reason = "the test makes the files it gives to the command")]

use std::fs;
use std::io::Write;
use std::process::{Command, Stdio};

const NEAT: &str = "asm a\n\nsignature:\n\ndefinitions:\n\tmain rule r_Main = skip // never\n";
const MESSY: &str = "asm a signature: definitions:\n  main rule r_Main=skip // never";

fn piped(options: &[&str], text: &str) -> (Option<i32>, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_groundstate"));
    let command = command.arg("fmt").args(options).arg("-").stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = command.stderr(Stdio::null()).spawn().expect("it starts");
    child.stdin.take().expect("a pipe").write_all(text.as_bytes()).expect("it reads");
    let output = child.wait_with_output().expect("it ends");
    (output.status.code(), String::from_utf8_lossy(&output.stdout).into_owned())
}

#[test]
fn standard_input_goes_to_standard_output() {
    assert_eq!(piped(&[], MESSY), (Some(0), NEAT.to_string()));
    assert_eq!(piped(&[], NEAT), (Some(0), NEAT.to_string()));
    assert_eq!(piped(&["--check"], MESSY), (Some(1), "<stdin>\n".to_string()));
    assert_eq!(piped(&["--check"], NEAT), (Some(0), String::new()));
    assert_eq!(piped(&[], "asm a signature: definitions: main rule"), (Some(1), String::new()));
    assert_eq!(piped(&[], "scenario s load a.asm step"), (Some(0), "scenario s\nload a.asm\nstep\n".to_string()));
}

#[test]
fn line_ends_and_permissions_stay() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("a.asm");
    fs::write(&path, MESSY.replace('\n', "\r\n")).expect("it can be written");
    let mut permissions = fs::metadata(&path).expect("it is there").permissions();
    #[cfg(unix)]
    std::os::unix::fs::PermissionsExt::set_mode(&mut permissions, 0o600);
    fs::set_permissions(&path, permissions).expect("it is ours");
    let permissions = fs::metadata(&path).expect("it is there").permissions();
    let mut command = Command::new(env!("CARGO_BIN_EXE_groundstate"));
    assert!(command.arg("fmt").arg(&path).output().expect("it starts").status.success());
    assert_eq!(fs::read_to_string(&path).expect("a text"), NEAT.replace('\n', "\r\n"));
    assert_eq!(fs::metadata(&path).expect("it is there").permissions(), permissions);
}
