//! What browsers do: files are written and nobody's words are lost, charts are drawn in, jobs run.

use std::time::Duration;

use serde_json::{Value, json};

use crate::browser::{Running, Tab};

const LAMP: &str = "chart Lamp\n\n// A lamp.\nmachine lamp \"Lamp\"\n\tcontrol light\n\tinitial state off \"Off\" // dark\n\tstate on \"On\"\n\
                    \tguard pressed \"Pressed\"\n\toff -> pressed yes -> on\n\ton -> pressed\n\tpressed no -> off\nendmachine\n";

fn write(tab: &mut Tab, path: &str, text: &str, base: &Value) -> Value {
    tab.ask("studio/write", json!({ "path": path, "text": text, "base": base })).expect("answered")
}

#[test]
fn two_tabs_do_not_lose_each_others_work() {
    let running = Running::over(&[("a.asm", "1\n2\n3\n4\n5\n")]);
    let (mut one, mut other) = (running.tab(), running.tab());
    let base = one.ask("studio/read", json!({ "path": "a.asm" })).expect("read")["hash"].clone();
    assert_eq!(other.ask("studio/read", json!({ "path": "a.asm" })).expect("read")["hash"], base);
    let first = write(&mut one, "a.asm", "one\n2\n3\n4\n5\n", &base);
    assert!(first["text"].is_null() && first["conflict"].is_null(), "{first}");
    let told = other.hear("studio/changed", |params| params["path"] == "a.asm");
    assert_eq!(told["text"], "one\n2\n3\n4\n5\n");
    // The other had not seen it yet when it wrote.
    let merged = write(&mut other, "a.asm", "1\n2\n3\n4\nother\n", &base);
    assert_eq!(merged["text"], "one\n2\n3\n4\nother\n");
    assert_eq!(running.text("a.asm"), "one\n2\n3\n4\nother\n");
    // Both change the same line.
    let conflict = write(&mut one, "a.asm", "ONE\n2\n3\n4\n5\n", &base);
    assert_eq!(conflict["conflict"]["theirs"], "one\n2\n3\n4\nother\n");
    assert_eq!(running.text("a.asm"), "one\n2\n3\n4\nother\n");
    let decided = write(&mut one, "a.asm", "ONE\n2\n3\n4\nother\n", &conflict["conflict"]["hash"].clone());
    assert!(decided["conflict"].is_null(), "{decided}");
    // Another program writes.
    std::fs::write(running.folder().join("a.asm"), "outside\n").expect("written");
    let told = one.hear("studio/changed", |params| params["text"] == "outside\n");
    assert_eq!(told["path"], "a.asm");
    std::fs::remove_file(running.folder().join("a.asm")).expect("removed");
    one.hear("studio/changed", |params| params["text"].is_null());
    one.hear("studio/files", |params| params["files"] == json!([]));
    // Its text is in the browser alone now: it is written again.
    write(&mut one, "a.asm", "kept\n", &decided["hash"].clone());
    assert_eq!(running.text("a.asm"), "kept\n");
}

