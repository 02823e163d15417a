//! Breakpoints that count how often they are reached, and log points, which say something and let the run go on.

use serde_json::{Value, json};

use crate::dap::{Debugger, LIFT};

const COUNTER: &str = "asm Counter
import StandardLibrary
signature:
	controlled n: Integer
	controlled odd: Boolean
	derived half: Integer
definitions:
	function half = idiv(12, n - 3)
	rule r_Odd =
		odd := not odd
	main rule r_Main =
		par
			n := n + 1
			r_Odd[]
		endpar
default init s0:
	function n = 0
	function odd = false
";

/// What was said by log points so far, in order, each with its line.
fn said(debugger: &mut Debugger) -> Vec<(u64, String)> {
    let (logs, others): (Vec<Value>, Vec<Value>) = std::mem::take(&mut debugger.events)
        .into_iter()
        .partition(|event| event["event"] == "output" && event["body"]["line"].is_u64());
    debugger.events = others;
    let log = |event: &Value| {
        let text = event["body"]["output"].as_str().expect("a text").trim_end().to_string();
        assert_eq!((&event["body"]["category"], text.contains('\n')), (&json!("console"), false), "{event}");
        assert!(event["body"]["source"]["path"].as_str().is_some_and(|path| path.ends_with(".asm")), "{event}");
        (event["body"]["line"].as_u64().expect("a line"), text)
    };
    logs.iter().map(log).collect()
}

fn ids(told: &[Value]) -> Vec<u64> {
    told.iter().map(|one| one["id"].as_u64().expect("a number")).collect()
}

#[test]
fn a_breakpoint_counts_how_often_it_is_reached() {
    let mut debugger = Debugger::start("counts", &[("Counter.asm", COUNTER)]);
    let told = debugger.body("initialize", json!({}));
    assert_eq!((&told["supportsHitConditionalBreakpoints"], &told["supportsLogPoints"]), (&json!(true), &json!(true)));
    let program = debugger.path("Counter.asm");
    debugger.body("launch", json!({ "program": program }));
    debugger.body("configurationDone", json!({}));
    assert_eq!(debugger.stop(), "entry");
    let first = debugger.breakpoints("Counter.asm", json!([{ "line": 13, "hitCondition": "5" }]));
    assert_eq!(debugger.go("continue"), "breakpoint");
    assert_eq!(debugger.value("n"), "5");
    // Steps that are taken back are not counted: it stops where it stopped.
    for _ in 0..3 {
        assert_eq!(debugger.go("stepBack"), "step");
    }
    assert_eq!(debugger.go("continue"), "breakpoint");
    assert_eq!(debugger.value("n"), "5");
    assert_eq!(debugger.go("next"), "step");
    assert_eq!(debugger.go("reverseContinue"), "breakpoint");
    assert_eq!(debugger.value("n"), "5");
    // An editor sets all breakpoints of a file when it sets one: what was counted stays.
    let both = json!([{ "line": 13, "hitCondition": "5" }, { "line": 10, "hitCondition": "% 3" }]);
    let again = debugger.breakpoints("Counter.asm", both.clone());
    assert_eq!(ids(&again)[0], ids(&first)[0]);
    assert_ne!(ids(&again)[1], ids(&first)[0]);
    assert_eq!(ids(&debugger.breakpoints("Counter.asm", both)), ids(&again));
    // The second is reached in every step from now on; the first only counts on.
    let mut stops = Vec::new();
    for _ in 0..3 {
        assert_eq!(debugger.go("continue"), "breakpoint");
        stops.push(debugger.value("n"));
    }
    assert_eq!(stops, ["8", "11", "14"]);
    // Backwards it stops where it counted on the way, not where it was not yet set.
    assert_eq!(debugger.go("reverseContinue"), "breakpoint");
    assert_eq!(debugger.value("n"), "11");
    assert_eq!(debugger.go("reverseContinue"), "breakpoint");
    assert_eq!(debugger.go("reverseContinue"), "breakpoint");
    assert_eq!(debugger.value("n"), "5");
    assert_eq!(debugger.go("reverseContinue"), "entry");
    // A condition decides what is counted; rules and data count likewise.
    debugger.breakpoints("Counter.asm", json!([{ "line": 13, "condition": "odd", "hitCondition": ">= 3" }]));
    assert_eq!(debugger.go("continue"), "breakpoint");
    assert_eq!(debugger.value("n"), "5");
    assert_eq!(debugger.go("continue"), "breakpoint");
    assert_eq!(debugger.value("n"), "7");
    debugger.breakpoints("Counter.asm", json!([]));
    debugger.body("setFunctionBreakpoints", json!({ "breakpoints": [{ "name": "r_Odd", "hitCondition": "2" }] }));
    assert_eq!(debugger.go("continue"), "function breakpoint");
    assert_eq!(debugger.value("n"), "9");
    debugger.body("setFunctionBreakpoints", json!({ "breakpoints": [] }));
    debugger.body("setDataBreakpoints", json!({ "breakpoints": [{ "dataId": "odd", "hitCondition": "> 3" }] }));
    assert_eq!(debugger.go("continue"), "data breakpoint");
    assert_eq!(debugger.value("n"), "13");
    for wrong in ["% 0", "0", "often", "< 1", "=> 2"] {
        let told = debugger.breakpoints("Counter.asm", json!([{ "line": 13, "hitCondition": wrong }]));
        assert_eq!((&told[0]["verified"], told[0]["message"].is_string()), (&json!(false), true), "{wrong}: {told:?}");
    }
    debugger.end();
}

