//! What a browser asks about systems: properties with their places, changes of them, the times that follow; and runs with recorded inputs.

use serde_json::{Value, json};

use crate::browser::{Running, Tab};

const AXIS: &str = "chart Axis\n\nsystem axis\n\ttick 0.5 ms\n\tcomponent look synchronous period 10 ms // sees\n\
                    \t\telaborate scan 1.5..2 ms\n\t\twrite seen\n\tendcomponent\n\tcomponent act asynchronous awaits seen\n\
                    \t\tread seen as take 1 ms\n\tendcomponent\n\tchannel seen from look to act queue 4\n\twithin 50 ms from look to act\nendsystem\n";

fn opened(running: &Running, text: &str) -> (Tab, Value) {
    let mut tab = running.tab();
    tab.initialize(running);
    let document = json!({ "uri": running.uri("Axis.chart") });
    let item = json!({ "uri": document["uri"], "languageId": "groundstate-chart", "version": 1, "text": text });
    tab.tell("textDocument/didOpen", json!({ "textDocument": item }));
    (tab, document)
}

#[test]
fn properties_have_their_places_and_are_set() {
    let running = Running::over(&[("Axis.chart", AXIS)]);
    let (mut tab, document) = opened(&running, AXIS);
    let picture = tab.ask("groundstate/chart/picture", json!({ "textDocument": document })).expect("drawn");
    let system = &picture["drawings"][0]["system"];
    let look = &system["parts"]["look"];
    let at = |line: u64, from: u64, to: u64| json!({ "start": { "line": line, "character": from }, "end": { "line": line, "character": to } });
    assert_eq!(look["period"], json!({ "text": "10 ms", "range": at(4, 35, 40) }));
    assert_eq!((&look["offset"], &look["synchronous"]), (&Value::Null, &json!(true)));
    assert_eq!(look["phases"][0]["time"], json!({ "text": "1.5..2 ms", "range": at(5, 17, 26) }));
    assert_eq!((&look["phases"][1]["time"], &look["phases"][1]["subject"]), (&Value::Null, &json!("seen")));
    let act = &system["parts"]["act"];
    assert_eq!((&act["awaits"]["text"], &act["phases"][0]["name"]["text"]), (&json!("seen"), &json!("take")));
    let seen = &system["parts"]["seen"];
    assert_eq!(
        (&seen["made"], &seen["size"]["text"], &seen["readers"]),
        (&json!("queue"), &json!("4"), &json!(["act"]))
    );
    assert_eq!(system["ages"][0]["limit"]["text"], "50 ms");
    let mut set = |operation: Value| {
        let params = json!({ "textDocument": document, "drawing": "axis", "operation": operation });
        tab.ask("groundstate/chart/edit", params).map(|edited| edited["edits"][0]["newText"].clone())
    };
    let to = |property: &str, value: &str| json!({ "kind": "set", "id": "look", "property": property, "value": value });
    assert_eq!(set(to("period", "20 ms")), Ok(json!("2")));
    assert_eq!(set(to("deadline", "8 ms")), Ok(json!("deadline 8 ms ")));
    assert!(set(to("period", "20 minutes")).is_err_and(|reason| reason.starts_with("`20 minutes` is no time")));
    assert_eq!(set(to("colour", "red")), Err("`colour` is no property".to_string()));
    assert_eq!(set(to("phaseTime", "1 ms")), Err("`at` is a number from 0".to_string()));
    assert!(set(json!({ "kind": "addPhase", "id": "look", "verb": "sing", "subject": "x" })).is_err());
    assert!(set(json!({ "kind": "movePhase", "id": "look", "at": 0, "to": 1_000_000 })).is_err());
    assert_eq!(
        set(json!({ "kind": "addAge", "from": "act", "to": "look", "limit": "9 ms" })),
        Ok(json!("\twithin 9 ms from act to look\n"))
    );
}

#[test]
fn a_component_opens_its_machine() {
    let machine = "asm Eye\nimport StandardLibrary\nsignature:\n\tcontrolled n: Integer\ndefinitions:\n\tmain rule r_Main = n := 1\n\
                   default init s0:\n\tfunction n = 0\n";
    let chart = AXIS.replace("scan 1.5..2 ms", "scan 1.5..2 ms by Eye");
    let running = Running::over(&[("Axis.chart", &chart), ("Eye.asm", machine)]);
    let (mut tab, document) = opened(&running, &chart);
    let picture = tab.ask("groundstate/chart/picture", json!({ "textDocument": document })).expect("drawn");
    let boxes = picture["drawings"][0]["picture"]["boxes"].as_array().expect("it has boxes");
    let of = |id: &str| &boxes.iter().find(|one| one["id"] == id).expect("it is drawn")["opens"];
    assert_eq!(of("look")["name"], "Eye");
    assert!(of("look")["uri"].as_str().is_some_and(|uri| uri.ends_with("/Eye.asm")), "{}", of("look"));
    assert_eq!((of("act"), of("seen")), (&Value::Null, &Value::Null));
}