#[test]
fn a_file_gets_another_name_and_is_deleted_before_all_eyes() {
    let user = "asm b\nimport a\nsignature:\ndefinitions:\n\tmain rule r_m = skip\n";
    let running = Running::over(&[("a.asm", "module a\nsignature:\ndefinitions:\n"), ("b.asm", user)]);
    let (mut one, mut other) = (running.tab(), running.tab());
    let base = other.ask("studio/read", json!({ "path": "a.asm" })).expect("read")["hash"].clone();
    let names = one.ask("studio/names", json!({ "path": "a.asm" })).expect("told");
    let paths: Vec<_> = names["places"].as_array().expect("places").iter().map(|place| &place["path"]).collect();
    assert_eq!(paths, ["a.asm", "b.asm"]);
    let rename = |path: &str, to: &str| json!({ "files": [{ "path": path, "to": to }] });
    let mut refused = |path: &str, to: &str| one.ask("studio/rename", rename(path, to)).expect_err("refused");
    assert_eq!(refused("a.asm", "b.asm"), "b.asm is there already");
    assert_eq!(refused("a.asm", "a.chart"), "a.asm and `a.chart` are not of one kind");
    assert!(refused("a.asm", "../c.asm").contains("no file of this folder"));
    assert!(refused("a.asm", "none/c.asm").contains("cannot be renamed"));
    let answer = one.ask("studio/rename", rename("a.asm", "c.asm")).expect("renamed");
    assert_eq!(answer["files"][0]["uri"], running.uri("c.asm"));
    let told = other.hear("studio/renamed", |_| true);
    assert_eq!(told, answer);
    other.hear("studio/files", |params| params["files"].to_string().contains("c.asm"));
    // What another tab types under the former name makes no file of it again.
    let late = other.ask("studio/write", json!({ "path": "a.asm", "text": "late", "base": base }));
    assert_eq!(late, Err("a.asm is called c.asm now".to_string()));
    assert!(write(&mut other, "c.asm", "module c\n", &base)["conflict"].is_null());
    let deleted = one.ask("studio/delete", json!({ "path": "c.asm" })).expect("deleted");
    assert_eq!(deleted["text"], "module c\n");
    other.hear("studio/changed", |params| params["path"] == "c.asm" && params["text"].is_null());
    assert!(!running.folder().join("c.asm").exists());
    assert!(one.ask("studio/delete", json!({ "path": "c.asm" })).is_err());
}

#[test]
fn a_file_is_whole_at_any_time() {
    let (small, large) = ("s".repeat(10), "l".repeat(300_000));
    let running = Running::over(&[("a.asm", &small)]);
    let path = running.folder().join("a.asm");
    let mut tab = running.tab();
    let mut base = tab.ask("studio/read", json!({ "path": "a.asm" })).expect("read")["hash"].clone();
    let (texts, reader) = ([small.clone(), large.clone()], path.clone());
    let done = std::sync::Arc::new(std::sync::atomic::AtomicBool::new(false));
    let ended = std::sync::Arc::clone(&done);
    let watch = std::thread::spawn(move || {
        while !ended.load(std::sync::atomic::Ordering::Relaxed) {
            let read = std::fs::read_to_string(&reader).expect("it is always there");
            assert!(texts.contains(&read), "{} bytes of a text that nobody wrote", read.len());
        }
    });
    for round in 0..40 {
        base = write(&mut tab, "a.asm", if round % 2 == 0 { &large } else { &small }, &base)["hash"].clone();
    }
    done.store(true, std::sync::atomic::Ordering::Relaxed);
    watch.join().expect("it saw no half text");
    let left: Vec<_> = std::fs::read_dir(running.folder()).expect("listed").collect();
    assert_eq!(left.len(), 1, "{left:?}");
}

