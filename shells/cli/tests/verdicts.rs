//! Verdicts that rest on more than one search, or on more than one file.

#![allow(clippy::disallowed_methods, reason = "a test runs the command on files")]

use std::path::Path;
use std::process::Command;

/// The exit code, and what is said on stdout.
fn said(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_groundstate")).args(arguments).current_dir(folder).output();
    let output = output.expect("it starts");
    (output.status.code(), String::from_utf8_lossy(&output.stdout).to_string())
}

/// The lines that begin with a word.
fn lines<'t>(text: &'t str, word: &str) -> Vec<&'t str> {
    text.lines().filter(|line| line.starts_with(word)).collect()
}

#[test]
fn what_is_drawn_is_decided_without_what_the_machines_decide() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/press_cell");
    let whole = ["verify", "PressCell.chart", "--data"];
    // Some 150 states are enough for what is drawn, and too few for the data.
    let (code, text) = said(&folder, &[&whole[..], &["--max-states", "1000"]].concat());
    assert_eq!(code, Some(3), "{text}");
    let own = |line: &&&str| line.contains(" inv_") || line.contains(" ctlSpec_");
    let held = lines(&text, "holds");
    assert!(held.iter().all(|line| line.ends_with(" (whatever the machines decide)")), "{text}");
    assert!(held.len() > 10 && held.iter().all(|line| own(&line)), "{text}");
    let open = lines(&text, "unknown");
    assert!(open.len() > 10 && !open.iter().any(|line| own(&line)), "{text}");
    // What an assumption leaves of the runs may end.
    let (_, text) = said(&folder, &[&whole[..], &["--max-states", "1000", "--assume", "not curtain"]].concat());
    assert!(lines(&text, "holds").iter().all(|line| line.contains(" inv_")), "{text}");
    assert!(text.contains("unknown   ctlSpec_works"), "{text}");
    // Too few for what is drawn, too.
    let (_, text) = said(&folder, &[&whole[..], &["--max-states", "20"]].concat());
    assert_eq!(lines(&text, "holds"), [""; 0], "{text}");
}

#[test]
fn what_rests_on_a_file_with_errors_is_not_checked() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("it can be written");
    write(
        "Pair.chart",
        "chart Pair\nsystem pair\n\tcomponent one synchronous period 1 ms\n\t\twrit x 1 ms\n\tendcomponent\nendsystem\n",
    );
    write("Pair.verify.yaml", "invariants: [\"true\"]\n");
    let (code, text) = said(folder.path(), &["check", "Pair.verify.yaml"]);
    assert_eq!(code, Some(1), "{text}");
    assert!(text.ends_with("Pair.verify.yaml: not checked: Pair.chart has errors\n"), "{text}");
    // Those of a file are told once, and not taken for none where they are met again.
    let (code, text) = said(folder.path(), &["check", "."]);
    assert_eq!(code, Some(1), "{text}");
    assert!(text.contains("Pair.verify.yaml: not checked: "), "{text}");
    write("Lamp.asm", "asm Lamp\nimport Missing\nsignature:\ndefinitions:\nmain rule r_Main = skip\n");
    write("Lamp.avalla", "scenario Lamp\nload Lamp.asm\nstep\n");
    let (_, text) = said(folder.path(), &["check", "Lamp.avalla"]);
    assert!(text.contains("Lamp.avalla: not checked: ") && !text.contains("no faults"), "{text}");
}

