//! The debug adapter as a debugger meets it: a process, messages over its stdin and stdout.

#![allow(clippy::disallowed_methods, reason = "tests write files")]

use std::io::{BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use serde_json::{Value, json};

pub const LIFT: &str = "asm Lift
import StandardLibrary
signature:
	domain Floor subsetof Integer
	enum domain Door = {OPEN | SHUT}
	controlled floor: Floor
	controlled door: Door
	controlled visits: Floor -> Integer
	derived top: Boolean
	monitored called: Floor
	out bell: Integer
definitions:
	domain Floor = {0 : 3}
	function top = floor = 3
	rule r_Ring =
		bell := 1 - bell
	macro rule r_Open =
		par
			door := OPEN
			visits(floor) := visits(floor) + 1
			r_Ring[]
		endpar
	invariant inv_low over floor: floor < 3
	main rule r_Main =
		if floor < called then
			par
				floor := floor + 1
				door := SHUT
			endpar
		else if floor > called then
			floor := floor - 1
		else
			r_Open[]
		endif endif
default init s0:
	function floor = 0
	function door = SHUT
	function visits($f in Floor) = 0
	function bell = 0
";

/// A debugger with its adapter.
pub struct Debugger {
    adapter: Child,
    input: Option<ChildStdin>,
    output: BufReader<ChildStdout>,
    folder: PathBuf,
    /// Events that came while something else was waited for.
    pub events: Vec<Value>,
    next: i64,
    sequence: u64,
}

impl Debugger {
    pub fn start(name: &str, files: &[(&str, &str)]) -> Debugger {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("dap-{name}"));
        _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).expect("a folder");
        for (file, text) in files {
            std::fs::write(folder.join(file), text).expect("a file");
        }
        let mut adapter = Command::new(env!("CARGO_BIN_EXE_groundstate"))
            .arg("dap")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("the adapter starts");
        let input = adapter.stdin.take();
        let output = BufReader::new(adapter.stdout.take().expect("stdout"));
        Debugger { adapter, input, output, folder, events: Vec::new(), next: 0, sequence: 0 }
    }

    pub fn path(&self, file: &str) -> String {
        self.folder.join(file).display().to_string()
    }

    fn write(&mut self, text: &str) {
        let input = self.input.as_mut().expect("it is open");
        input.write_all(text.as_bytes()).expect("the adapter reads");
        input.flush().expect("the adapter reads");
    }

    fn send(&mut self, message: &Value) {
        let text = message.to_string();
        self.write(&format!("Content-Length: {}\r\n\r\n{text}", text.len()));
    }

    fn receive(&mut self) -> Value {
        let mut length = 0;
        loop {
            let mut line = String::new();
            assert!(self.output.read_line(&mut line).expect("the adapter writes") > 0, "the adapter ended");
            match line.trim().strip_prefix("Content-Length: ") {
                Some(number) => length = number.parse().expect("a length"),
                None if line.trim().is_empty() => break,
                None => {}
            }
        }
        let mut text = vec![0; length];
        self.output.read_exact(&mut text).expect("a message");
        let message: Value = serde_json::from_slice(&text).expect("JSON");
        // Messages are numbered without a gap.
        self.sequence += 1;
        assert_eq!(message["seq"], self.sequence, "{message}");
        message
    }

    /// Sends a request and waits for its response.
    pub fn ask(&mut self, command: &str, arguments: Value) -> Value {
        self.next += 1;
        let id = self.next;
        self.send(&json!({ "seq": id, "type": "request", "command": command, "arguments": arguments }));
        loop {
            let message = self.receive();
            if message["type"] == "response" {
                assert_eq!((&message["request_seq"], &message["command"]), (&json!(id), &json!(command)), "{message}");
                return message;
            }
            self.events.push(message);
        }
    }

    /// The body of a response that is no failure.
    pub fn body(&mut self, command: &str, arguments: Value) -> Value {
        let response = self.ask(command, arguments);
        assert_eq!(response["success"], true, "{response}");
        response["body"].clone()
    }

    /// Why a request fails.
    pub fn refused(&mut self, command: &str, arguments: Value) -> String {
        let response = self.ask(command, arguments);
        assert_eq!(response["success"], false, "{response}");
        response["message"].as_str().expect("a reason").to_string()
    }

    pub fn event(&mut self, name: &str) -> Value {
        loop {
            if let Some(at) = self.events.iter().position(|event| event["event"] == name) {
                return self.events.remove(at)["body"].clone();
            }
            let message = self.receive();
            assert_eq!(message["type"], "event", "{message}");
            self.events.push(message);
        }
    }

    /// Waits for a stop, and gives its reason.
    pub fn stop(&mut self) -> String {
        let body = self.event("stopped");
        assert_eq!(body["threadId"], 1, "{body}");
        body["reason"].as_str().expect("a reason").to_string()
    }

    /// Goes on by a command, to the next stop.
    pub fn go(&mut self, command: &str) -> String {
        self.body(command, json!({ "threadId": 1 }));
        self.stop()
    }

    /// Launches, and stops in the initial state.
    pub fn launch(&mut self, file: &str, more: Value) -> String {
        self.body("initialize", json!({ "adapterID": "groundstate" }));
        let mut arguments = json!({ "program": self.path(file) });
        for (key, value) in more.as_object().expect("an object") {
            arguments[key] = value.clone();
        }
        self.body("launch", arguments);
        self.event("initialized");
        self.body("configurationDone", json!({}));
        self.stop()
    }

    pub fn value(&mut self, term: &str) -> String {
        let body = self.body("evaluate", json!({ "expression": term, "context": "watch" }));
        body["result"].as_str().expect("a text").to_string()
    }

    /// The variables of a scope, as `name = value`.
    fn scope(&mut self, name: &str) -> (u64, Vec<String>) {
        let scopes = self.body("scopes", json!({ "frameId": 1 }))["scopes"].clone();
        let scopes = scopes.as_array().expect("scopes");
        let scope = scopes.iter().find(|scope| scope["name"] == name).unwrap_or_else(|| panic!("{name}: {scopes:?}"));
        let reference = scope["variablesReference"].as_u64().expect("a number");
        (reference, self.variables(reference))
    }

    fn variables(&mut self, reference: u64) -> Vec<String> {
        let told = self.body("variables", json!({ "variablesReference": reference }))["variables"].clone();
        let text = |one: &Value| format!("{} = {}", one["name"].as_str().unwrap(), one["value"].as_str().unwrap());
        told.as_array().expect("variables").iter().map(text).collect()
    }

    /// The frames: line and name.
    pub fn frames(&mut self) -> Vec<(u64, String)> {
        let told = self.body("stackTrace", json!({ "threadId": 1 }))["stackFrames"].clone();
        let frame = |one: &Value| (one["line"].as_u64().unwrap(), one["name"].as_str().unwrap().to_string());
        told.as_array().expect("frames").iter().map(frame).collect()
    }

    pub fn breakpoints(&mut self, file: &str, wanted: Value) -> Vec<Value> {
        let source = json!({ "path": self.path(file) });
        let body = self.body("setBreakpoints", json!({ "source": source, "breakpoints": wanted }));
        body["breakpoints"].as_array().expect("a list").clone()
    }

    pub fn end(mut self) {
        self.body("disconnect", json!({}));
        assert!(self.adapter.wait().expect("it ends").success());
    }
}