#[test]
fn a_log_point_says_something_and_the_run_goes_on() {
    let mut debugger = Debugger::start("logs", &[("Counter.asm", COUNTER)]);
    debugger.launch("Counter.asm", json!({}));
    debugger.breakpoints(
        "Counter.asm",
        json!([
            { "line": 13, "logMessage": "n is {n}, of {{1 : 3}} it is {n in {1 : 3}}, \\{so\\}" },
            { "line": 10, "logMessage": "half {half}", "condition": "n > 1", "hitCondition": "<= 3" },
            { "line": 11, "hitCondition": "6" },
        ]),
    );
    assert_eq!(debugger.go("continue"), "breakpoint");
    assert_eq!(debugger.value("n"), "6");
    let told = said(&mut debugger);
    let of_line =
        |line: u64| told.iter().filter(|(at, _)| *at == line).map(|(_, text)| text.clone()).collect::<Vec<_>>();
    let about_n = of_line(13);
    assert_eq!(about_n.len(), 6, "{told:?}");
    assert_eq!(about_n[0], "n is 1, of {1,2,3} it is true, {so}");
    assert_eq!(about_n[5], "n is 6, of {1,2,3} it is false, {so}");
    // A term without a value says why, in its place.
    let about_half = of_line(10);
    assert_eq!(about_half.len(), 3, "{told:?}");
    assert_eq!((about_half[0].as_str(), about_half[2].as_str()), ("half -12", "half 12"));
    assert!(about_half[1].contains("zero"), "{about_half:?}");
    // Steps say what they say; steps that are taken back say nothing.
    assert_eq!(debugger.go("stepBack"), "step");
    assert_eq!(debugger.go("reverseContinue"), "entry");
    assert_eq!(said(&mut debugger), []);
    assert_eq!(debugger.go("next"), "step");
    assert_eq!(said(&mut debugger).len(), 1);
    for wrong in ["{", "{}", "{m}", "{n +}", "a {n} {"] {
        let told = debugger.breakpoints("Counter.asm", json!([{ "line": 13, "logMessage": wrong }]));
        assert_eq!((&told[0]["verified"], told[0]["message"].is_string()), (&json!(false), true), "{wrong}: {told:?}");
    }
    debugger.end();
}

#[test]
fn a_run_that_says_much_can_be_paused_and_loses_nothing() {
    let mut debugger = Debugger::start("much", &[("Counter.asm", COUNTER)]);
    debugger.launch("Counter.asm", json!({}));
    debugger.breakpoints("Counter.asm", json!([{ "line": 13, "logMessage": "{n}" }]));
    debugger.body("continue", json!({ "threadId": 1 }));
    while debugger.events.len() < 5_000 {
        let event = debugger.event("output");
        debugger.events.push(event.clone());
        if event["output"] == "5000\n" {
            break;
        }
    }
    debugger.events.clear();
    assert_eq!(debugger.go("pause"), "pause");
    let reached: u64 = debugger.value("n").parse().expect("a number");
    let told: Vec<u64> = said(&mut debugger).iter().map(|(_, text)| text.parse().expect("a number")).collect();
    assert_eq!(told.last(), Some(&reached));
    assert!(told.windows(2).all(|two| two[1] == two[0] + 1), "one is missing");
    debugger.end();
}

#[test]
fn a_scenario_has_log_points_too() {
    let ride =
        "scenario ride\nload Lift.asm\nset called := 2;\nstep\ncheck floor = 1;\nstep\nstep\ncheck door = OPEN;\n";
    let mut debugger = Debugger::start("scenario-logs", &[("Lift.asm", LIFT), ("Ride.avalla", ride)]);
    debugger.launch("Ride.avalla", json!({}));
    debugger.breakpoints("Lift.asm", json!([{ "line": 27, "logMessage": "to {called}: {floor}" }]));
    debugger.breakpoints("Ride.avalla", json!([{ "line": 8, "hitCondition": "1" }]));
    assert_eq!(debugger.go("continue"), "breakpoint");
    assert_eq!(said(&mut debugger), [(27, "to 2: 1".to_string()), (27, "to 2: 2".to_string())]);
    debugger.end();
}
