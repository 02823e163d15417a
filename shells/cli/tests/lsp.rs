//! The language server as an editor meets it: a process, messages over its stdin and stdout.

#![allow(clippy::disallowed_methods, reason = "tests write files")]

use std::io::{BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use serde_json::{Value, json};

pub const LAMP: &str = "asm Lamp
import StandardLibrary
signature:
	enum domain Light = {ON | OFF}
	controlled light: Light
	monitored pressed: Boolean
definitions:
	// Turns the lamp to the other state.
	rule r_Toggle = if light = ON then light := OFF else light := ON endif
	main rule r_Main = if pressed then r_Toggle[] endif
default init s0:
	function light = OFF
";

/// An editor with its server.
pub struct Editor {
    server: Child,
    input: ChildStdin,
    output: BufReader<ChildStdout>,
    pub folder: PathBuf,
    /// Messages that came while another was waited for.
    pub kept: Vec<Value>,
    next: i64,
}

impl Editor {
    /// Starts a server for a folder of its own with these files.
    pub fn start(name: &str, files: &[(&str, &str)], client: Value, options: Value) -> Editor {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("lsp-{name}"));
        _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).expect("a folder");
        for (file, text) in files {
            let path = folder.join(file);
            std::fs::create_dir_all(path.parent().expect("a parent")).expect("a folder");
            std::fs::write(path, text).expect("a file");
        }
        let mut server = Command::new(env!("CARGO_BIN_EXE_groundstate"))
            .arg("lsp")
            .env("XDG_CACHE_HOME", folder.join(".cache"))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("the server starts");
        let input = server.stdin.take().expect("stdin");
        let output = BufReader::new(server.stdout.take().expect("stdout"));
        let mut editor = Editor { server, input, output, folder, kept: Vec::new(), next: 0 };
        let root = editor.uri("");
        let answer = editor.ask(
            "initialize",
            json!({
                "processId": null, "capabilities": client, "initializationOptions": options,
                "workspaceFolders": [{ "uri": root.trim_end_matches('/'), "name": "test" }],
            }),
        );
        assert_eq!(answer["result"]["serverInfo"]["name"], "groundstate");
        editor.tell("initialized", json!({}));
        editor
    }

    pub fn plain(name: &str, files: &[(&str, &str)]) -> Editor {
        Editor::start(name, files, json!({}), json!({}))
    }

    pub fn uri(&self, file: &str) -> String {
        format!("file://{}/{file}", self.folder.display())
    }

    fn send(&mut self, message: &Value) {
        let text = message.to_string();
        write!(self.input, "Content-Length: {}\r\n\r\n{text}", text.len()).expect("the server reads");
        self.input.flush().expect("the server reads");
    }

    pub fn tell(&mut self, method: &str, params: Value) {
        self.send(&json!({ "jsonrpc": "2.0", "method": method, "params": params }));
    }

    /// Sends a request and does not wait for its answer.
    pub fn request(&mut self, method: &str, params: Value) -> i64 {
        self.next += 1;
        let id = self.next;
        self.send(&json!({ "jsonrpc": "2.0", "id": id, "method": method, "params": params }));
        id
    }

    fn receive(&mut self) -> Value {
        let mut length = 0;
        loop {
            let mut line = String::new();
            assert!(self.output.read_line(&mut line).expect("the server writes") > 0, "the server ended");
            match line.trim().strip_prefix("Content-Length: ") {
                Some(number) => length = number.parse().expect("a length"),
                None if line.trim().is_empty() => break,
                None => {}
            }
        }
        let mut text = vec![0; length];
        self.output.read_exact(&mut text).expect("a message");
        serde_json::from_slice(&text).expect("JSON")
    }

    fn wait(&mut self, wanted: impl Fn(&Value) -> bool) -> Value {
        if let Some(at) = self.kept.iter().position(&wanted) {
            return self.kept.remove(at);
        }
        loop {
            let message = self.receive();
            if wanted(&message) {
                return message;
            }
            self.kept.push(message);
        }
    }

    pub fn answer(&mut self, id: i64) -> Value {
        self.wait(|message| message["id"] == id && message.get("method").is_none())
    }

    pub fn ask(&mut self, method: &str, params: Value) -> Value {
        let id = self.request(method, params);
        self.answer(id)
    }

    /// The messages of the faults of a version of a file, once they are told.
    pub fn faults(&mut self, file: &str, version: i64) -> Vec<String> {
        let uri = self.uri(file);
        let told = self.wait(|message| {
            message["method"] == "textDocument/publishDiagnostics"
                && message["params"]["uri"] == uri.as_str()
                && message["params"]["version"] == version
        });
        let faults = told["params"]["diagnostics"].as_array().expect("a list").clone();
        faults.iter().map(|fault| fault["code"].as_str().unwrap_or_default().to_string()).collect()
    }

    pub fn open(&mut self, file: &str, text: &str) {
        let uri = self.uri(file);
        let document = json!({ "uri": uri, "languageId": "asmetal", "version": 1, "text": text });
        self.tell("textDocument/didOpen", json!({ "textDocument": document }));
    }

    pub fn change(&mut self, file: &str, version: i64, change: Value) {
        let uri = self.uri(file);
        let document = json!({ "uri": uri, "version": version });
        self.tell("textDocument/didChange", json!({ "textDocument": document, "contentChanges": [change] }));
    }

    pub fn at(&self, file: &str, line: u32, character: u32) -> Value {
        json!({ "textDocument": { "uri": self.uri(file) }, "position": { "line": line, "character": character } })
    }

    /// Ends the session as it should end.
    pub fn end(mut self) {
        let answer = self.ask("shutdown", Value::Null);
        assert_eq!(answer["result"], Value::Null);
        let late = self.ask("textDocument/hover", json!({}));
        assert_eq!(late["error"]["code"], -32600, "{late}");
        self.tell("exit", Value::Null);
        assert!(self.server.wait().expect("it ends").success());
    }
}

