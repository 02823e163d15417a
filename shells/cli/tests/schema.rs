//! The JSON output of commands and traces matches the schema in `crates/wire/schema`, line by line.

#![allow(clippy::disallowed_methods, reason = "the schema and the models are files")]

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;
use testkit::schema::departure;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().expect("the repository")
}

fn schema(name: &str) -> Value {
    let path = root().join("crates/wire/schema").join(name);
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    serde_json::from_str(&text).expect("it is JSON")
}

/// Checks all lines against the schema; returns their types.
fn check(schema: &Value, text: &str, of: &str) -> BTreeSet<String> {
    let mut types = BTreeSet::new();
    for line in text.lines() {
        let object: Value = serde_json::from_str(line).unwrap_or_else(|error| panic!("{of}: {line}: {error}"));
        if let Some(fault) = departure(schema, &object) {
            panic!("{of}: {line}\nis not what the schema says: {fault}");
        }
        types.insert(object["type"].as_str().unwrap_or_else(|| panic!("{of}: no type: {line}")).to_string());
    }
    types
}

/// The types that a schema knows.
fn known(schema: &Value, types: &mut BTreeSet<String>) {
    match schema {
        Value::Object(entries) => {
            if let Some(Value::String(of)) = entries.get("properties").and_then(|all| all.get("type")?.get("const")) {
                types.insert(of.clone());
            }
            entries.values().for_each(|value| known(value, types));
        }
        Value::Array(items) => items.iter().for_each(|item| known(item, types)),
        Value::Null | Value::Bool(_) | Value::Number(_) | Value::String(_) => {}
    }
}

#[test]
fn every_command_writes_what_the_schema_says() {
    let schema = schema("output.json");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let into = |name: &str| folder.path().join(name).display().to_string();
    let case_study = "examples/visual_servoing/CompleteController.asm";
    let recording = "shells/cli/tests/cmd/report.in/robot.mcap";
    let light = "shells/cli/tests/cmd/run.in/Light.asm";
    let many: String = "asm Many\nsignature:\ndefinitions:\n".to_string()
        + &"\trule r_a = a := b\n".repeat(150)
        + "main rule r_Main = skip\n";
    std::fs::write(folder.path().join("Many.asm"), many).expect("a model");
    let many = into("Many.asm");
    let (tests, trace) = (into("tests"), into("light.trace"));
    let commands: Vec<Vec<&str>> = vec![
        vec!["check", "shells/cli/tests/cmd/check.in"],
        vec!["check", &many],
        vec!["check", "missing.asm"],
        vec!["run", light, "--random", "-n", "30", "--trace", &trace],
        vec!["run", "shells/cli/tests/cmd/run.in/Clash.asm"],
        vec!["run", "shells/cli/tests/cmd/run.in/Divide.asm", "--random"],
        vec!["run", "examples/visual_servoing/CompleteController.asm", "-n", "40"],
        vec!["replay", &trace],
        vec!["replay", "shells/cli/tests/cmd/run.in/light.trace", "--model", "shells/cli/tests/cmd/run.in/Clash.asm"],
        vec!["test", "shells/cli/tests/cmd/test.in", "--coverage", "--runs"],
        vec!["verify", "shells/cli/tests/cmd/verify.in/Tank.asm", "--assume", "inflow < 2", "--workers", "1"],
        vec!["verify", "shells/cli/tests/cmd/verify.in/Tank.asm", "--partial-order", "on", "--depth", "1"],
        vec!["verify", "shells/cli/tests/cmd/verify.in/Clients.asm", "--symmetry", "on"],
        vec!["verify", "shells/cli/tests/cmd/verify.in/Free.asm", "--solver", "none"],
        vec!["verify", "shells/cli/tests/cmd/verify.in/Half.asm", "--engine", "bdd"],
        vec!["verify", "shells/cli/tests/cmd/verify.in/Idle.asm", "--vacuity"],
        vec!["verify", "shells/cli/tests/cmd/verify.in/Idle.asm", "--coverage"],
        vec![
            "refine",
            "library/refinement/ManageAtOnce.asm",
            "library/refinement/ManageEarly.asm",
            "--with",
            "library/refinement/Manage.refine",
        ],
        vec!["refine", "library/refinement/Manage.refine"],
        vec!["refine", "shells/cli/tests/cmd/refine.in/Filter.refine", "--method", "induction"],
        vec!["refine", "shells/cli/tests/cmd/refine.in/Unsaid.refine", "--method", "induction"],
        vec!["graph", "shells/cli/tests/cmd/graph.in/Counter.asm", "--where", "count > 1"],
        vec!["graph", "shells/cli/tests/cmd/graph.in/Counter.asm", "--max-states", "2"],
        vec!["review", "shells/cli/tests/cmd/review.in/Door.asm"],
        vec!["review", "shells/cli/tests/cmd/run.in/Clash.asm"],
        vec!["mutate", "shells/cli/tests/cmd/mutate.in/Barrier.asm", "--sample", "9", "--jobs", "1"],
        vec!["generate-tests", light, "-o", &tests],
        vec!["report", "shells/cli/tests/cmd/report.in/Blink.asm", "--steps", "8"],
        vec!["report", case_study, "--run", recording],
        vec!["conform", case_study, recording],
        vec!["conform", "examples/visual_servoing/VisionSystem.asm", recording],
        vec!["chart", "times", "shells/cli/tests/cmd/chart.in/Conveyor.chart", "--processors", "2"],
        vec!["explain"],
        vec!["explain", "no-bound"],
        vec!["fmt", "--check", light],
        vec!["bench", light, "--windows", "0", "--steps", "10"],
    ];
    let mut seen = BTreeSet::new();
    for arguments in commands {
        let output = Command::new(env!("CARGO_BIN_EXE_groundstate"))
            .args(&arguments)
            .args(["--format", "json"])
            .current_dir(root())
            .output()
            .expect("it starts");
        assert!(output.status.code().is_some_and(|code| code < 4), "{arguments:?}: {:?}", output.status);
        seen.extend(check(&schema, &String::from_utf8_lossy(&output.stdout), &arguments.join(" ")));
    }
    let mut types = BTreeSet::new();
    known(&schema, &mut types);
    let unseen: Vec<&String> = types.difference(&seen).collect();
    // Only a terminal can take steps back, and only while a program runs is it followed.
    assert_eq!(unseen, ["back", "followed"], "the commands above write none of these");
    let lines = std::fs::read_to_string(folder.path().join("light.trace")).expect("the trace");
    check(&self::schema("trace.json"), &lines, "the trace");
}

#[test]
fn the_schema_refuses_what_is_something_else() {
    let schema = schema("output.json");
    for wrong in [
        r#"{"type":"summary","passed":"1","failed":0,"not_run":0}"#,
        r#"{"type":"verdict","check":"defined"}"#,
        r#"{"type":"unheard-of"}"#,
        "[]",
    ] {
        let wrong: Value = serde_json::from_str(wrong).expect("it is JSON");
        assert!(departure(&schema, &wrong).is_some(), "{wrong}");
    }
}
