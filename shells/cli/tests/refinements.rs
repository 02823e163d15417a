//! The refinements of the library: each is proved, each wrong sibling is refuted, and both runs of a refutation are made again by scenarios.

#![allow(clippy::disallowed_methods, reason = "a test runs the command on files")]

use std::path::{Path, PathBuf};
use std::process::Command;

use testkit::solver::solvers;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../library/refinement").canonicalize().expect("the folder")
}

fn check(arguments: &[&str], code: i32, says: &str) {
    let output = Command::new(env!("CARGO_BIN_EXE_groundstate")).args(arguments).current_dir(folder()).output();
    let output = output.expect("it starts");
    let said = format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {said}");
    assert!(said.contains(says), "{arguments:?}: {said}");
}

#[test]
fn each_refinement_is_proved_and_each_wrong_sibling_refuted() {
    let list = std::fs::read_to_string(folder().join("expected.txt")).expect("the list");
    let (mut counts, both) = ([0; 2], solvers(false).len() == 2);
    for line in list.lines().filter(|line| !line.starts_with('#')) {
        let (arguments, expected) = line.split_once(';').expect("arguments; what is expected");
        let arguments: Vec<&str> = std::iter::once("refine").chain(arguments.split_whitespace()).collect();
        match expected.split_once(' ') {
            Some(("refines", pairs)) => check(&arguments, 0, &format!("\n{pairs} pairs of ")),
            Some(("proved" | "unproved", _)) if !both => continue,
            Some(("proved", count)) => {
                check(&arguments, 0, &format!("  proved     by induction: {count} obligations"));
                continue;
            }
            Some(("unproved", name)) => {
                check(&arguments, 3, &format!("not known: the induction fails at `{name}`"));
                continue;
            }
            Some(("refuted", why)) => check(&arguments, 1, &format!("does not refine: {why}")),
            _ => panic!("{line}"),
        }
        counts[usize::from(expected.starts_with("refuted"))] += 1;
    }
    // Each that is searched is there with at least three that it is not.
    assert!(counts[0] >= 4 && counts[1] >= 3 * counts[0], "{counts:?}");
}

#[test]
fn couplings_are_checked_and_are_nothing_else() {
    check(&["check", "."], 0, "Ticks.refine: no faults");
    check(&["run", "Manage.refine"], 2, "Manage.refine is a coupling");
    check(&["fmt", "--check", "."], 0, "");
}

