//! What `chart check` says of shapes that are to be refined: a proof is made anew each time, and a machine that does something else is
//! refuted.

#![allow(clippy::disallowed_methods, reason = "a test runs the command on files")]

use std::fs;
use std::path::Path;
use std::process::Command;

const CHART: &str = r#"chart Crane

machine crane "Crane"
	control phase
	initial state waiting "Waiting"
	state loaded "Loaded"
	guard asked "Asked"
	guard taken "Taken"
	action lift "LIFT" to refine by lifting
	action drop "DROP" to refine
	waiting -> asked yes -> lift -> loaded
	loaded -> taken yes -> drop -> waiting
endmachine

pattern lifting "Lift a piece"
	control arm
	state closing "Closing"
	guard closed "Gripper closed"
	action close "CLOSE"
	action raise "RAISE"
	enter -> close -> closing -> closed yes -> raise -> exit
endpattern
"#;

const COUNT: &str = "pieces := (pieces + 1) mod 3";

fn said(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_groundstate")).args(arguments).current_dir(folder).output();
    let output = output.expect("it starts");
    let text = format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    (output.status.code(), text)
}

/// The model of the chart, in which lifting counts pieces: as an action, and in the pattern where it is raised.
fn prepare(folder: &Path, chart: &str, lift: &str, close: &str, raise: &str) {
    fs::write(folder.join("Crane.chart"), chart).expect("it is written");
    let _ = fs::remove_file(folder.join("Crane.asm"));
    let (code, text) = said(folder, &["chart", "build", "Crane.chart"]);
    assert_eq!(code, Some(0), "{text}");
    let model = fs::read_to_string(folder.join("Crane.asm")).expect("the model");
    let mut model = model
        .replacen("signature:\n", "signature:\n\tdomain Count subsetof Integer\n\tcontrolled pieces: Count\n", 1)
        .replacen("definitions:\n", "definitions:\n\tdomain Count = {0 : 2}\n", 1)
        .replacen("default init s0:\n", "default init s0:\n\tfunction pieces = 0\n", 1);
    for (rule, does) in [("r_lift", lift), ("r_close", close), ("r_raise", raise)] {
        for head in [format!("rule {rule} = skip"), format!("rule {rule}($c in Crane) = skip")] {
            let with = head.replace("skip", does);
            model = model.replace(&head, &with);
        }
    }
    fs::write(folder.join("Crane.asm"), model).expect("it is written");
}

fn check(folder: &Path, options: &[&str], code: i32, says: &[&str]) -> String {
    let (found, text) = said(folder, &[&["chart", "check", "Crane.chart"], options].concat());
    assert_eq!(found, Some(code), "{text}");
    for wanted in says {
        assert!(text.contains(wanted), "{wanted}: {text}");
    }
    text
}

const PROVE: [&str; 2] = ["--prove", "--allow-waiting"];

#[test]
fn a_machine_that_does_what_the_action_does_is_proved_when_it_is_asked_for() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    prepare(folder, CHART, COUNT, "skip", COUNT);
    let command =
        "`lift`, to refine by `lifting`: refined, not proved; `groundstate chart check Crane.chart --prove` looks";
    check(folder, &[], 0, &[command, "`drop`, to refine: open, it does not say by what"]);
    let proved = "to refine by `lifting`: proved (";
    check(folder, &PROVE, 0, &[proved, "observed pieces, phase, assumed that waiting ends)"]);
    // Nothing says that the gripper ever closes.
    let text =
        check(folder, &["--prove"], 1, &["refuted, the concrete machine goes on for ever", "add --allow-waiting"]);
    assert!(!text.contains("proved ("), "{text}");
    // What was proved before does not count once something has changed.
    prepare(folder, CHART, COUNT, "skip", "skip");
    let text = check(
        folder,
        &PROVE,
        1,
        &["refuted, nothing matches step", "`concrete.phase != LIFT implies abstract.pieces = concrete.pieces`"],
    );
    assert!(!text.contains("proved ("), "{text}");
    let text = check(folder, &[], 0, &[command]);
    assert!(!text.contains("proved ("), "{text}");
}

/// What nobody comes to could do anything.
#[test]
fn a_proof_of_what_is_never_entered_says_so() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let never = CHART
        .replace("guard asked \"Asked\"", "guard asked \"Asked\" {1 > 2}")
        .replace("lift -> loaded\n", "lift -> loaded\n\tasked no -> loaded\n");
    for raise in [COUNT, "pieces := 2"] {
        prepare(folder, &never, COUNT, "skip", raise);
        check(folder, &PROVE, 0, &["observed pieces, phase, assumed that waiting ends; it is never entered)"]);
    }
    prepare(folder, CHART, COUNT, "skip", COUNT);
    let text = check(folder, &PROVE, 0, &["proved ("]);
    assert!(!text.contains("never entered"), "{text}");
}

