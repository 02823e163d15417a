//! What is done to pictures, and what becomes of texts.

use super::*;

const LAMP: &str = "chart Lamp\n\n// A lamp.\nmachine lamp \"Lamp\"\n\tcontrol light\n\tinitial state off \"Off\" // dark\n\tstate on \"On\"\n\
                    \tguard pressed \"Pressed\"\n\taction count \"COUNT\"\n\n\t// there\n\toff -> pressed yes -> count -> on\n\
                    \ton -> pressed\n\tpressed no -> off\nendmachine\n";

fn joint(from: &str, branch: Option<bool>, to: &str) -> Joint {
    Joint { from: from.to_string(), branch, to: to.to_string() }
}

fn after(text: &str, drawing: &str, operation: Operation) -> String {
    let drawn = drawn(text, drawing, &operation, &BTreeMap::new()).expect("it can be done");
    let edits: Vec<Edit> = drawn.edit.into_iter().collect();
    crate::edited(text, &edits)
}

fn refused(text: &str, drawing: &str, operation: Operation) -> String {
    drawn(text, drawing, &operation, &BTreeMap::new()).expect_err("it is refused")
}

fn fresh(kind: FreshKind, text: &str) -> Fresh {
    Fresh { kind, name: None, text: Some(text.to_string()), link: None, of: None, at: (40.0, 50.04) }
}

/// The lines that differ.
#[track_caller]
fn check(before: &str, operation: Operation, expect: &[&str]) {
    let text = after(before, "lamp", operation);
    let (old, new): (Vec<&str>, Vec<&str>) = (before.lines().collect(), text.lines().collect());
    let gone = old.iter().filter(|line| !new.contains(line)).map(|line| format!("-{line}"));
    let come = new.iter().filter(|line| !old.contains(line)).map(|line| format!("+{line}"));
    let told: Vec<String> = gone.chain(come).collect();
    assert_eq!(told, expect, "{text}");
}

#[test]
fn arrows_come_and_go() {
    // In the middle of a path, at its beginning, at its end, alone.
    check(
        LAMP,
        Operation::Disconnect(joint("pressed", Some(true), "count")),
        &["-\toff -> pressed yes -> count -> on", "+\toff -> pressed", "+\tcount -> on"],
    );
    check(
        LAMP,
        Operation::Disconnect(joint("off", None, "pressed")),
        &["-\toff -> pressed yes -> count -> on", "+\tpressed yes -> count -> on"],
    );
    check(
        LAMP,
        Operation::Disconnect(joint("count", None, "on")),
        &["-\toff -> pressed yes -> count -> on", "+\toff -> pressed yes -> count"],
    );
    check(LAMP, Operation::Disconnect(joint("on", None, "pressed")), &["-\ton -> pressed"]);
    // A path that ends there goes on; an exit that is taken is redirected; a control state may have several.
    let open = after(LAMP, "lamp", Operation::Disconnect(joint("pressed", Some(true), "count")));
    check(
        &open,
        Operation::Connect(joint("pressed", Some(true), "on")),
        &["-\toff -> pressed", "+\toff -> pressed yes -> on"],
    );
    check(
        LAMP,
        Operation::Connect(joint("pressed", Some(false), "on")),
        &["-\tpressed no -> off", "+\tpressed no -> on"],
    );
    check(LAMP, Operation::Connect(joint("on", None, "count")), &["+\ton -> count"]);
    check(LAMP, Operation::Connect(joint("on", None, "pressed")), &[]);
    check(
        LAMP,
        Operation::Redirect(joint("on", None, "pressed"), joint("on", None, "off")),
        &["-\ton -> pressed", "+\ton -> off"],
    );
    assert_eq!(
        refused(LAMP, "lamp", Operation::Connect(joint("pressed", None, "on"))),
        "say which exit of `pressed` it is: yes or no"
    );
    assert_eq!(
        refused(LAMP, "lamp", Operation::Connect(joint("on", None, "exit"))),
        "only a pattern is entered and left; this is a machine"
    );
    assert_eq!(
        refused(LAMP, "lamp", Operation::Disconnect(joint("off", None, "on"))),
        "there is no arrow from `off` to `on`"
    );
}