fn range(line: u32, start: u32, end: u32) -> Value {
    json!({ "start": { "line": line, "character": start }, "end": { "line": line, "character": end } })
}

#[test]
fn a_session_from_open_to_exit() {
    let mut editor = Editor::plain(
        "session",
        &[("Lamp.asm", LAMP), ("Press.avalla", "scenario press\nload Lamp.asm\nset pressed := true;\nstep\n")],
    );
    editor.open("Lamp.asm", LAMP);
    assert_eq!(editor.faults("Lamp.asm", 1), [""; 0]);

    // `light` is made `lihgt`, and the fault is told for that version.
    editor.change("Lamp.asm", 2, json!({ "range": range(8, 36, 41), "text": "lihgt" }));
    assert_eq!(editor.faults("Lamp.asm", 2), ["unknown-function"]);
    let uri = editor.uri("Lamp.asm");
    let fixes = editor.ask(
        "textDocument/codeAction",
        json!({ "textDocument": { "uri": uri }, "range": range(8, 36, 36), "context": { "diagnostics": [] } }),
    );
    let fix = &fixes["result"][0];
    assert_eq!(fix["title"], "Change to `light`");
    assert_eq!(fix["edit"]["changes"][uri.as_str()][0]["newText"], "light");
    editor.change("Lamp.asm", 3, json!({ "range": range(8, 36, 41), "text": "light" }));
    assert_eq!(editor.faults("Lamp.asm", 3), [""; 0]);

    let position = editor.at("Lamp.asm", 9, 38);
    let hover = editor.ask("textDocument/hover", position.clone());
    let text = hover["result"]["contents"]["value"].as_str().expect("a text");
    assert!(text.contains("rule r_Toggle") && text.contains("Turns the lamp"), "{text}");
    let definition = editor.ask("textDocument/definition", position);
    assert_eq!(definition["result"][0]["range"]["start"], json!({ "line": 8, "character": 6 }));

    editor.change("Lamp.asm", 4, json!({ "range": range(8, 45, 48), "text": "" }));
    let completion = editor.at("Lamp.asm", 8, 45);
    let items = editor.ask("textDocument/completion", completion);
    let labels: Vec<&str> =
        items["result"].as_array().expect("a list").iter().take(2).filter_map(|item| item["label"].as_str()).collect();
    assert_eq!(labels, ["OFF", "ON"]);
    editor.change("Lamp.asm", 5, json!({ "range": range(8, 45, 45), "text": "OFF" }));

    let mut renaming = editor.at("Lamp.asm", 5, 12);
    renaming["newName"] = json!("touched");
    let renamed = editor.ask("textDocument/rename", renaming.clone());
    let changes = renamed["result"]["changes"].as_object().expect("edits by file");
    assert_eq!(changes.len(), 2, "{changes:?}");
    assert_eq!(changes[&editor.uri("Press.avalla")][0]["range"], range(2, 4, 11));
    renaming["newName"] = json!("light");
    let refused = editor.ask("textDocument/rename", renaming);
    assert_eq!(refused["error"]["code"], -32803);

    let formatted = editor.ask("textDocument/formatting", json!({ "textDocument": { "uri": editor.uri("Lamp.asm") }, "options": { "tabSize": 4, "insertSpaces": false } }));
    assert!(formatted["result"][0]["newText"].is_string(), "{formatted}");
    for method in ["documentSymbol", "foldingRange", "semanticTokens/full", "codeLens", "documentLink"] {
        let params = json!({ "textDocument": { "uri": editor.uri("Lamp.asm") } });
        let answer = editor.ask(&format!("textDocument/{method}"), params);
        assert!(answer.get("error").is_none() && !answer["result"].is_null(), "{method}: {answer}");
    }
    editor.end();
}