#[test]
fn a_model_is_stepped_forth_and_back() {
    let mut debugger = Debugger::start("steps", &[("Lift.asm", LIFT)]);
    assert_eq!(debugger.launch("Lift.asm", json!({})), "entry");
    assert_eq!(debugger.body("threads", json!({}))["threads"][0]["name"], "Lift");
    assert_eq!(debugger.value("floor"), "0");
    let (_, controlled) = debugger.scope("Controlled");
    assert_eq!(controlled, ["floor = 0", "door = SHUT", "visits = (Floor) → Integer"]);
    let (_, derived) = debugger.scope("Derived");
    assert_eq!(derived, ["top = false"]);
    assert_eq!(debugger.scope("Monitored").1, ["called = ?"]);
    // A step asks for the input. It goes on only when there is one, and it is checked.
    assert_eq!(debugger.go("next"), "input");
    assert!(debugger.refused("next", json!({ "threadId": 1 })).contains("called is asked for"));
    let (asked, told) = debugger.scope("Asked for");
    assert_eq!(told, ["called = ?"]);
    let set = |value: &str| json!({ "variablesReference": asked, "name": "called", "value": value });
    assert!(debugger.refused("setVariable", set("9")).contains("not in Floor"));
    assert!(debugger.refused("setVariable", set("up")).contains("not a value"));
    assert_eq!(debugger.body("setVariable", set("2"))["value"], "2");
    assert_eq!(debugger.scope("Asked for").1, ["called = 2"]);
    assert_eq!(debugger.go("next"), "step");
    assert_eq!(debugger.scope("Last updates").1, ["floor = 0 → 1"]);
    let frames = debugger.frames();
    assert_eq!(frames[0], (27, "floor := 1 in r_Main".to_string()), "{frames:?}");
    assert_eq!(frames[1], (28, "door := SHUT in r_Main, as it was".to_string()), "{frames:?}");
    let output = debugger.event("output");
    assert_eq!(output["output"], "step 1: floor := 1\n");
    // The input holds from now on.
    assert_eq!(debugger.go("stepIn"), "step");
    assert_eq!(debugger.go("stepOut"), "step");
    assert_eq!(
        (debugger.value("(floor, door, top)"), debugger.value("visits(2)")),
        ("(2,OPEN,false)".into(), "1".into())
    );
    let (controlled, _) = debugger.scope("Controlled");
    let told = debugger.body("variables", json!({ "variablesReference": controlled }))["variables"].clone();
    let visits = told[2]["variablesReference"].as_u64().expect("a number");
    assert_eq!(debugger.variables(visits), ["visits(0) = 0", "visits(1) = 0", "visits(2) = 1", "visits(3) = 0"]);
    let refused =
        debugger.refused("setVariable", json!({ "variablesReference": controlled, "name": "floor", "value": "1" }));
    assert!(refused.contains("written by the machine"), "{refused}");
    assert_eq!(debugger.go("stepBack"), "step");
    assert_eq!((debugger.value("floor"), debugger.value("door")), ("2".into(), "SHUT".into()));
    assert_eq!(debugger.frames()[0].1, "floor := 2 in r_Main");
    assert_eq!(debugger.go("reverseContinue"), "entry");
    assert_eq!(debugger.value("floor"), "0");
    assert_eq!(debugger.go("stepBack"), "step");
    // Taken away, the input is asked for again; the step that asks can be abandoned.
    let typed = |text: &str| json!({ "expression": text, "context": "repl" });
    debugger.body("evaluate", typed("called := ?"));
    assert_eq!(debugger.go("continue"), "input");
    assert_eq!(debugger.go("stepBack"), "step");
    assert_eq!(debugger.value("floor"), "0");
    assert_eq!(debugger.go("next"), "input");
    debugger.body("evaluate", typed("called := 3"));
    // The invariant is violated on the third floor. The run can go on.
    assert_eq!(debugger.go("continue"), "exception");
    let info = debugger.body("exceptionInfo", json!({ "threadId": 1 }));
    assert_eq!(info["exceptionId"], "invariant-violated", "{info}");
    assert_eq!(debugger.frames()[0].0, 23);
    assert_eq!((debugger.value("floor"), debugger.value("top")), ("3".into(), "true".into()));
    assert!(debugger.refused("evaluate", json!({ "expression": "flor" })).contains("flor"));
    assert!(debugger.refused("evaluate", json!({ "expression": "idiv(1, 0)" })).contains("zero"));
    debugger.end();
}