#[test]
fn shapes_come_and_go() {
    check(
        LAMP,
        Operation::Add(fresh(FreshKind::State, "Broken \"bulb\"")),
        &["+\tstate brokenBulb \"Broken \\\"bulb\\\"\"", "+layout lamp", "+\tbrokenBulb at 40, 50", "+endlayout"],
    );
    check(
        LAMP,
        Operation::Add(fresh(FreshKind::Guard, "Pressed")),
        &["+\tguard pressed2 \"Pressed\"", "+layout lamp", "+\tpressed2 at 40, 50", "+endlayout"],
    );
    check(
        LAMP,
        Operation::Delete(vec!["count".to_string()]),
        &["-\taction count \"COUNT\"", "-\toff -> pressed yes -> count -> on", "+\toff -> pressed"],
    );
    let text = after(
        LAMP,
        "lamp",
        Operation::Delete(vec!["off".to_string(), "on".to_string(), "pressed".to_string(), "count".to_string()]),
    );
    assert_eq!(text, "chart Lamp\n\n// A lamp.\nmachine lamp \"Lamp\"\n\tcontrol light\n\n\t// there\nendmachine\n");
    // From nothing.
    let text = after("chart A\n", "", Operation::Machine { name: "m".into(), is_pattern: false, title: "M".into() });
    assert_eq!(text, "chart A\n\nmachine m \"M\"\n\tcontrol mState\n\tinitial state idle \"Idle\"\nendmachine\n");
    let text = after("chart A machine m endmachine", "m", Operation::Add(fresh(FreshKind::State, "first")));
    assert!(text.contains("control mState") && text.contains("initial state first \"first\""), "{text}");
    let read = chart::read(FileId(0), &parse_chart(FileId(0), &text)).1;
    assert!(read.is_empty(), "{text}: {read:?}");
    assert!(refused(LAMP, "lamp", Operation::Add(fresh(FreshKind::Sensor, "x"))).contains("belong to a system"));
    assert_eq!(refused(LAMP, "other", Operation::Delete(vec![])), "the chart has no machine or system `other`");
}

#[test]
fn shapes_say_other_things() {
    let name = || "on".to_string();
    check(LAMP, Operation::Text(name(), Some("Bright".into())), &["-\tstate on \"On\"", "+\tstate on \"Bright\""]);
    check(LAMP, Operation::Text(name(), None), &["-\tstate on \"On\"", "+\tstate on"]);
    check(LAMP, Operation::Link(name(), Some("ON".into())), &["-\tstate on \"On\"", "+\tstate on \"On\" {ON}"]);
    check(
        LAMP,
        Operation::Refine("pressed".into(), Some(Some("button".into()))),
        &["-\tguard pressed \"Pressed\"", "+\tguard pressed \"Pressed\" to refine by button"],
    );
    check(
        LAMP,
        Operation::Initial(name()),
        &[
            "-\tinitial state off \"Off\" // dark",
            "-\tstate on \"On\"",
            "+\tstate off \"Off\" // dark",
            "+\tinitial state on \"On\"",
        ],
    );
    // There and back again.
    for operation in [
        (Operation::Link(name(), Some("ON".into())), Operation::Link(name(), None)),
        (Operation::Refine("count".into(), Some(None)), Operation::Refine("count".into(), None)),
        (Operation::Initial(name()), Operation::Initial("off".into())),
    ] {
        assert_eq!(after(&after(LAMP, "lamp", operation.0), "lamp", operation.1), LAMP);
    }
    assert_eq!(
        refused(LAMP, "lamp", Operation::Link(name(), Some("a } state b".into()))),
        "`a } state b` is no term or rule of AsmetaL"
    );
    assert!(refused(LAMP, "lamp", Operation::Link(name(), Some("/* ".into()))).contains("no term"));
}