#[test]
fn a_machine_that_does_more_or_at_the_wrong_time_is_refuted() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    prepare(folder, CHART, COUNT, COUNT, COUNT);
    check(folder, &PROVE, 1, &["refuted, nothing matches step"]);
    prepare(folder, CHART, "skip", "skip", COUNT);
    check(folder, &PROVE, 0, &["proved (", "observed phase"]);
    // Where the counter is compared it must not change.
    prepare(folder, CHART, "if pieces = 2 then pieces := 0 endif", "skip", COUNT);
    check(folder, &PROVE, 1, &["refuted, nothing matches step"]);
    // It raises again and again until the gripper is open.
    let again = CHART.replace("closed yes -> raise -> exit", "closed yes -> raise -> closing\n\tclosed no -> exit");
    prepare(folder, &again, COUNT, "skip", COUNT);
    check(folder, &PROVE, 1, &["refuted"]);
}

/// That waiting ends is taken for granted of what the environment can end, not of a machine that the pattern has stopped.
#[test]
fn what_stops_a_machine_for_ever_is_refuted() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let chart = "chart Crane

machine door \"Door\"
	control phase
	initial state shut \"Shut\"
	state open \"Open\"
	action unlock \"UNLOCK\" to refine by unlocking
	guard healthy \"Healthy\" {not broken}
	shut -> unlock -> open
	open -> healthy yes -> shut
endmachine

pattern unlocking \"Unlock in two steps\"
	control step
	state half \"Half\"
	action damage \"DAMAGE\" {r_damage[]}
	enter -> damage -> half -> exit
endpattern
";
    let prepare = |damage: &str| {
        let model = format!(
            "asm Crane\n\nimport StandardLibrary\n\nsignature:\n\tcontrolled broken: Boolean\n\n\
             definitions:\n\trule r_damage = {damage}\n\n\
             default init s0:\n\tfunction broken = false\n\tfunction phase = SHUT\n"
        );
        fs::write(folder.join("Crane.chart"), chart).expect("it is written");
        fs::write(folder.join("Crane.asm"), model).expect("it is written");
        let (code, text) = said(folder, &["chart", "build", "Crane.chart"]);
        assert_eq!(code, Some(0), "{text}");
    };
    prepare("skip");
    check(folder, &PROVE, 0, &["proved ("]);
    prepare("broken := true");
    check(folder, &PROVE, 1, &["refuted, there is a state from which door never leaves OPEN", "broken: false -> true"]);
}

#[test]
fn what_the_file_beside_the_chart_assumes_is_assumed_and_told() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    prepare(folder, CHART, COUNT, "if load > 5 then pieces := 0 endif", COUNT);
    let path = folder.join("Crane.asm");
    let model = fs::read_to_string(&path).expect("the model");
    fs::write(&path, model.replacen("signature:\n", "signature:\n\tmonitored load: Integer\n", 1))
        .expect("it is written");
    check(folder, &PROVE, 3, &["not known, in the concrete machine the values of load cannot be enumerated"]);
    let beside = folder.join("Crane.verify.yaml");
    fs::write(&beside, "bounds: { load: 0..3 }\n").expect("it is written");
    check(folder, &PROVE, 0, &["proved (", "assumed load in 0..3, that waiting ends)"]);
    fs::write(&beside, "bounds: { load: 4..7 }\n").expect("it is written");
    check(folder, &PROVE, 1, &["refuted, nothing matches step"]);
    fs::write(&beside, "bounds: { lead: 4..7 }\n").expect("it is written");
    check(folder, &PROVE, 0, &["open, ", "Crane.verify.yaml has faults: bound"]);
}

#[test]
fn a_pattern_of_actions_alone_is_done_in_one_step() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let at_once = "pattern lifting \"Lift a piece\"\n\taction close \"CLOSE\"\n\taction raise \"RAISE\"\n\tenter -> close -> raise -> exit\nendpattern\n";
    let chart = format!("{}{at_once}", CHART.split("pattern").next().expect("the machine"));
    prepare(folder, &chart, COUNT, "skip", COUNT);
    check(folder, &["--prove"], 0, &["proved (6 pairs, observed pieces, phase)"]);
    prepare(folder, &chart, COUNT, "skip", "skip");
    check(folder, &["--prove"], 1, &["refuted"]);
}