#[test]
fn a_chart_is_drawn_in() {
    let running = Running::over(&[("Lamp.chart", LAMP)]);
    let mut tab = running.tab();
    tab.initialize(&running);
    let uri = running.uri("Lamp.chart");
    let document = json!({ "uri": uri });
    tab.tell(
        "textDocument/didOpen",
        json!({ "textDocument": { "uri": uri, "languageId": "chart", "version": 1, "text": LAMP } }),
    );
    let picture = tab.ask("groundstate/chart/picture", json!({ "textDocument": document })).expect("drawn");
    let drawing = &picture["drawings"][0];
    assert_eq!((drawing["name"].as_str(), drawing["kind"].as_str()), (Some("lamp"), Some("machine")));
    let boxes = drawing["picture"]["boxes"].as_array().expect("boxes");
    let off = boxes.iter().find(|shape| shape["id"] == "off").expect("it is drawn");
    assert_eq!((off["figure"].as_str(), off["initial"].as_bool()), (Some("circle"), Some(true)));
    assert_eq!(off["range"], json!({ "start": { "line": 5, "character": 1 }, "end": { "line": 5, "character": 24 } }));
    assert_eq!(drawing["lights"][0]["shapes"][1], json!({ "value": "ON", "shape": "on" }));
    let lines = drawing["picture"]["lines"].as_array().expect("lines");
    assert!(lines.iter().all(|line| line["range"].is_object()), "{lines:?}");
    // All places that are drawn, so that nothing else moves.
    let centre = |shape: &Value| {
        let number = |key: &str| shape[key].as_f64().expect("a number");
        json!([number("x") + number("width") / 2.0, number("y") + number("height") / 2.0])
    };
    let places: serde_json::Map<String, Value> =
        boxes.iter().map(|shape| (shape["id"].as_str().expect("a name").to_string(), centre(shape))).collect();
    let operation = json!({ "kind": "add", "shape": "action", "text": "COUNT", "at": [400, 300] });
    let edited = tab.ask(
        "groundstate/chart/edit",
        json!({
            "textDocument": document, "drawing": "lamp", "operation": operation, "places": places,
        }),
    );
    let edited = edited.expect("it can be done");
    assert_eq!(edited["select"], json!(["count"]));
    let change = json!({ "textDocument": { "uri": uri, "version": 2 }, "contentChanges": [
        { "range": edited["edits"][0]["range"], "text": edited["edits"][0]["newText"] }] });
    tab.tell("textDocument/didChange", change);
    let after = tab.ask("groundstate/chart/picture", json!({ "textDocument": document })).expect("drawn");
    let now = after["drawings"][0]["picture"]["boxes"].as_array().expect("boxes");
    for shape in boxes {
        let same = now.iter().find(|other| other["id"] == shape["id"]).expect("it is there still");
        assert_eq!(centre(same), centre(shape), "{} has moved", shape["id"]);
    }
    let count = now.iter().find(|shape| shape["id"] == "count").expect("it is drawn");
    assert_eq!(centre(count), json!([400.0, 300.0]));
    let refused = tab.ask("groundstate/chart/edit", json!({
        "textDocument": document, "drawing": "lamp", "operation": { "kind": "connect", "from": "on", "branch": null, "to": "exit" },
    }));
    assert_eq!(refused, Err("only a pattern is entered and left; this is a machine".to_string()));
    assert_eq!(after["guess"], false);
    let typed = json!({ "textDocument": { "uri": uri, "version": 3 }, "contentChanges": [
        { "range": { "start": { "line": 8, "character": 0 }, "end": { "line": 8, "character": 0 } }, "text": "\toff -> off ->\n" }] });
    tab.tell("textDocument/didChange", typed);
    let guessed = tab.ask("groundstate/chart/picture", json!({ "textDocument": document })).expect("drawn");
    assert_eq!((&guessed["guess"], guessed["drawings"].as_array().map(Vec::len)), (&json!(true), Some(1)));
    let mended = json!({ "textDocument": { "uri": uri, "version": 4 }, "contentChanges": [
        { "range": { "start": { "line": 8, "character": 0 }, "end": { "line": 9, "character": 0 } }, "text": "" }] });
    tab.tell("textDocument/didChange", mended);
    let laid_out = tab.ask(
        "groundstate/chart/edit",
        json!({
            "textDocument": document, "drawing": "lamp", "operation": { "kind": "layout" },
        }),
    );
    assert!(laid_out.expect("laid out")["edits"].as_array().is_some_and(|edits| edits.len() == 1));
}