#[test]
fn names_change_wherever_they_stand() {
    let text = LAMP.replace("guard pressed \"Pressed\"", "guard pressed \"Pressed\" {pressed}")
        + "\nlayout lamp\n\tpressed at 1, 2\nendlayout\n";
    let renamed = after(&text, "lamp", Operation::Rename("pressed".into(), "pushed".into()));
    let expect = text.replace("guard pressed", "guard pushed").replace("-> pressed", "-> pushed");
    assert_eq!(renamed, expect.replace("pressed no", "pushed no").replace("pressed at", "pushed at"));
    assert_eq!(refused(&text, "lamp", Operation::Rename("pressed".into(), "on".into())), "`on` is there already");
    assert!(refused(&text, "lamp", Operation::Rename("pressed".into(), "state".into())).contains("is no name"));
    let system = "chart P\nsystem p\n\tcomponent a synchronous period 1 ms\n\t\telaborate q 0.1 ms\n\t\twrite q\n\tendcomponent\n\
                  \tcomponent b asynchronous awaits q\n\t\tread q as q2\n\tendcomponent\n\tchannel q from a to b queue 2\nendsystem\n";
    let renamed = after(system, "p", Operation::Rename("q".into(), "codes".into()));
    let expect =
        system.replace("write q", "write codes").replace("awaits q", "awaits codes").replace("read q", "read codes");
    assert_eq!(renamed, expect.replace("channel q", "channel codes"));
    let renamed = after(system, "p", Operation::Rename("a".into(), "reader".into()));
    assert_eq!(renamed, system.replace("component a", "component reader").replace("from a", "from reader"));
}

#[test]
fn what_is_not_moved_stays() {
    let places = BTreeMap::from([("off".to_string(), (1.0, 2.0)), ("on".to_string(), (3.0, 4.0))]);
    let operation = Operation::Move(BTreeMap::from([("off".to_string(), (10.0, -20.0))]));
    let once = drawn(LAMP, "lamp", &operation, &places).expect("moved").edit.expect("changed");
    let once = crate::edited(LAMP, &[once]);
    assert!(once.ends_with("\nlayout lamp\n\toff at 10, -20\n\ton at 3, 4\nendlayout\n"), "{once}");
    let again = drawn(&once, "lamp", &operation, &places).expect("moved");
    assert_eq!(again.edit, None);
    let far = refused(&once, "lamp", Operation::Move(BTreeMap::from([("off".to_string(), (f64::NAN, 0.0))])));
    assert_eq!(far, "a place is two numbers of pixels");
}

#[test]
fn systems_are_drawn() {
    let text = "chart Pan\n\nsystem pan \"Pan\"\n\ttick 0.1 ms\n\tcomponent sense synchronous period 1 ms\n\t\telaborate look 0.1 ms\n\
                \tendcomponent\nendsystem\n";
    let text = after(text, "pan", Operation::Add(fresh(FreshKind::Component, "Control law")));
    let text = after(&text, "pan", Operation::Add(fresh(FreshKind::Actuator, "Motor")));
    let text = after(&text, "pan", Operation::Connect(joint("sense", None, "controlLaw")));
    let text = after(&text, "pan", Operation::Connect(joint("controlLaw", None, "motor")));
    let faults = chart::read(FileId(0), &parse_chart(FileId(0), &text)).1;
    assert!(faults.is_empty(), "{text}: {faults:?}");
    assert!(text.contains("\t\telaborate look 0.1 ms\n\t\twrite senseToControlLaw\n"), "{text}");
    assert!(text.contains("\t\tread senseToControlLaw\n\t\telaborate work 1 ms\n"), "{text}");
    let text = after(&text, "pan", Operation::Delete(vec!["controlLaw".to_string()]));
    assert!(!text.contains("ontrolLaw"), "{text}");
    let faults = chart::read(FileId(0), &parse_chart(FileId(0), &text)).1;
    assert!(faults.is_empty(), "{text}: {faults:?}");
}