#[test]
fn breakpoints_stop_where_something_happens() {
    let mut debugger = Debugger::start("breaks", &[("Lift.asm", LIFT)]);
    assert_eq!(debugger.launch("Lift.asm", json!({ "inputs": { "called": "2" } })), "entry");
    // A line with nothing to stop at moves to the next; beyond the last there is none.
    let told = debugger
        .breakpoints("Lift.asm", json!([{ "line": 18 }, { "line": 27, "condition": "floor = 2" }, { "line": 30 }]));
    let lines: Vec<&Value> = told.iter().map(|one| &one["line"]).collect();
    assert_eq!(lines, [&json!(19), &json!(27), &json!(31)], "{told:?}");
    assert!(told.iter().all(|one| one["verified"] == true));
    assert_eq!(debugger.go("continue"), "breakpoint");
    assert_eq!((debugger.value("floor"), debugger.frames()[0].0), ("2".into(), 27));
    assert_eq!(debugger.go("continue"), "breakpoint");
    assert_eq!((debugger.value("door"), debugger.frames()[0].0), ("OPEN".into(), 19));
    // Backwards, too.
    assert_eq!(debugger.go("reverseContinue"), "breakpoint");
    assert_eq!(debugger.value("door"), "SHUT");
    // Wrong places and conditions are told.
    let told = debugger.breakpoints(
        "Lift.asm",
        json!([{ "line": 900 }, { "line": 27, "condition": "floor" }, { "line": 27, "condition": "(" }]),
    );
    assert!(told.iter().all(|one| one["verified"] == false && one["message"].is_string()), "{told:?}");
    assert_eq!(debugger.breakpoints("Other.asm", json!([{ "line": 1 }]))[0]["verified"], false);
    let locations = json!({ "source": { "path": debugger.path("Lift.asm") }, "line": 15, "endLine": 20 });
    let lines = debugger.body("breakpointLocations", locations)["breakpoints"].clone();
    assert_eq!(lines, json!([{ "line": 15 }, { "line": 16 }, { "line": 17 }, { "line": 19 }, { "line": 20 }]));
    // Rules by name.
    let rules =
        debugger.body("setFunctionBreakpoints", json!({ "breakpoints": [{ "name": "r_Ring" }, { "name": "r_Rung" }] }));
    assert_eq!((&rules["breakpoints"][0]["line"], &rules["breakpoints"][1]["verified"]), (&json!(15), &json!(false)));
    assert_eq!(debugger.go("continue"), "function breakpoint");
    assert_eq!(debugger.frames()[0].0, 16);
    debugger.body("setFunctionBreakpoints", json!({ "breakpoints": [] }));
    // A location, and all of a function.
    let info = |name: &str| json!({ "name": name });
    assert_eq!(debugger.body("dataBreakpointInfo", info("visits(2)"))["dataId"], "visits(2)");
    assert_eq!(debugger.body("dataBreakpointInfo", info("called"))["dataId"], Value::Null);
    assert_eq!(debugger.body("dataBreakpointInfo", info("nothing"))["dataId"], Value::Null);
    debugger
        .body("setDataBreakpoints", json!({ "breakpoints": [{ "dataId": "visits", "condition": "visits(2) = 4" }] }));
    assert_eq!(debugger.go("continue"), "data breakpoint");
    assert_eq!(debugger.value("visits(2)"), "4");
    debugger.body("setDataBreakpoints", json!({ "breakpoints": [{ "dataId": "floor" }] }));
    debugger.body("evaluate", json!({ "expression": "called := 0", "context": "repl" }));
    assert_eq!(debugger.go("continue"), "data breakpoint");
    assert_eq!((debugger.value("floor"), debugger.frames()[0].0), ("1".into(), 31));
    assert!(debugger.refused("setExceptionBreakpoints", json!({ "filters": ["all"] })).contains("violations"));
    debugger.end();
}