/// The page has both runs on one axis, the charts of both machines, and the part of the coupling that fails; whatever the verdict, it says so.
#[test]
fn a_page_shows_both_runs_and_both_charts() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("it is written");
    let chart = |name: &str, states: &str, paths: &str| {
        format!(
            "chart {name}\nmachine lift \"{name}\" {{r_lift}}\ncontrol floor\ninitial state ground \"Ground\"\n{states}\
             state top \"Top\"\nguard call \"Call\" {{called}}\nguard leave \"Empty\" {{empty}}\n{paths}\
             top -> leave yes -> ground\nendmachine\n"
        )
    };
    let model = |name: &str, literals: &str, rules: &str| {
        format!(
            "asm {name}\nimport StandardLibrary\nsignature:\nenum domain Floor = {{{literals}}}\ncontrolled floor: Floor\n\
             controlled light: Boolean\nmonitored called: Boolean\nmonitored empty: Boolean\ndefinitions:\nrule r_lift = par\n\
             {rules}\nif floor = TOP then if empty then par floor := GROUND light := false endpar endif endif\nendpar\n\
             main rule r_Main = r_lift[]\ndefault init s0:\nfunction floor = GROUND\nfunction light = false\n"
        )
    };
    let at_ground =
        |to: &str| format!("if floor = GROUND then if called then par floor := {to} light := true endpar endif endif");
    write("Lift.chart", &chart("Lift", "", "ground -> call yes -> top\n"));
    write("Lift.asm", &model("Lift", "GROUND | TOP", &at_ground("TOP")));
    write(
        "Slow.chart",
        &chart("Slow", "state moving \"Moving\"\n", "ground -> call yes -> moving\nmoving -> leave no -> top\n"),
    );
    let moving = "if floor = MOVING then if not empty then floor := TOP endif endif";
    write("Slow.asm", &model("Slow", "GROUND | MOVING | TOP", &format!("{}\n{moving}", at_ground("MOVING"))));
    let couple = "couple (abstract.floor = TOP) = (concrete.floor";
    write("Wrong.refine", &format!("{couple} = TOP); same light; allow waiting;"));
    write("Right.refine", &format!("{couple} != GROUND); same light; free abstract.empty; allow waiting;"));
    write("Begin.refine", "same light; couple abstract.floor = TOP and concrete.floor = TOP;");
    let refine = |coupling: &str, page: &str, more: &[&str], code: i32| -> (String, String) {
        let mut arguments = vec!["refine", "Lift.asm", "Slow.asm", "--with", coupling, "--page", page];
        arguments.extend(more);
        let run = Command::new(env!("CARGO_BIN_EXE_groundstate")).args(arguments).current_dir(folder.path()).output();
        let run = run.expect("it starts");
        let said = format!("{}{}", String::from_utf8_lossy(&run.stdout), String::from_utf8_lossy(&run.stderr));
        assert_eq!(run.status.code(), Some(code), "{coupling}: {said}");
        (said, std::fs::read_to_string(folder.path().join(page)).unwrap_or_default())
    };
    let (said, page) = refine("Wrong.refine", "wrong.html", &[], 1);
    assert!(said.ends_with("wrote wrong.html\n"), "{said}");
    for text in [
        "Does not refine: nothing matches step 1 of the concrete machine.",
        "<code>abstract.light = concrete.light</code> is false",
        "abstract: Lift",
        "concrete: Slow",
        "id=\"abstract-chart-0-",
        "id=\"concrete-chart-0-",
        "data-first=\"1\"",
        ">abstract.floor<",
        ">concrete.light<",
        "<th scope=\"row\"><a class=\"go\" href=\"#timeline\" data-at=\"1\">?:1</a></th>",
        "floor: GROUND -&gt; MOVING",
    ] {
        assert!(page.contains(text), "{text}");
    }
    let (_, page) = refine("Right.refine", "right.html", &[], 0);
    assert!(page.contains("Refines.") && page.contains("observed   ") && !page.contains("id=\"timeline\""));
    let (_, page) = refine("Begin.refine", "begin.html", &[], 1);
    assert!(
        page.contains("Says nothing: no initial states correspond") && page.contains("the abstract machine begins")
    );
    if !solvers(false).is_empty() {
        let (_, page) = refine("Right.refine", "runs.html", &["--method", "bmc", "--depth", "1"], 3);
        assert!(page.contains("Not known") && page.contains("searched before") && !page.contains("all looked at"));
    }
    // The sections alone, for a page of one's own.
    let (said, _) = refine("Wrong.refine", "-", &["--format", "json"], 1);
    assert!(said.contains("\"page\":{\"markup\":\"<section id=\\\"end\\\"") && said.contains("\"charts\":["), "{said}");
    let (said, _) = refine("Right.refine", "-", &[], 2);
    assert!(said.contains("a page goes into a file"), "{said}");
    // What stands beside a model is looked at, and its faults are told.
    write("Slow.report.yaml", "tasks:\n  each: { a: { name: a } }\n  terms: { activity: \"nothing({})\" }\n");
    let (said, _) = refine("Wrong.refine", "none.html", &[], 2);
    assert!(said.contains("nothing") && said.contains("Slow.report.yaml"), "{said}");
}

#[test]
fn each_wrong_sibling_is_refuted_and_its_runs_are_made_again() {
    let runs = tempfile::tempdir().expect("a temporary folder");
    let siblings: [(&str, &[&str], &str, i32, &str); 3] = [
        (
            "Permit",
            &["Permit.asm", "../verification/PermitLineFaulty.asm"],
            "0:1 again and again",
            1,
            "inv_noLostWakeUp",
        ),
        (
            "Queue",
            &["Queue.asm", "../verification/QueueStepsFaulty.asm", "--bound", "fault=PUBLISHES_FIRST"],
            "nothing matches step",
            0,
            "2 passed",
        ),
        (
            "Manage",
            &["ManageAtOnce.asm", "ManageEarly.asm"],
            "`abstract.index = concrete.index` is false",
            0,
            "2 passed",
        ),
    ];
    for (name, models, says, code, again) in siblings {
        let (coupling, into) = (format!("{name}.refine"), runs.path().join(name).display().to_string());
        let mut arguments = vec!["refine"];
        arguments.extend(models);
        arguments.extend(["--with", &coupling, "--counterexample", &into]);
        check(&arguments, 1, says);
        // The model's own invariant ends the run of the semaphore sooner than it goes round.
        check(&["test", &into], code, again);
    }
}