#[test]
fn what_is_not_known_or_wrong_is_an_error_of_that_request() {
    let mut editor = Editor::start("unknown", &[("Lamp.asm", LAMP)], json!({}), json!({ "mayPanic": true }));
    let answer = editor.ask("textDocument/dance", json!({}));
    assert_eq!(answer["error"]["code"], -32601);
    let answer = editor.ask("textDocument/hover", json!({ "position": 3 }));
    assert_eq!(answer["error"]["code"], -32602);
    editor.tell("$/unheardOf", json!({}));
    // A panic is an error of the request alone, and what is open is known as before.
    editor.open("Lamp.asm", &LAMP.replace("light := ON", "light := NO"));
    let answer = editor.ask("groundstate/panic", json!({}));
    assert_eq!(answer["error"]["code"], -32603, "{answer}");
    let position = editor.at("Lamp.asm", 9, 38);
    let hover = editor.ask("textDocument/hover", position);
    assert!(hover["result"]["contents"]["value"].as_str().expect("a text").contains("r_Toggle"));
    assert_eq!(editor.faults("Lamp.asm", 1), ["unknown-enum-literal"]);
    editor.end();
}

#[test]
fn a_cancelled_request_is_answered_so_and_an_outdated_one_too() {
    let mut editor = Editor::plain("cancelled", &[("Lamp.asm", LAMP)]);
    let long: String =
        (0..2_000).map(|n| format!("\trule r_{n} = light := if pressed then ON else OFF endif\n")).collect();
    let long = LAMP.replace("definitions:\n", &format!("definitions:\n{long}"));
    editor.open("Lamp.asm", &long);
    // The first question takes long enough for what comes after it to be read.
    let uri = editor.uri("Lamp.asm");
    let tokens = json!({ "textDocument": { "uri": uri } });
    let slow = editor.request("textDocument/semanticTokens/full", tokens.clone());
    let position = editor.at("Lamp.asm", 5, 12);
    let cancelled = editor.request("textDocument/hover", position.clone());
    editor.tell("$/cancelRequest", json!({ "id": cancelled }));
    let outdated = editor.request("textDocument/hover", position.clone());
    editor.change("Lamp.asm", 2, json!({ "range": range(0, 0, 0), "text": "// a line\n" }));
    let present = editor.request("textDocument/hover", editor.at("Lamp.asm", 6, 12));
    assert_eq!(editor.answer(cancelled)["error"]["code"], -32800);
    assert_eq!(editor.answer(outdated)["error"]["code"], -32801);
    assert_eq!(editor.answer(slow)["error"]["code"], -32801);
    let hover = editor.answer(present);
    assert_eq!(hover["result"]["range"], range(6, 11, 18), "{hover}");
    // An older version than the one that is there is not taken.
    editor.change("Lamp.asm", 1, json!({ "text": "" }));
    let hover = editor.ask("textDocument/hover", editor.at("Lamp.asm", 6, 12));
    assert_eq!(hover["result"]["range"], range(6, 11, 18), "{hover}");
    editor.end();
}