#[test]
fn a_name_of_a_module_that_building_adds() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("it can be written");
    let chart = "chart Arm\nimport Turns\nsystem arm\n\ttick 1 ms\n\tsensor eye : AgeWay\n\tactuator motor\n\tcomponent look synchronous period 10 ms\n\
                 \t\telaborate see 2 ms\n\t\twrite seen 1 ms\n\tendcomponent\n\tcomponent go synchronous period 10 ms\n\t\tread seen 1 ms\n\
                 \t\telaborate turn 2 ms\n\tendcomponent\n\tchannel seen : AgeWay from look to go shared value\n\teye -> look\n\tgo -> motor\n";
    write("Arm.chart", &format!("{chart}\twithin 40 ms from eye to motor\nendsystem\n"));
    write(
        "Turns.asm",
        "module Turns\nimport StandardLibrary\nexport *\nsignature:\n\tenum domain AgeWay = {SHORT | LONG}\ndefinitions:\n",
    );
    for command in [&["chart", "build", "Arm.chart"][..], &["verify", "Arm.chart"]] {
        let output = Command::new(env!("CARGO_BIN_EXE_groundstate")).args(command).current_dir(folder.path()).output();
        let output = output.expect("it starts");
        let text = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{text}");
        assert!(
            text.contains("error[made-name]: an import declares `AgeWay`, and so does `DataAges` of the library\n"),
            "{text}"
        );
        assert_eq!(text.matches("error[").count(), 1, "{text}");
    }
    // Without a bound on an age nobody else needs the name.
    write("Arm.chart", &format!("{chart}endsystem\n"));
    let (code, text) = said(folder.path(), &["chart", "build", "Arm.chart"]);
    assert_eq!(code, Some(0), "{text}");
}

/// An age bound is decided on each way by itself, if that is enough: an asynchronous task beside the way may take any time then.
#[test]
fn an_age_that_is_proved_on_its_ways() {
    const CHART: &str = "chart Line\n\
    import patterns/ControlTask\n\
    system line\n\
    tick 1 ms\n\
    component eye synchronous period 6 ms\n\
    elaborate look 1 ms\n\
    write marks 1 ms\n\
    write spots 1 ms\n\
    endcomponent\n\
    component mind asynchronous awaits marks\n\
    read marks 1 ms\n\
    elaborate think 2..4 ms\n\
    write turns 1 ms\n\
    endcomponent\n\
    component book asynchronous awaits spots\n\
    read spots 1 ms\n\
    elaborate note 2..7 ms\n\
    endcomponent\n\
    component hand synchronous period 4 ms\n\
    read turns 1 ms\n\
    elaborate turn 1 ms\n\
    endcomponent\n\
    channel marks from eye to mind swinging buffer 2\n\
    channel spots from eye to book swinging buffer 2\n\
    channel turns from mind to hand swinging buffer 2\n\
    within LIMIT ms from eye to hand\n\
    endsystem\n";
    let folder = tempfile::tempdir().expect("a temporary folder");
    let verify = |limit: &str| {
        std::fs::write(folder.path().join("Line.chart"), CHART.replace("LIMIT", limit)).expect("it can be written");
        said(folder.path(), &["verify", "Line.chart"])
    };
    let (code, text) = verify("24");
    let holds =
        "holds     inv_age1_eye_to_hand (each way by itself, for asynchronous elaborations beside it of any length)";
    assert!(code == Some(0) && text.contains(holds), "{text}");
    // Each bound under its own name.
    let (code, text) = verify("24 ms from eye to hand\nwithin 30");
    assert!(code == Some(0) && text.contains(holds) && text.contains(&holds.replace("age1", "age2")), "{text}");
    // Where nobody waits for too long, the responses of the tasks prove it without a search.
    let slow = CHART.replace("period 6 ms", "period 20 ms").replace("period 4 ms", "period 9 ms");
    std::fs::write(folder.path().join("Line.chart"), slow.replace("LIMIT", "99")).expect("it can be written");
    let (code, text) = said(folder.path(), &["verify", "Line.chart"]);
    assert!(
        code == Some(0) && text.contains("holds     inv_age1_eye_to_hand (by the responses of its tasks, at most "),
        "{text}"
    );
    assert!(!text.contains("each way by itself"), "{text}");
    let (code, text) = verify("22");
    assert!(code == Some(1) && text.contains("violated  inv_age1_eye_to_hand, after "), "{text}");
    assert!(!text.contains("by the responses"), "{text}");
    assert!(!text.contains(" inv_age1_eye_to_hand (each way"), "{text}");
}