#[test]
fn libraries_that_are_built_in_are_found() {
    let text = "asm a\nimport StandardLibrary\nimport patterns/ControlTask\nsignature:\ndefinitions:\n\tmain rule r_m = skip\n";
    let running = Running::over(&[("sub/a.asm", text)]);
    let mut tab = running.tab();
    tab.initialize(&running);
    let uri = running.uri("sub/a.asm");
    tab.tell(
        "textDocument/didOpen",
        json!({ "textDocument": { "uri": uri, "languageId": "asmetal", "version": 1, "text": text } }),
    );
    let faults = tab.hear("textDocument/publishDiagnostics", |params| params["uri"] == *uri);
    assert!(!faults.to_string().contains("import"), "{faults}");
}

#[test]
fn a_model_that_loops_hangs_nobody() {
    let forever = "asm Loop\nimport StandardLibrary\nsignature:\n\tcontrolled x: Integer\ndefinitions:\n\
                   \tmain rule r_m = while true do x := x + 1\n\tdefault init s0:\n\t\tfunction x = 0\n";
    let running = Running::over(&[("Loop.asm", forever)]);
    let (mut one, mut other) = (running.tab(), running.tab());
    one.initialize(&running);
    let state = one
        .ask("groundstate/session/open", json!({ "textDocument": { "uri": running.uri("Loop.asm") } }))
        .expect("it runs");
    let step = one.ask("groundstate/session/step", json!({ "session": state["session"] })).expect("it ends by a limit");
    assert!(step["faults"].to_string().contains("limit-reached"), "{step}");
    assert!(other.ask("studio/hello", json!({})).is_ok());
}

#[cfg(unix)]
#[test]
fn jobs_run_are_stopped_and_are_bounded() {
    use std::os::unix::fs::PermissionsExt;
    let place = tempfile::tempdir().expect("a folder");
    let program = place.path().join("program");
    let script = "#!/bin/sh\ncase $1 in\nreview) echo '{\"type\":\"x\"}'; echo words; echo why >&2; exit 3;;\n\
                  *) echo \"$*\"; trap '' INT; sleep 600 & wait;;\nesac\n";
    std::fs::write(&program, script).expect("written");
    std::fs::set_permissions(&program, std::fs::Permissions::from_mode(0o755)).expect("set");
    let running = Running::with(&[("a.asm", "asm a\n")], false, &program);
    let (mut one, mut other) = (running.tab(), running.tab());
    let job = |tab: &mut Tab, job: &str| {
        tab.ask("studio/job", json!({ "job": job, "path": "a.asm" }))
            .map(|told| told["job"].as_u64().expect("a number"))
    };
    let quick = job(&mut one, "review").expect("started");
    assert_eq!(one.hear("studio/line", |params| params["line"].is_object())["line"], json!({ "type": "x" }));
    one.hear("studio/line", |params| params["line"] == "why");
    assert_eq!(one.hear("studio/done", |params| params["job"] == quick)["code"], 3);
    // One that does not listen is ended all the same.
    let slow = job(&mut one, "verify").expect("started");
    one.hear("studio/line", |params| params["line"] == "verify ./a.asm --within . --format json");
    assert!(other.ask("studio/stop", json!({ "job": slow })).is_err(), "it is another tab's");
    one.ask("studio/stop", json!({ "job": slow })).expect("stopped");
    assert!(one.hear("studio/done", |params| params["job"] == slow)["code"].is_null());
    // A tab that goes takes its jobs with it.
    let all: Vec<u64> = (0..4).map(|_| job(&mut one, "verify").expect("started")).collect();
    assert_eq!(all.len(), 4);
    assert_eq!(job(&mut other, "review"), Err("4 jobs run already: stop one first".to_string()));
    drop(one);
    let mut left = 400;
    while job(&mut other, "review").is_err() {
        left -= 1;
        assert!(left > 0, "jobs of a tab that is gone still run");
        std::thread::sleep(Duration::from_millis(50));
    }
}