#[test]
fn letters_beyond_the_plane_and_line_ends_of_windows() {
    let text = LAMP
        .replace("// Turns", "/* 😀 */ // Turns")
        .replace("	rule r_Toggle", "	/* 😀 */ rule r_Toggle")
        .replace('\n', "\r\n");
    let mut editor = Editor::plain("letters", &[]);
    editor.open("Lamp.asm", &text);
    assert_eq!(editor.faults("Lamp.asm", 1), [""; 0]);
    // In UTF-16 the letter is two units: tab, `/* 😀 */ ` is nine, `rule ` five.
    let hover = editor.ask("textDocument/hover", editor.at("Lamp.asm", 8, 16));
    assert_eq!(hover["result"]["range"], range(8, 15, 23), "{hover}");
    editor.change("Lamp.asm", 2, json!({ "range": range(8, 15, 23), "text": "r_😀" }));
    assert!(!editor.faults("Lamp.asm", 2).is_empty());
    editor.change("Lamp.asm", 3, json!({ "range": range(8, 15, 19), "text": "r_Toggle" }));
    assert_eq!(editor.faults("Lamp.asm", 3), [""; 0]);
    editor.end();

    let client = json!({ "general": { "positionEncodings": ["utf-8", "utf-16"] } });
    let mut editor = Editor::start("bytes", &[], client, json!({}));
    editor.open("Lamp.asm", &text);
    let hover = editor.ask("textDocument/hover", editor.at("Lamp.asm", 8, 18));
    assert_eq!(hover["result"]["range"], range(8, 17, 25), "{hover}");
    editor.end();
}

#[test]
fn the_disk_changes_under_an_open_text() {
    let part = "module Part\nimport StandardLibrary\nexport *\nsignature:\n\tcontrolled n: Integer\ndefinitions:\n";
    let main = "asm Main\nimport StandardLibrary\nimport Part\nsignature:\ndefinitions:\n\tmain rule r_Main = n := 1\n";
    // Two folders have files of the same names.
    let other = part.replace("n: Integer", "m: Integer");
    let mut editor = Editor::plain(
        "disk",
        &[("a/Part.asm", part), ("a/Main.asm", main), ("b/Part.asm", &other), ("b/Main.asm", main)],
    );
    editor.open("a/Main.asm", main);
    assert_eq!(editor.faults("a/Main.asm", 1), [""; 0]);
    editor.open("b/Main.asm", main);
    assert_eq!(editor.faults("b/Main.asm", 1), ["unknown-function"]);
    // Bytes that are no text, then none at all, then what it was.
    let path = editor.folder.join("a/Part.asm");
    for (version, bytes) in [(2, Some(&b"module\0\xff\xfe"[..])), (3, None), (4, Some(part.as_bytes()))] {
        match bytes {
            Some(bytes) => std::fs::write(&path, bytes).expect("it is written"),
            None => std::fs::remove_file(&path).expect("it is gone"),
        }
        editor.change("a/Main.asm", version, json!({ "text": main }));
        let told = editor.faults("a/Main.asm", version);
        assert_eq!(told.contains(&"import-not-found".to_string()), version < 4, "{version}: {told:?}");
    }
    editor.end();
}

#[test]
fn an_editor_that_goes_away_ends_the_server() {
    let Editor { mut server, input, .. } = Editor::plain("away", &[]);
    drop(input);
    assert_eq!(server.wait().expect("it ends").code(), Some(2));
}

#[test]
fn selections_are_laid_out_and_rules_get_names() {
    let mut editor = Editor::plain("layout", &[]);
    editor.open("Lamp.asm", &LAMP.replace("if light", "if   light"));
    let document = json!({ "uri": editor.uri("Lamp.asm") });
    let options = json!({ "tabSize": 4, "insertSpaces": false });
    let whole = json!({ "start": { "line": 8, "character": 0 }, "end": { "line": 9, "character": 0 } });
    let edits = editor
        .ask("textDocument/rangeFormatting", json!({ "textDocument": document, "range": whole, "options": options }));
    assert!(edits["result"].as_array().is_some_and(|edits| edits.len() == 2), "{edits}");
    let typed = editor.ask(
        "textDocument/onTypeFormatting",
        json!({ "textDocument": document, "position": { "line": 9, "character": 4 }, "ch": "\n", "options": options }),
    );
    assert!(typed["result"].is_array(), "{typed}");
    let rule = range(9, 20, 52);
    let actions = |only: &str| json!({ "textDocument": document, "range": rule, "context": { "diagnostics": [], "only": [only] } });
    let found = editor.ask("textDocument/codeAction", actions("refactor"));
    let kinds: Vec<&str> =
        found["result"].as_array().expect("actions").iter().filter_map(|one| one["kind"].as_str()).collect();
    assert_eq!(kinds, ["refactor.extract", "refactor.rewrite"], "{found}");
    let none = editor.ask("textDocument/codeAction", actions("refactor.inline"));
    assert_eq!(none["result"], json!([]));
    editor.end();
}