const RIDE: &str = "scenario ride
load Lift.asm
set called := 1;
step
check floor = 1;
step
check door = OPEN and visits(1) = 1;
check bell = 0;
set called := 0;
step
";

#[test]
fn a_scenario_stops_at_lines_and_at_what_fails() {
    let mut debugger = Debugger::start("scenario", &[("Lift.asm", LIFT), ("Ride.avalla", RIDE)]);
    assert_eq!(debugger.launch("Ride.avalla", json!({})), "entry");
    assert_eq!(debugger.frames()[0], (1, "next: ride".to_string()));
    assert_eq!(debugger.go("next"), "step");
    assert_eq!(debugger.frames()[0], (4, "next: step".to_string()));
    assert!(
        debugger.refused("setExpression", json!({ "expression": "called", "value": "1" })).contains("the scenario")
    );
    let told = debugger.breakpoints("Ride.avalla", json!([{ "line": 7 }]));
    assert_eq!((&told[0]["verified"], &told[0]["line"]), (&json!(true), &json!(7)));
    debugger.breakpoints("Lift.asm", json!([{ "line": 27 }]));
    assert_eq!(debugger.go("continue"), "breakpoint");
    let frames = debugger.frames();
    assert_eq!((frames[0].0, frames[1].0), (27, 5), "{frames:?}");
    // The command is about to be made.
    assert_eq!(debugger.go("continue"), "breakpoint");
    assert_eq!(debugger.frames()[0], (7, "next: check door = OPEN and visits(1) = 1;".to_string()));
    // Sets come before the checks of the same step.
    assert_eq!((debugger.value("door"), debugger.value("called")), ("OPEN".into(), "0".into()));
    assert_eq!(debugger.go("next"), "step");
    assert_eq!(debugger.go("next"), "exception");
    let frames = debugger.frames();
    assert_eq!(frames[0].0, 8, "{frames:?}");
    assert!(frames[0].1.contains("expected 0, found 1"), "{frames:?}");
    // Back to before the check, and on again.
    assert_eq!(debugger.go("stepBack"), "step");
    assert_eq!(debugger.frames()[0].0, 8);
    assert_eq!(debugger.go("continue"), "exception");
    debugger.body("continue", json!({ "threadId": 1 }));
    debugger.event("terminated");
    assert_eq!(debugger.refused("next", json!({ "threadId": 1 })), "the run has ended");
    debugger.end();
    // One that passes ends by itself, and says so.
    let passes = RIDE.replace("bell = 0", "bell = 1");
    let mut debugger = Debugger::start("passes", &[("Lift.asm", LIFT), ("Ride.avalla", &passes)]);
    debugger.launch("Ride.avalla", json!({}));
    debugger.body("continue", json!({ "threadId": 1 }));
    debugger.event("terminated");
    let said = debugger
        .events
        .iter()
        .any(|event| event["body"]["output"] == "ride passed: 3 steps, 3 checks held, 0 failed\n");
    assert!(said, "{:?}", debugger.events);
    debugger.end();
}