#[test]
fn times_follow_the_text_and_are_not_told_of_one_that_is_wrong() {
    let running = Running::over(&[("Axis.chart", AXIS)]);
    let (mut tab, document) = opened(&running, AXIS);
    let mut version = 1;
    let mut times = |text: &str| {
        version += 1;
        let change = json!({ "textDocument": { "uri": document["uri"], "version": version }, "contentChanges": [{ "text": text }] });
        tab.tell("textDocument/didChange", change);
        tab.ask("groundstate/chart/times", json!({ "textDocument": document }))
    };
    let told = times(AXIS).expect("it has times");
    assert_eq!(
        (&told["tasks"][0]["name"], &told["tasks"][0]["execution_ns"]),
        (&json!("look"), &json!([2_000_000, 2_500_000]))
    );
    assert_eq!((told["told"].as_array().map(Vec::len), &told["processors"]), (Some(1), &json!(1)));
    let slower = times(&AXIS.replace("1.5..2 ms", "12 ms")).expect("it has times");
    assert_eq!(slower["tasks"][0]["verdict"], "misses");
    assert!(slower["told"].to_string().contains("more than there are"), "{slower}");
    let stated = times(&AXIS.replace("system axis\n", "system axis\n\tprocessors 2\n")).expect("it has times");
    assert_eq!((&stated["told"], &stated["processors"]), (&json!([]), &json!(2)));
    for wrong in [
        AXIS.replace("period 10 ms", "period 10"),
        AXIS.replace("awaits seen", "awaits none"),
        AXIS.replace("period 10 ms", "period 0.3 ms"),
    ] {
        let refused = times(&wrong);
        assert!(refused.is_err(), "{wrong}: {refused:?}");
    }
    assert_eq!(times("chart Axis\n"), Ok(Value::Null));
}

const GAUGE: &str = "asm Gauge\nimport StandardLibrary\nsignature:\n\tdomain Percent subsetof Integer\n\tmonitored level: Percent\n\
                     \tcontrolled sum: Integer\ndefinitions:\n\tdomain Percent = {0 : 200}\n\tmain rule r_Main = sum := sum + level\n\
                     default init s0:\n\tfunction sum = 0\n";

#[test]
fn a_run_takes_recorded_inputs() {
    let running = Running::over(&[("Gauge.asm", GAUGE)]);
    let mut tab = running.tab();
    tab.initialize(&running);
    let document = json!({ "uri": running.uri("Gauge.asm") });
    let mut open =
        |inputs: Value| tab.ask("groundstate/session/open", json!({ "textDocument": document, "inputs": inputs }));
    let wrong = [
        (json!({ "name": "a.yaml", "text": "1: { level: high }\n" }), "a.yaml:1: "),
        (json!({ "name": "a.csv", "text": "step,other\n1,2\n" }), "a.csv:1: "),
        (json!({ "name": "a.yaml", "text": "1: [\n" }), "a.yaml:"),
        (json!({ "name": "a.txt", "text": "" }), "a.txt is neither YAML nor CSV"),
        (json!("a.yaml"), "`inputs` has the `name` and the `text` of a file"),
    ];
    for (inputs, expected) in wrong {
        let refused = open(inputs.clone()).expect_err("it is refused");
        assert!(refused.starts_with(expected), "{inputs}: {refused}");
    }
    let session =
        open(json!({ "name": "a.csv", "text": "step,level\n1,20\n2,150\n" })).expect("it runs")["session"].clone();
    let state = tab.ask("groundstate/session/step", json!({ "session": session, "steps": 3 })).expect("stepped");
    assert_eq!((&state["step"], &state["bounds"]), (&json!(3), &Value::Null));
    assert!(state["state"].to_string().contains("320"), "{state}");
    let asking = tab.ask("groundstate/session/open", json!({ "textDocument": document })).expect("it runs");
    let asked = tab.ask("groundstate/session/step", json!({ "session": asking["session"] })).expect("it asks");
    assert_eq!((&asked["waiting"], &asked["bounds"]), (&json!("input"), &json!([0, 200])));
}