#[test]
fn machines_with_parameters_are_replaced_too() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let chart = CHART
        .replace("machine crane", "machine crane ($c in Crane)")
        .replace("pattern lifting", "pattern lifting ($c in Crane)");
    let count = "count($c) := (count($c) + 1) mod 2";
    prepare(folder, &chart, count, "skip", count);
    let path = folder.join("Crane.asm");
    let model = fs::read_to_string(&path).expect("the model");
    let model = model
        .replace("controlled pieces: Count\n", "controlled pieces: Count\n\tcontrolled count: Crane -> Count\n")
        .replace("\tfunction pieces = 0\n", "\tfunction pieces = 0\n\tfunction count($c in Crane) = 0\n");
    fs::write(&path, model).expect("it is written");
    check(folder, &PROVE, 0, &["proved (", "observed count, phase"]);
}

#[test]
fn what_cannot_be_replaced_is_open() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let open = |chart: &str, says: &str| {
        prepare(folder, chart, "skip", "skip", "skip");
        let text = check(folder, &PROVE, 0, &[says]);
        assert!(!text.contains("proved ("), "{text}");
    };
    open(
        &CHART.replace("by lifting", "by raising"),
        "open, there is no pattern raising in the chart, nor in one that it imports",
    );
    open(&CHART.replace("by lifting", "by crane"), "open, crane is a machine, which is never left");
    let guard = CHART.replace("guard asked \"Asked\"", "guard asked \"Asked\" to refine by lifting");
    open(
        &guard.replace("\"LIFT\" to refine by lifting", "\"LIFT\""),
        "open, a guard has two exits, and lifting is left without an answer",
    );
    let other = CHART.replace("pattern lifting", "pattern lifting ($n in Boolean)");
    open(&other, "open, lifting has other parameters than the rule of the action");
}

#[test]
fn nothing_is_proved_of_a_model_that_is_not_the_charts() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    prepare(folder, CHART, COUNT, "skip", COUNT);
    fs::write(
        folder.join("Crane.chart"),
        CHART.replace("loaded -> taken yes -> drop -> waiting", "loaded -> taken no -> drop -> waiting"),
    )
    .expect("it is written");
    check(folder, &PROVE, 1, &["refined, not proved: chart and model differ"]);
    // Half of the model is missing.
    let model = fs::read_to_string(folder.join("Crane.asm")).expect("the model");
    for part in 1..8 {
        fs::write(folder.join("Crane.asm"), &model[..model.len() * part / 8]).expect("it is written");
        let (code, text) = said(folder, &["chart", "check", "Crane.chart", "--prove"]);
        assert!(code != Some(0) && !text.contains("proved ("), "{text}");
    }
}

#[test]
fn an_action_of_a_pattern_is_replaced_where_the_pattern_is_at_work() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let slowly = "pattern slowly \"Raise slowly\"\n\tcontrol height\n\tstate up \"Up\"\n\taction begin \"BEGIN\"\n\t\
                  action finish \"FINISH\"\n\tenter -> begin -> up -> finish -> exit\nendpattern\n";
    let at_work = CHART
        .replace("action lift \"LIFT\" to refine by lifting", "instance lift of lifting \"LIFT\"")
        .replace("action raise \"RAISE\"", "action raise \"RAISE\" to refine by slowly");
    let chart = format!("{at_work}\n{slowly}");
    prepare(folder, &chart, "skip", "skip", COUNT);
    check(folder, &["--prove"], 1, &["`raise`, to refine by `slowly`: refuted, nothing matches step"]);
    let model = fs::read_to_string(folder.join("Crane.asm")).expect("the model");
    fs::write(folder.join("Crane.asm"), model.replace("rule r_finish = skip", &format!("rule r_finish = {COUNT}")))
        .expect("it is written");
    check(folder, &["--prove"], 0, &["`raise`, to refine by `slowly`: proved (", "observed pieces, phase, arm"]);
}

#[test]
fn pictures_tell_what_is_named_from_what_is_open() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    prepare(folder, CHART, "skip", "skip", "skip");
    let (code, text) = said(folder, &["chart", "draw", "Crane.chart", "--machine", "crane", "-o", "crane.svg"]);
    assert_eq!(code, Some(0), "{text}");
    let picture = fs::read_to_string(folder.join("crane.svg")).expect("a picture");
    let dashed = picture.matches(" refine\"").count();
    assert_eq!((dashed, picture.matches("style=\"stroke-dasharray:14 3\"").count()), (2, 1), "{picture}");
}