const DICE: &str = "asm Dice
import StandardLibrary
signature:
	controlled sum: Integer
	controlled lucky: Boolean
definitions:
	rule r_Clash = par lucky := true lucky := false endpar
	main rule r_Main =
		choose $n in {1 : 6}, $b in Boolean do
			par
				sum := sum + $n
				lucky := $b
				if sum > 100 then r_Clash[] endif
			endpar
default init s0:
	function sum = 0
";

#[test]
fn choices_are_asked_for_or_drawn() {
    let mut debugger = Debugger::start("choices", &[("Dice.asm", DICE)]);
    debugger.launch("Dice.asm", json!({}));
    assert_eq!(debugger.go("next"), "choice");
    assert_eq!(debugger.frames()[0].0, 9);
    let typed = |text: &str| json!({ "expression": text, "context": "repl" });
    assert!(debugger.refused("evaluate", typed("choice := 7, true")).contains("1, true"));
    assert_eq!(debugger.body("evaluate", typed("choice := 5, false"))["result"], "5, false");
    assert_eq!(debugger.go("next"), "step");
    assert_eq!(debugger.value("(sum, lucky)"), "(5,false)");
    assert_eq!(debugger.go("next"), "choice");
    debugger.body("setExpression", json!({ "expression": "choice", "value": "#1" }));
    assert_eq!(debugger.go("next"), "step");
    assert_eq!(debugger.value("sum"), "6");
    debugger.end();
    // A seed draws them. A clash stops with both of its updates.
    let mut debugger = Debugger::start("drawn", &[("Dice.asm", DICE)]);
    debugger.launch("Dice.asm", json!({ "seed": 7 }));
    assert_eq!(debugger.go("continue"), "exception");
    let info = debugger.body("exceptionInfo", json!({ "threadId": 1 }));
    assert_eq!(info["exceptionId"], "inconsistent-update", "{info}");
    let frames = debugger.frames();
    assert_eq!((frames[0].0, frames[1].0), (7, 12), "{frames:?}");
    assert!(debugger.value("sum > 100") == "true");
    assert_eq!(debugger.go("stepBack"), "step");
    debugger.end();
}

