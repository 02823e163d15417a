//! The ends of channels and what phases are about, and what becomes of texts.

use super::*;

const SYSTEM: &str = "chart S

system s
	tick 0.5 ms
	component look synchronous period 10 ms
		elaborate scan 2 ms
		write seen as give 0.5 ms // out
	endcomponent
	component plan synchronous period 20 ms
		read seen 0.5 ms
		elaborate think 3 ms
		write route
	endcomponent
	component act synchronous period 5 ms
		read route
		elaborate move 1 ms
	endcomponent
	component log synchronous period 50 ms
		read route 1 ms
		elaborate keep 1 ms
	endcomponent
	channel seen from look to plan swinging buffer 2 master look
	channel route from plan to act, log queue 4
endsystem
";

fn after(operation: &Operation) -> Result<String, String> {
    let drawn = drawn(SYSTEM, "s", operation, &BTreeMap::new())?;
    let edits: Vec<Edit> = drawn.edit.into_iter().collect();
    Ok(crate::edited(SYSTEM, &edits))
}

/// The lines that differ, in the order of the text.
#[track_caller]
fn check(operation: &Operation, expect: &[&str]) {
    let text = after(operation).expect("it can be done");
    let (old, new): (Vec<&str>, Vec<&str>) = (SYSTEM.lines().collect(), text.lines().collect());
    let gone = old.iter().filter(|line| !new.contains(line)).map(|line| format!("-{}", line.trim()));
    let come = new.iter().filter(|line| !old.contains(line)).map(|line| format!("+{}", line.trim()));
    let told: Vec<String> = gone.chain(come).collect();
    assert_eq!(told, expect, "{text}");
}

fn redirect(from: &str, to: &str, new_from: &str, new_to: &str) -> Operation {
    let joint = |from: &str, to: &str| Joint { from: from.to_string(), branch: None, to: to.to_string() };
    Operation::Redirect(joint(from, to), joint(new_from, new_to))
}

fn set(id: &str, property: Property, value: &str) -> Operation {
    Operation::Set(id.to_string(), property, Some(value.to_string()))
}

#[test]
fn another_component_writes_a_channel_with_the_phase_of_the_first() {
    let expect = [
        "-write seen as give 0.5 ms // out",
        "-channel seen from look to plan swinging buffer 2 master look",
        "+write seen as give 0.5 ms",
        "+channel seen from log to plan swinging buffer 2 master log",
    ];
    check(&redirect("look", "seen", "log", "seen"), &expect);
    check(&set("seen", Property::Writer, "log"), &expect);
    let text = after(&set("seen", Property::Writer, "log")).expect("it can be done");
    assert!(text.contains("\t\telaborate keep 1 ms\n\t\twrite seen as give 0.5 ms\n\tendcomponent"), "{text}");
}

#[test]
fn another_component_reads_a_channel_with_the_phase_of_the_first() {
    check(
        &redirect("route", "log", "route", "look"),
        &[
            "-read route 1 ms",
            "-channel route from plan to act, log queue 4",
            "+read route 1 ms",
            "+channel route from plan to act, look queue 4",
        ]
        .into_iter()
        .filter(|line| !line.contains("read route"))
        .collect::<Vec<_>>(),
    );
    let text = after(&redirect("route", "log", "route", "look")).expect("it can be done");
    assert!(text.contains("\t\tread route 1 ms\n\t\telaborate scan 2 ms"), "{text}");
}

#[test]
fn a_phase_reads_another_channel() {
    // It is a reader there; of the old channel it is none any more.
    check(
        &set("log", Property::PhaseSubject(0), "seen"),
        &[
            "-read route 1 ms",
            "-channel seen from look to plan swinging buffer 2 master look",
            "-channel route from plan to act, log queue 4",
            "+read seen 1 ms",
            "+channel seen from look to plan, log swinging buffer 2 master look",
            "+channel route from plan to act queue 4",
        ],
    );
    check(&set("log", Property::PhaseSubject(0), "route"), &[]);
}

#[test]
fn what_would_leave_a_channel_without_an_end_is_refused() {
    let refused = |operation: &Operation| after(operation).expect_err("it is refused");
    assert!(refused(&redirect("look", "seen", "plan", "seen")).contains("reads the channel `seen` already"));
    assert!(refused(&redirect("route", "log", "route", "plan")).contains("writes the channel `route`"));
    assert!(refused(&redirect("route", "log", "route", "nobody")).contains("is none"));
    assert!(refused(&redirect("look", "seen", "look", "route")).contains("its other end stays there"));
    assert!(refused(&set("plan", Property::PhaseSubject(0), "route")).contains("writes the channel"));
    assert!(refused(&set("look", Property::PhaseSubject(1), "route")).contains("change its writer first"));
    assert!(refused(&set("look", Property::PhaseSubject(0), "route")).contains("only a reading"));
    assert!(refused(&set("look", Property::PhaseSubject(9), "route")).contains("no phase 10"));
    let alone = SYSTEM.replace("to act, log queue", "to act queue").replace("\t\tread route 1 ms\n", "");
    let drawn = drawn(&alone, "s", &set("act", Property::PhaseSubject(0), "seen"), &BTreeMap::new());
    assert!(drawn.expect_err("nobody is left").contains("nobody would read"));
}