#[test]
fn a_studio_that_only_shows_writes_nothing() {
    let running = Running::with(&[("a.asm", "asm a\n")], true, std::path::Path::new("/bin/false"));
    let mut tab = running.tab();
    let base = tab.ask("studio/read", json!({ "path": "a.asm" })).expect("read")["hash"].clone();
    for (method, params) in [
        ("studio/write", json!({ "path": "a.asm", "text": "x", "base": base })),
        ("studio/new", json!({ "template": "machine", "name": "x" })),
        ("studio/rename", json!({ "files": [{ "path": "a.asm", "to": "b.asm" }] })),
        ("studio/delete", json!({ "path": "a.asm" })),
        ("studio/job", json!({ "job": "generate", "path": "a.asm" })),
    ] {
        assert_eq!(tab.ask(method, params), Err("this studio was started with --read-only".to_string()), "{method}");
    }
    assert_eq!(running.text("a.asm"), "asm a\n");
}

#[test]
fn a_job_tells_which_texts_it_looks_at_and_when_they_are_others() {
    let module = "module Kinds\nsignature:\ndefinitions:\n";
    let model = "asm Lamp\nimport Kinds\nsignature:\ndefinitions:\n\tmain rule r_m = skip\n";
    let files = [("Lamp.asm", model), ("Kinds.asm", module), ("Other.asm", "asm Other\n"), ("Lamp.chart", LAMP)];
    let running = Running::with(&files, false, std::path::Path::new("/bin/true"));
    let mut tab = running.tab();
    let began = tab.ask("studio/job", json!({ "job": "verify", "path": "Lamp.asm", "chart": "Lamp.chart" }));
    let texts = began.expect("started")["texts"].clone();
    let hash = |path: &str| texts.as_array().and_then(|all| all.iter().find(|text| text["path"] == path)).cloned();
    assert_eq!(texts.as_array().map(Vec::len), Some(4), "{texts}");
    assert_eq!(hash("Lamp.verify.yaml").map(|text| text["hash"].clone()), Some(Value::Null), "{texts}");
    for path in ["Lamp.chart", "Lamp.asm", "Kinds.asm"] {
        assert!(hash(path).is_some_and(|text| text["hash"].is_string()), "{path}: {texts}");
    }
    // Nobody has opened it, and still its change is told; so is that it is what it was again.
    std::fs::write(running.folder().join("Kinds.asm"), module.to_string() + "// more\n").expect("written");
    let told = tab.hear("studio/changed", |params| params["path"] == "Kinds.asm");
    assert_ne!(Some(&told["hash"]), hash("Kinds.asm").map(|text| text["hash"].clone()).as_ref());
    std::fs::write(running.folder().join("Kinds.asm"), module).expect("written");
    let told = tab.hear("studio/changed", |params| params["path"] == "Kinds.asm");
    assert_eq!(Some(told["hash"].clone()), hash("Kinds.asm").map(|text| text["hash"].clone()));
    std::fs::write(running.folder().join("Lamp.verify.yaml"), "").expect("written");
    tab.hear("studio/changed", |params| params["path"] == "Lamp.verify.yaml");
    // Whether the model is the chart's is what the program says.
    assert_eq!(
        tab.ask("studio/model", json!({ "path": "Lamp.chart" })),
        Ok(json!({ "model": "Lamp.asm", "state": "agrees" }))
    );
    assert!(tab.ask("studio/model", json!({ "path": "Lamp.asm" })).is_err());
    assert!(tab.ask("studio/model", json!({ "path": "../Lamp.chart" })).is_err());
}

#[test]
fn a_folder_has_its_port_again() {
    let first = Running::over(&[("a.asm", "asm a\n")]);
    let (port, token) = (first.port, first.token.clone());
    let second = first.again();
    assert_eq!(second.port, port);
    // It is another start all the same: who has the former token alone is not let in.
    let former = format!("groundstate-{port}={token}");
    assert!(second.get("/", &[("Cookie", &former)]).starts_with("HTTP/1.1 403"));
    assert!(second.tab_from(&format!("http://127.0.0.1:{port}"), &former).is_err());
    second.tab();
}