#[test]
fn what_comes_at_the_wrong_time_or_is_wrong_is_refused() {
    let broken = LIFT
        .replace("asm Lift", "asm Broken")
        .replace("floor - 1", "flor - 1")
        .replace("door := SHUT", "doors := SHUT");
    let mut debugger =
        Debugger::start("wrong", &[("Lift.asm", LIFT), ("Broken.asm", &broken), ("Wrong.avalla", "scenario")]);
    assert!(debugger.refused("launch", json!({ "program": "x.asm" })).contains("`initialize` comes first"));
    assert!(debugger.refused("next", json!({})).contains("too early"));
    assert!(debugger.refused("dance", Value::Null).contains("not supported"));
    debugger.body("initialize", Value::Null);
    assert!(debugger.refused("initialize", json!({})).contains("once"));
    assert!(debugger.refused("configurationDone", json!({})).contains("`launch` comes first"));
    for wrong in [
        json!({}),
        json!({ "program": 3 }),
        json!({ "program": "" }),
        json!({ "program": debugger.path("None.asm") }),
        json!({ "program": debugger.path("Lift.chart") }),
        json!({ "program": debugger.folder.display().to_string() }),
        json!({ "program": debugger.path("Lift.asm"), "seed": -1 }),
        json!({ "program": debugger.path("Lift.asm"), "inputs": { "floor": "1" } }),
        json!({ "program": debugger.path("Lift.asm"), "inputs": [] }),
        json!({ "program": debugger.path("Lift.asm"), "stopOnEntry": "yes" }),
        json!({ "program": debugger.path("Wrong.avalla") }),
    ] {
        assert!(!debugger.refused("launch", wrong.clone()).is_empty(), "{wrong}");
    }
    // A model with errors says all of them, with their places.
    debugger.events.clear();
    let program = debugger.path("Broken.asm");
    let refused = debugger.refused("launch", json!({ "program": program }));
    assert!(refused.contains("2 errors"), "{refused}");
    let lines: Vec<Value> = debugger.events.iter().map(|event| event["body"]["line"].clone()).collect();
    assert_eq!(lines, [json!(28), json!(31)]);
    // What is no message, and no request, costs nothing but itself.
    debugger.write("Content-Length: 5\r\n\r\n{{{{{");
    debugger.write("Content-Length: 2\r\n\r\n[]");
    debugger.send(&json!({ "seq": 1, "type": "event", "event": "boo" }));
    let program = debugger.path("Lift.asm");
    debugger.body("launch", json!({ "program": program }));
    assert!(debugger.refused("launch", json!({ "program": program })).contains("already"));
    debugger.body("configurationDone", json!({}));
    assert_eq!(debugger.stop(), "entry");
    assert!(debugger.refused("variables", json!({ "variablesReference": 99 })).contains("no such variables"));
    assert!(debugger.refused("variables", json!({ "variablesReference": "a" })).contains("number"));
    assert!(debugger.refused("source", json!({ "sourceReference": 4_000_000_000u64 })).contains("no such source"));
    assert!(debugger.refused("evaluate", json!({})).contains("text"));
    let long = format!("1{}", " + 1".repeat(5_000));
    assert!(debugger.refused("evaluate", json!({ "expression": long })).contains("bytes"));
    let deep = format!("{}1{}", "(".repeat(4_000), ")".repeat(4_000));
    debugger.ask("evaluate", json!({ "expression": deep }));
    for command in
        ["scopes", "stackTrace", "setVariable", "setBreakpoints", "setDataBreakpoints", "breakpointLocations"]
    {
        debugger.ask(
            command,
            json!({ "breakpoints": [7, null, { "line": -1 }, { "line": 1e30 }], "variablesReference": -3 }),
        );
    }
    debugger.body("terminate", json!({}));
    debugger.event("terminated");
    debugger.end();
    // Bytes without a length end it, and so does going away.
    let mut debugger = Debugger::start("bytes", &[]);
    debugger.write("Content-Length: many\r\n\r\n");
    assert_eq!(debugger.adapter.wait().expect("it ends").code(), Some(2));
    let mut debugger = Debugger::start("away", &[]);
    debugger.input = None;
    assert_eq!(debugger.adapter.wait().expect("it ends").code(), Some(2));
}