/// Elements that a run has made have no names: a scenario that cannot pick one says so, and so does the command that writes it.
#[test]
fn what_no_scenario_can_say_is_told() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let text = "asm Items\nimport StandardLibrary\nsignature:\ndynamic abstract domain Item\ndomain K subsetof Integer\n\
                controlled k: K\ncontrolled size: Item -> K\ncontrolled got: K\ndefinitions:\ndomain K = {0:3}\n\
                invariant inv_small over got: got < 2\n\
                main rule r_Main = if k < 3 then extend Item with $i do par size($i) := k k := k + 1 endpar\n\
                else choose $i in Item with true do got := size($i) endif\n\
                default init s0: function k = 0 function got = 0\n";
    std::fs::write(folder.path().join("Items.asm"), text).expect("it is written");
    let run = |arguments: &[&str], code: i32| {
        let run = Command::new(env!("CARGO_BIN_EXE_groundstate")).args(arguments).current_dir(folder.path()).output();
        let run = run.expect("it starts");
        let said = format!("{}{}", String::from_utf8_lossy(&run.stdout), String::from_utf8_lossy(&run.stderr));
        assert_eq!(run.status.code(), Some(code), "{arguments:?}: {said}");
        said
    };
    let said = run(&["verify", "Items.asm", "--counterexample", "found"], 1);
    assert!(said.contains("cannot make the whole run again"), "{said}");
    let scenario = std::fs::read_to_string(folder.path().join("found/inv_small.avalla")).expect("a scenario");
    assert!(scenario.contains("// r_Main chooses item!3 for $i here, which no scenario can say\n"), "{scenario}");
    // It is a scenario all the same.
    assert!(!run(&["check", "found/inv_small.avalla"], 0).contains("error"));
}

/// A function that keeps its name and gets another domain is not compared: a reader of *refines* is told.
#[test]
fn what_has_a_name_in_common_alone_is_told_as_left_out() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let model = |name: &str, domain: &str| {
        let text = format!(
            "asm {name}\nimport StandardLibrary\nsignature:\ncontrolled on: Boolean\ncontrolled level: {domain}\ndefinitions:\n\
             main rule r_Main = on := not on\ndefault init s0:\nfunction on = false\n"
        );
        std::fs::write(folder.path().join(format!("{name}.asm")), text).expect("it is written");
    };
    model("One", "Integer");
    model("Two", "Boolean");
    let refine = |arguments: &[&str]| -> String {
        let mut command = Command::new(env!("CARGO_BIN_EXE_groundstate"));
        let run = command.arg("refine").args(arguments).current_dir(folder.path()).output().expect("it starts");
        assert_eq!(run.status.code(), Some(0), "{}", String::from_utf8_lossy(&run.stderr));
        String::from_utf8_lossy(&run.stdout).into_owned()
    };
    let said = refine(&["One.asm", "Two.asm", "--page", "page.html"]);
    let told = "level: Integer in the abstract machine, Boolean in the concrete one";
    assert!(said.contains(&format!("  observed   abstract.on = concrete.on\n  left out   {told}\n")), "{said}");
    let page = std::fs::read_to_string(folder.path().join("page.html")).expect("the page");
    assert!(page.contains(told), "{page}");
    let said = refine(&["One.asm", "Two.asm", "--format", "json"]);
    assert!(said.contains(&format!("\"left_out\":[\"{told}\"]")), "{said}");
    assert!(!refine(&["One.asm", "One.asm"]).contains("left out"));
}

/// What holds of fair runs may hold of none: where the concrete model speaks of fairness, that is said.
#[test]
fn what_comes_along_is_about_fair_runs() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let model = |name: &str, property: &str| {
        let text = format!(
            "asm {name}\nimport StandardLibrary\nimport LTLLibrary\nsignature:\ncontrolled x: Boolean\ndefinitions:\n\
             {property}\nmain rule r_Main = x := not x\ndefault init s0:\nfunction x = true\n"
        );
        std::fs::write(folder.path().join(format!("{name}.asm")), text).expect("it is written");
    };
    model("Ground", "LTLSPEC g(f(x))");
    model("Free", "");
    model("Fair", "JUSTICE x and not x");
    let check = |concrete: &str, is_noted: bool| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_groundstate"));
        let run = command.args(["refine", "Ground.asm", concrete, "--properties"]).current_dir(folder.path()).output();
        let said = String::from_utf8_lossy(&run.expect("it starts").stdout).into_owned();
        assert!(said.contains("holds: g(f(x))"), "{said}");
        let note = "note: formulas are about the fair runs of the concrete machine; `verify` tells whether it has one";
        assert_eq!(said.contains(note), is_noted, "{said}");
    };
    check("Free.asm", false);
    check("Fair.asm", true);
}
