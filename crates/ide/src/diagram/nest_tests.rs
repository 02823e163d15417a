//! Shapes that are put into composite states and taken out, and what becomes of texts.

use super::*;

const CARRIER: &str = "chart Carrier

machine carrier
	control mode
	initial state stopped \"Stopped\" // at rest
	state lost
	composite state working \"Working\"
		history
		initial state empty
		// what it holds
		state loaded {FULL} // up to 3 kg
		guard grasped
		empty -> grasped yes -> loaded
	endstate
	guard started
	stopped -> started yes -> working
endmachine
";

fn after(text: &str, ids: &[&str], into: Option<&str>) -> Result<String, String> {
    let ids = ids.iter().map(|id| id.to_string()).collect();
    let drawn =
        drawn(text, "carrier", &Operation::Nest(ids, into.map(str::to_string), BTreeMap::new()), &BTreeMap::new())?;
    let edits: Vec<Edit> = drawn.edit.into_iter().collect();
    Ok(crate::edited(text, &edits))
}

/// The lines of the chart that differ, with their blanks, in the order of the text.
#[track_caller]
fn check(ids: &[&str], into: Option<&str>, expect: &[&str]) {
    let text = after(CARRIER, ids, into).expect("it can be done");
    let (old, new): (Vec<&str>, Vec<&str>) = (CARRIER.lines().collect(), text.lines().collect());
    let gone = old.iter().filter(|line| !new.contains(line)).map(|line| format!("-{line}"));
    let come = new.iter().filter(|line| !old.contains(line)).map(|line| format!("+{line}"));
    let told: Vec<String> = gone.chain(come).collect();
    assert_eq!(told, expect, "{text}");
    assert_eq!(old.len(), new.len(), "{text}");
}

#[test]
fn shapes_go_into_a_composite_state_and_out_of_it() {
    check(&["lost"], Some("working"), &["-\tstate lost", "+\t\tstate lost"]);
    check(&["loaded"], None, &["-\t\tstate loaded {FULL} // up to 3 kg", "+\tstate loaded {FULL} // up to 3 kg"]);
    check(&["started"], Some("working"), &["-\tguard started", "+\t\tguard started"]);
    check(
        &["lost", "started"],
        Some("working"),
        &["-\tstate lost", "-\tguard started", "+\t\tstate lost", "+\t\tguard started"],
    );
    // Where they are already, nothing changes.
    check(&["lost"], None, &[]);
    check(&["loaded"], Some("working"), &[]);
}

#[test]
fn each_level_keeps_an_initial_state() {
    // The machine goes on starting in what now holds its initial state; the composite state keeps its own.
    check(
        &["stopped"],
        Some("working"),
        &[
            "-\tinitial state stopped \"Stopped\" // at rest",
            "-\tcomposite state working \"Working\"",
            "+\tinitial composite state working \"Working\"",
            "+\t\tstate stopped \"Stopped\" // at rest",
        ],
    );
    // What is left begins somewhere else.
    check(
        &["empty"],
        None,
        &[
            "-\t\tinitial state empty",
            "-\t\tstate loaded {FULL} // up to 3 kg",
            "+\tstate empty",
            "+\t\tinitial state loaded {FULL} // up to 3 kg",
        ],
    );
}

#[test]
fn a_composite_state_goes_with_all_that_it_holds() {
    let outer = CARRIER.replace("\tstate lost\n", "\tcomposite state outer\n\t\tinitial state lost\n\tendstate\n");
    let inside = after(&outer, &["working"], Some("outer")).expect("it can be done");
    assert!(
        inside.contains("\t\tcomposite state working \"Working\"\n\t\t\thistory\n\t\t\tinitial state empty\n"),
        "{inside}"
    );
    assert!(inside.contains("\t\t\t// what it holds\n\t\t\tstate loaded"), "{inside}");
    assert!(inside.contains("\t\t\tempty -> grasped yes -> loaded\n\t\tendstate\n\tendstate\n"), "{inside}");
    // And out again; only the order is another.
    let back = after(&inside, &["working"], None).expect("it can be done");
    let sorted = |text: &str| -> Vec<String> {
        let mut lines: Vec<String> = text.lines().map(str::to_string).collect();
        lines.sort();
        lines
    };
    assert_eq!(sorted(&back), sorted(&outer), "{back}");
    assert!(after(&inside, &["outer"], Some("working")).expect_err("a circle").contains("into itself"));
    assert!(after(&inside, &["outer"], Some("outer")).expect_err("a circle").contains("into itself"));
}

#[test]
fn what_cannot_be_is_refused() {
    let entry = CARRIER.replace("\t\thistory\n", "\t\thistory\n\t\tentry lamp\n");
    assert!(after(&entry, &["lamp"], None).expect_err("an action").contains("stays there"));
    assert!(after(CARRIER, &["lost"], Some("stopped")).expect_err("no frame").contains("no composite state"));
    assert!(after(CARRIER, &["nobody"], Some("working")).expect_err("nobody").contains("no shape"));
    let alone = after(CARRIER, &["loaded"], None).expect("one stays");
    assert!(after(&alone, &["empty"], None).expect_err("none stays").contains("would hold no state"));
}

#[test]
fn a_composite_state_is_drawn_with_a_state_in_it() {
    let fresh = Fresh {
        kind: FreshKind::Composite,
        name: None,
        text: Some("Moving".to_string()),
        link: None,
        of: None,
        at: (10.0, 20.0),
    };
    let drawn = drawn(CARRIER, "carrier", &Operation::Add(fresh), &BTreeMap::new()).expect("it can be done");
    let text = crate::edited(CARRIER, &drawn.edit.into_iter().collect::<Vec<_>>());
    assert_eq!(drawn.select, ["moving"]);
    let lines = "\tendstate\n\tcomposite state moving \"Moving\"\n\t\tinitial state begun\n\tendstate\n\tguard started";
    assert!(text.contains(lines), "{text}");
    // The frame has no place of its own.
    assert!(text.contains("begun at 10, 20") && !text.contains("moving at"), "{text}");
}