const ENDLESS: &str = "asm Endless
import StandardLibrary
signature:
	controlled n: Integer
	controlled m: Integer
definitions:
	main rule r_Main = par
		n := n + 1
		if n > 1000000000 then while true do m := m + 1 endif
	endpar
default init s0:
	function n = 0
	function m = 0
";

#[test]
fn a_long_run_is_paused_and_left() {
    let mut debugger = Debugger::start("long", &[("Endless.asm", ENDLESS)]);
    debugger.launch("Endless.asm", json!({}));
    debugger.body("continue", json!({ "threadId": 1 }));
    // It runs: there is no state to look at.
    assert!(debugger.refused("evaluate", json!({ "expression": "n" })).contains("running"));
    assert!(debugger.refused("stackTrace", json!({ "threadId": 1 })).contains("running"));
    assert_eq!(debugger.go("pause"), "pause");
    let reached: i64 = debugger.value("n").parse().expect("a number");
    assert!(reached > 0);
    assert_eq!(debugger.go("next"), "step");
    assert_eq!(debugger.value("n"), (reached + 1).to_string());
    // A breakpoint that is set while it runs holds at once.
    debugger.body("continue", json!({ "threadId": 1 }));
    debugger.body("setFunctionBreakpoints", json!({ "breakpoints": [{ "name": "r_Main" }] }));
    assert_eq!(debugger.stop(), "function breakpoint");
    debugger.body("setFunctionBreakpoints", json!({ "breakpoints": [] }));
    debugger.body("continue", json!({ "threadId": 1 }));
    debugger.end();
    // A step without an end is a fault in the end, and can be left before.
    let endless = ENDLESS.replace("n > 1000000000", "n > 2");
    let mut debugger = Debugger::start("endless", &[("Endless.asm", &endless)]);
    debugger.launch("Endless.asm", json!({}));
    assert_eq!(debugger.go("continue"), "exception");
    assert_eq!(debugger.value("n"), "3");
    debugger.end();
    let mut debugger = Debugger::start("left", &[("Endless.asm", &endless)]);
    debugger.launch("Endless.asm", json!({}));
    debugger.body("continue", json!({ "threadId": 1 }));
    debugger.body("terminate", json!({}));
    debugger.event("terminated");
    debugger.end();
}