#[test]
fn files_that_are_not_open_have_faults_until_they_are_gone() {
    let wrong = LAMP.replace("asm Lamp", "asm Other").replace("light := ON", "lihgt := ON");
    let clean = LAMP.replace("asm Lamp", "asm Clean");
    let mut editor = Editor::plain(
        "folder",
        &[("Clean.asm", &clean), ("Other.asm", &wrong), ("build/Not.asm", "asm"), ("notes.txt", "asm")],
    );
    let other = editor.uri("Other.asm");
    let told = |message: &Value| {
        let about = message["method"] == "textDocument/publishDiagnostics" && message["params"]["uri"] == *other;
        about.then(|| message["params"]["diagnostics"].as_array().map_or(0, Vec::len))
    };
    editor.wait(|message| told(message).is_some_and(|count| count > 0));
    // A text that is open counts, and then the disk again.
    editor.open("Other.asm", &LAMP.replace("asm Lamp", "asm Other"));
    editor.wait(|message| told(message) == Some(0));
    let document = json!({ "textDocument": { "uri": other } });
    editor.tell("textDocument/didClose", document);
    editor.wait(|message| told(message).is_some_and(|count| count > 0));
    // Of files without faults nothing is told.
    let is_other = |message: &Value| message["params"]["uri"] == *other;
    assert!(editor.kept.iter().all(is_other), "{:?}", editor.kept);
    editor.kept.clear();
    std::fs::remove_file(editor.folder.join("Other.asm")).expect("it is gone");
    editor.tell("workspace/didChangeWatchedFiles", json!({ "changes": [{ "uri": other, "type": 3 }] }));
    editor.wait(|message| told(message) == Some(0));
    editor.end();
}

#[test]
fn a_text_that_is_too_large_is_told_so() {
    let mut editor = Editor::plain("large", &[]);
    let large = format!("{LAMP}/*{}*/", "x".repeat(17 << 20));
    editor.open("Lamp.asm", &large);
    let told = editor.wait(|message| message["params"]["version"] == 1);
    let told = told["params"]["diagnostics"][0]["message"].as_str().unwrap_or_default();
    assert!(told.contains("not checked as it is typed"), "{told}");
    let hover = editor.ask("textDocument/hover", editor.at("Lamp.asm", 8, 18));
    assert_eq!(hover["result"], Value::Null, "{hover}");
    editor.change("Lamp.asm", 2, json!({ "text": LAMP }));
    assert_eq!(editor.faults("Lamp.asm", 2), [""; 0]);
    editor.end();
}

