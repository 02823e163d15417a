//! What `conform --follow` tells programs: how far it is while a recording grows, and the verdict in the words that people get.

#![allow(clippy::disallowed_methods, reason = "recordings are files, and the command is a process")]

use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;
use testkit::schema::departure;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().expect("the repository")
}

fn conform(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_groundstate"));
    command.arg("conform").args(arguments).current_dir(root()).stdin(Stdio::null());
    command
}

fn said(arguments: &[&str]) -> String {
    let output = conform(arguments).output().expect("it starts");
    String::from_utf8(output.stdout).expect("text").trim_end().to_string()
}

const MODEL: &str = "cpp/systems/Contention.asm";

#[test]
fn the_verdict_of_programs_is_that_of_people() {
    for log in ["cpp/systems/logs/contention-drawn.mcap", "cpp/systems/logs/contention-modelled.mcap"] {
        for more in [&[][..], &["--untimed"], &["--follow"]] {
            let arguments = [&[MODEL, log], more].concat();
            let told: Value = serde_json::from_str(
                said(&[&arguments[..], &["--format", "json"]].concat()).lines().last().expect("a line"),
            )
            .expect("it is JSON");
            assert_eq!(told["words"].as_str(), Some(&*said(&arguments)), "{arguments:?}");
            assert!(said(&arguments).starts_with("conforms "), "{arguments:?}");
        }
    }
}

/// Where the last record of metadata begins: it says when the tasks were asked to stop. Before it lie all events.
fn before_the_end(recording: &[u8]) -> usize {
    let (mut at, mut found) = (8, 0);
    while at + 9 < recording.len() {
        let length = recording[at + 1..at + 9].try_into().map(u64::from_le_bytes).expect("eight bytes");
        match recording[at] {
            0x0c => found = at,
            0x0f => break,
            _ => {}
        }
        at += 9 + length as usize;
    }
    found
}

#[test]
fn while_a_recording_grows_its_phases_are_told_and_no_verdict() {
    let whole = std::fs::read(root().join("cpp/systems/logs/contention-drawn.mcap")).expect("it is there");
    let folder = tempfile::tempdir().expect("a folder");
    let log = folder.path().join("growing.mcap");
    let mut file = std::fs::File::create(&log).expect("made");
    let mut child = conform(&["--follow", MODEL, &log.to_string_lossy(), "--format", "json"])
        .stdout(Stdio::piped())
        .spawn()
        .expect("it starts");
    let mut lines = BufReader::new(child.stdout.take().expect("its output")).lines();
    let mut next = || -> Option<Value> {
        let line = lines.next()?.expect("text");
        Some(serde_json::from_str(&line).unwrap_or_else(|error| panic!("{line}: {error}")))
    };
    let cut = before_the_end(&whole);
    file.write_all(&whole[..cut]).expect("written");
    file.flush().expect("written");
    let schema = std::fs::read_to_string(root().join("crates/wire/schema/output.json")).expect("the schema");
    let schema: Value = serde_json::from_str(&schema).expect("it is JSON");
    for _ in 0..3 {
        let told = next().expect("it goes on");
        assert_eq!(departure(&schema, &told), None, "{told}");
        assert_eq!(told["type"], "followed", "{told}");
        let tasks: Vec<&str> =
            told["phases"].as_array().expect("a list").iter().filter_map(|task| task[0].as_str()).collect();
        assert_eq!(tasks.len(), 4, "{told}");
    }
    file.write_all(&whole[cut..]).expect("written");
    file.flush().expect("written");
    let mut last = Value::Null;
    while let Some(told) = next() {
        assert_ne!(last["type"], "conformance", "something after the verdict: {told}");
        last = told;
    }
    assert_eq!((&last["type"], &last["verdict"]), (&Value::from("conformance"), &Value::from("conforms")), "{last}");
    assert!(child.wait().expect("it ends").success());
}
