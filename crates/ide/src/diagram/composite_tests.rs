//! What is done to composite states as such, and copies of them.

use super::*;

const PRESS: &str = "chart Press

machine press
	control mode
	initial state idle
	composite state working \"Working\" // while it works
		initial state lowering
		composite state paused
			history {before}
			entry dim \"DIM\" {r_dim[]} // the lamp
			initial state still
		endstate
		guard down {position = LOW} to refine
		action note
		lowering -> down yes -> note -> paused
		still -> down no -> idle // out of it
	endstate
	idle -> working
	paused -> still
endmachine

machine other
	control mode
	initial state idle
	state working
endmachine
";

fn after(drawing: &str, operation: &Operation) -> Result<(String, Vec<String>), String> {
    let drawn = drawn(PRESS, drawing, operation, &BTreeMap::new())?;
    let edits: Vec<Edit> = drawn.edit.into_iter().collect();
    Ok((crate::edited(PRESS, &edits), drawn.select))
}

/// The lines that differ.
fn changes(text: &str) -> Vec<String> {
    let (old, new): (Vec<&str>, Vec<&str>) = (PRESS.lines().collect(), text.lines().collect());
    let gone = old.iter().filter(|line| !new.contains(line)).map(|line| format!("-{line}"));
    let come = new.iter().filter(|line| !old.contains(line)).map(|line| format!("+{line}"));
    gone.chain(come).collect()
}

#[track_caller]
fn check(operation: &Operation, expect: &[&str]) {
    let (text, _) = after("press", operation).expect("it can be done");
    assert_eq!(changes(&text), expect, "{text}");
}

#[test]
fn history_comes_and_goes() {
    let history = |name: &str, link: Option<Option<&str>>| {
        Operation::History(name.to_string(), link.map(|link| link.map(str::to_string)))
    };
    check(&history("working", Some(None)), &["+\t\thistory"]);
    check(&history("working", Some(Some("left"))), &["+\t\thistory {left}"]);
    check(&history("working", None), &[]);
    check(&history("paused", Some(None)), &["-\t\t\thistory {before}", "+\t\t\thistory"]);
    check(&history("paused", Some(Some("left($c)"))), &["-\t\t\thistory {before}", "+\t\t\thistory {left($c)}"]);
    check(&history("paused", None), &["-\t\t\thistory {before}"]);
    assert_eq!(after("press", &history("idle", None)), Err("there is no composite state `idle`".to_string()));
    assert!(after("press", &history("working", Some(Some("} state x {")))).is_err());
}

#[test]
fn entries_and_exits_stand_in_order_and_are_changed_like_shapes() {
    let add = |name: &str, moment, text: Option<&str>| {
        Operation::AddDoing(name.to_string(), moment, text.map(str::to_string))
    };
    check(&add("paused", Moment::Entry, Some("Beep twice")), &["+\t\t\tentry beepTwice \"Beep twice\""]);
    check(&add("working", Moment::Exit, None), &["+\t\texit end"]);
    let (text, select) = after("press", &add("paused", Moment::Exit, Some("BRIGHT"))).expect("it can be done");
    assert!(text.contains("// the lamp\n\t\t\texit bright \"BRIGHT\"\n\t\t\tinitial state still"), "{text}");
    assert_eq!(select, ["paused"]);
    assert!(after("press", &add("idle", Moment::Exit, None)).is_err());
    assert!(after("press", &add("none", Moment::Exit, None)).is_err());
    let entry = "\t\t\tentry dim \"DIM\" {r_dim[]} // the lamp";
    let of = |operation: Operation, expect: &str| check(&operation, &[&format!("-{entry}"), &format!("+{expect}")]);
    let (dim, beam) = ("dim".to_string(), "beam".to_string());
    of(Operation::Rename(dim.clone(), beam), "\t\t\tentry beam \"DIM\" {r_dim[]} // the lamp");
    of(Operation::Text(dim.clone(), Some("ON".to_string())), "\t\t\tentry dim \"ON\" {r_dim[]} // the lamp");
    of(Operation::Link(dim.clone(), Some("x := 1".to_string())), "\t\t\tentry dim \"DIM\" {x := 1} // the lamp");
    check(&Operation::Delete(vec![dim]), &[&format!("-{entry}")]);
}