#[test]
fn a_model_runs_at_the_cursor() {
    let model = "asm Lamp
import StandardLibrary
signature:
	enum domain Light = {ON | OFF}
	controlled light: Light
	controlled count: Integer
	monitored pressed: Boolean
definitions:
	rule r_Count = count := count + 1
	rule r_Clash = par count := 7 count := 8 endpar
	main rule r_Main =
		if pressed then
			par
				choose $l in Light do light := $l
				r_Count[]
			endpar
		else
			r_Clash[]
		endif
default init s0:
	function light = OFF
	function count = 0
";
    let mut editor = Editor::plain("run", &[]);
    editor.open("Lamp.asm", model);
    let document = json!({ "textDocument": { "uri": editor.uri("Lamp.asm") } });
    let opened = editor.ask("groundstate/session/open", document.clone())["result"].clone();
    assert_eq!(
        (&opened["version"], &opened["step"], &opened["waiting"]),
        (&json!(1), &json!(0), &json!("step")),
        "{opened}"
    );
    assert_eq!(opened["state"], json!({ "light": "OFF", "count": "0" }));
    let id = opened["session"].clone();
    let mut ask = |method: &str, mut params: Value| {
        params["session"] = id.clone();
        editor.ask(&format!("groundstate/session/{method}"), params)["result"].clone()
    };
    // A step asks for an input, then for a choice, and tells what it changed by which updates of which rules.
    let asks = ask("step", json!({}));
    assert_eq!((&asks["waiting"], &asks["word"]), (&json!("input"), &json!("pressed")), "{asks}");
    assert_eq!(asks["offered"], json!(["true", "false"]));
    assert!(ask("step", json!({}))["refused"].is_string());
    assert!(ask("answer", json!({ "value": "3" }))["refused"].is_string());
    let asks = ask("answer", json!({ "value": "true" }));
    assert_eq!((&asks["waiting"], &asks["at"]["range"]["start"]["line"]), (&json!("choice"), &json!(13)), "{asks}");
    assert_eq!(asks["offered"], json!(["ON", "OFF"]));
    assert!(ask("choose", json!({ "candidate": 2 }))["refused"].is_string());
    let made = ask("choose", json!({ "candidate": 0 }));
    assert_eq!(
        (&made["step"], &made["state"]),
        (&json!(1), &json!({ "light": "ON", "count": "1", "pressed": "true" })),
        "{made}"
    );
    let lanes = ask("timeline", json!({}));
    assert_eq!((&lanes["steps"], &lanes["empty"], &lanes["run"]["shown"]), (&json!(1), &json!(false), &json!(2)));
    let names: Vec<&Value> = lanes["run"]["lanes"].as_array().unwrap().iter().map(|lane| &lane["n"]).collect();
    assert_eq!(names, ["light", "count"]);
    assert!(
        lanes["markup"].as_str().unwrap().contains("id=\"detail\"") && !lanes["style"].as_str().unwrap().contains('$')
    );
    let lines = |list: &Value| -> Vec<(String, u64)> {
        let of = |one: &Value| {
            let name = one["location"].as_str().or(one["name"].as_str()).unwrap_or_default();
            (name.to_string(), one["at"]["range"]["start"]["line"].as_u64().unwrap_or_default())
        };
        list.as_array().expect("a list").iter().map(of).collect()
    };
    let mut updates = lines(&made["updates"]);
    updates.sort();
    assert_eq!(updates, [("count".to_string(), 8), ("light".to_string(), 13)]);
    let mut rules = lines(&made["rules"]);
    rules.sort();
    assert_eq!(rules, [("r_Count".to_string(), 8), ("r_Main".to_string(), 10)]);
    // A clash names both updates; a step back makes it undone.
    ask("set", json!({ "location": "pressed", "value": "false" }));
    let clash = ask("step", json!({}));
    assert_eq!((&clash["waiting"], &clash["word"]), (&json!("nothing"), &json!("fault")), "{clash}");
    let fault = &clash["faults"][0];
    assert_eq!(fault["id"], "inconsistent-update", "{clash}");
    let both = [&fault["at"], &fault["related"][0]["at"]].map(|at| at["range"]["start"]["line"].clone());
    assert_eq!(both, [json!(9), json!(9)], "{clash}");
    let back = ask("back", json!({}));
    assert_eq!(
        (&back["step"], &back["state"]["light"], &back["waiting"]),
        (&json!(0), &json!("OFF"), &json!("step")),
        "{back}"
    );
    assert!(ask("back", json!({}))["refused"].is_string());
    assert_eq!(ask("close", json!({})), Value::Null);
    assert!(ask("state", json!({})).is_null());
    // With a seed nothing is asked; a text that is typed meanwhile makes places stale.
    let mut seeded = document;
    seeded["seed"] = json!(3);
    let opened = editor.ask("groundstate/session/open", seeded)["result"].clone();
    editor.change("Lamp.asm", 2, json!({ "text": LAMP }));
    let made = editor.ask("groundstate/session/step", json!({ "session": opened["session"], "steps": 1 }));
    assert_eq!((&made["result"]["stale"], opened["stale"].as_bool()), (&json!(true), Some(false)), "{made}");
    editor.end();
}

const MEETING: &str = "scenario meeting
load Lamp.asm
set pressed := true;
check light = OFF;
step
check light = ON;
set pressed := false;
step
check light = OFF;
";