#[test]
fn a_composite_state_is_renamed_wherever_it_is_named() {
    check(
        &Operation::Rename("paused".to_string(), "waiting".to_string()),
        &[
            "-\t\tcomposite state paused",
            "-\t\tlowering -> down yes -> note -> paused",
            "-\tpaused -> still",
            "+\t\tcomposite state waiting",
            "+\t\tlowering -> down yes -> note -> waiting",
            "+\twaiting -> still",
        ],
    );
}

fn source(from: &str, to: &str) -> String {
    let start = PRESS.find(from).expect("it is there");
    PRESS[start..start + PRESS[start..].find(to).expect("it ends") + to.len()].to_string()
}

fn paste(source: String, places: &[(&str, Centre)], arrows: &[(&str, &str)]) -> Operation {
    let places = places.iter().map(|(name, at)| (name.to_string(), *at)).collect();
    let joint = |(from, to): &(&str, &str)| Joint { from: from.to_string(), branch: None, to: to.to_string() };
    Operation::Paste(Vec::new(), vec![Copied { source, places }], arrows.iter().map(joint).collect())
}

#[test]
fn a_composite_state_is_copied_with_all_that_it_holds() {
    let whole = source("composite state working", "// out of it\n\tendstate");
    let (text, select) = after("press", &paste(whole.clone(), &[("still", (10.0, 20.0))], &[("paused", "still")]))
        .expect("it can be done");
    let copy = "\tcomposite state working2 \"Working\" // while it works
		initial state lowering2
		composite state paused2
			history {before}
			entry dim2 \"DIM\" {r_dim[]} // the lamp
			initial state still2
		endstate
		guard down2 {position = LOW} to refine
		action note2
		lowering2 -> down2 yes -> note2 -> paused2
";
    assert!(text.contains(copy), "{text}");
    assert!(text.contains("\tpaused2 -> still2\n") && text.contains("\tstill2 at 10, 20\n"), "{text}");
    assert!(!text.contains("-> idle2") && text.matches("-> idle").count() == 1, "{text}");
    assert_eq!(select, ["working2"]);
    assert_eq!(changes(&text).iter().filter(|line| line.starts_with('-')).count(), 0, "{text}");
    // Into another machine only what is taken there gets another name.
    let (text, _) = after("other", &paste(whole, &[], &[])).expect("it can be done");
    let (before, there) = text.split_once("machine other").expect("it is there");
    assert_eq!(PRESS.split_once("machine other").expect("it is there").0, before);
    assert!(
        there.contains("\tcomposite state working2 \"Working\" // while it works\n\t\tinitial state lowering\n"),
        "{there}"
    );
}

#[test]
fn a_copy_from_deep_within_stands_where_it_comes() {
    let inner = source("composite state paused", "endstate");
    let (text, _) = after("other", &paste(inner, &[], &[])).expect("it can be done");
    let copy = "\tcomposite state paused
		history {before}
		entry dim \"DIM\" {r_dim[]} // the lamp
		initial state still
	endstate
endmachine
";
    assert!(text.contains(copy), "{text}");
}

#[test]
fn nothing_but_a_composite_state_is_pasted_as_one() {
    let sources = [
        "",
        "state x",
        "composite state x\n\tinitial state y\nendstate\nstate z",
        "composite state x\n\tinitial state y\nendstate\nendmachine\nmachine m",
        "composite state x\n\tinitial state y",
        "composite state x\n\tinitial state y {\"\nendstate",
        "composite state x\n\tinitial state y\nendstate /*",
        "composite state",
    ];
    for source in sources {
        let done = after("press", &paste(source.to_string(), &[], &[]));
        assert!(done.is_err(), "{source}: {done:?}");
    }
}