#[test]
fn a_scenario_is_stepped_line_by_line() {
    let mut editor = Editor::plain("play", &[("Lamp.asm", LAMP), ("Meeting.avalla", MEETING)]);
    let document = json!({ "textDocument": { "uri": editor.uri("Meeting.avalla") } });
    let opened = editor.ask("groundstate/session/open", document)["result"].clone();
    let id = opened["session"].clone();
    let line = |told: &Value| told["next"]["range"]["start"]["line"].as_u64();
    assert_eq!((line(&opened), &opened["step"], &opened["waiting"]), (Some(0), &json!(0), &json!("step")), "{opened}");
    let mut ask = |method: &str, mut params: Value| {
        params["session"] = id.clone();
        editor.ask(&format!("groundstate/session/{method}"), params)["result"].clone()
    };
    // The initial state has the sets before the first step in it. Checks see the inputs of the step that follows.
    let mut seen = Vec::new();
    let mut told = json!(null);
    for _ in 0..6 {
        told = ask("step", json!({}));
        seen.push((line(&told), told["step"].as_u64().unwrap_or_default()));
    }
    assert_eq!(seen, [(Some(3), 0), (Some(4), 0), (Some(6), 1), (Some(5), 1), (Some(7), 1), (Some(8), 2)], "{told}");
    // Nothing was pressed in the second step, so the rule that toggles did not run.
    assert_eq!((&told["state"]["light"], &told["updates"]), (&json!("ON"), &json!([])), "{told}");
    let failed = ask("step", json!({}));
    assert_eq!((&failed["waiting"], &failed["word"]), (&json!("nothing"), &json!("failed")), "{failed}");
    let fault = &failed["faults"][0];
    assert_eq!((&fault["id"], &fault["at"]["range"]["start"]["line"]), (&json!("check-failed"), &json!(8)), "{failed}");
    assert!(fault["at"]["uri"].as_str().is_some_and(|uri| uri.ends_with("Meeting.avalla")), "{failed}");
    assert!(ask("step", json!({}))["refused"].is_string());
    // Back, and the same again.
    let back = ask("back", json!({}));
    assert_eq!((line(&back), &back["waiting"], &back["faults"]), (Some(8), &json!("step"), &json!([])), "{back}");
    for _ in 0..4 {
        told = ask("back", json!({}));
    }
    assert_eq!((line(&told), &told["step"], &told["state"]["light"]), (Some(4), &json!(0), &json!("OFF")), "{told}");
    let made = ask("step", json!({ "steps": 1 }));
    assert_eq!((&made["updates"][0]["after"], &made["rules"][1]["name"]), (&json!("ON"), &json!("r_Toggle")), "{made}");
    // Inputs are the scenario's, and what is asked for beyond the end stops there.
    assert!(ask("set", json!({ "location": "pressed", "value": "true" }))["refused"].is_string());
    let ended = ask("step", json!({ "steps": 100 }));
    assert_eq!((&ended["word"], &ended["step"]), (&json!("failed"), &json!(2)), "{ended}");
    assert_eq!(ask("close", json!({})), Value::Null);
    let document = json!({ "textDocument": { "uri": editor.uri("Nothing.avalla") } });
    assert!(editor.ask("groundstate/session/open", document)["error"]["message"].is_string());
    editor.end();
}

#[test]
fn a_step_that_asks_is_abandoned_by_going_back() {
    let mut editor = Editor::plain("abandon", &[("Lamp.asm", LAMP)]);
    let document = json!({ "textDocument": { "uri": editor.uri("Lamp.asm") } });
    let id = editor.ask("groundstate/session/open", document)["result"]["session"].clone();
    let mut ask = |method: &str, mut params: Value| {
        params["session"] = id.clone();
        editor.ask(&format!("groundstate/session/{method}"), params)["result"].clone()
    };
    for _ in 0..2 {
        ask("step", json!({}));
        ask("answer", json!({ "value": "true" }));
    }
    let asks = ask("step", json!({}));
    assert_eq!((&asks["waiting"], &asks["step"]), (&json!("input"), &json!(2)), "{asks}");
    let back = ask("back", json!({}));
    let here = (&json!("step"), &json!(2), &json!("OFF"));
    assert_eq!((&back["waiting"], &back["step"], &back["state"]["light"]), here, "{back}");
    // An update that changes nothing is told as such.
    ask("set", json!({ "location": "pressed", "value": "false" }));
    let idle = ask("step", json!({}));
    assert_eq!((&idle["step"], &idle["updates"], &idle["rules"][0]["name"]), (&json!(3), &json!([]), &json!("r_Main")));
    editor.end();
}
