//! What `chart check --prove` says of guards that are to be refined: the answer of the machine in a guard's place has to be the guard's.

#![allow(clippy::disallowed_methods, reason = "a test runs the command on files")]

use std::fs;
use std::path::Path;
use std::process::Command;

const CHART: &str = r#"chart Gate

machine gate "Gate"
	control phase
	initial state shut "Shut"
	state open "Open"
	guard asked "Asked" to refine by asking
	guard passed "Passed"
	action count "COUNT"
	shut -> asked yes -> count -> open
	asked no -> shut
	open -> passed yes -> shut
endmachine

pattern asking "Ask twice"
	control ask
	state first "First"
	state second "Second"
	guard wanted "Wanted"
	guard still "Still wanted" {wanted}
	action note "NOTE"
	enter -> note -> first
	first -> wanted yes -> second
	wanted no -> exit no
	second -> still yes -> exit yes
	still no -> exit no
endpattern
"#;

const COUNT: &str = "pieces := (pieces + 1) mod 3";

fn said(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_groundstate")).args(arguments).current_dir(folder).output();
    let output = output.expect("it starts");
    let text = format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    (output.status.code(), text)
}

/// The model of the chart, with a counter; `rules` are what its rules do.
fn prepare(folder: &Path, chart: &str, rules: &[(&str, &str)]) {
    let build = |chart: &str| {
        fs::write(folder.join("Gate.chart"), chart).expect("it is written");
        let (code, text) = said(folder, &["chart", "build", "Gate.chart"]);
        assert_eq!(code, Some(0), "{text}");
    };
    let _ = fs::remove_file(folder.join("Gate.asm"));
    // What the chart's links name comes first.
    let links = ["{not (pieces < 2)}", "{pieces < 2}", "{pieces < 1}"];
    build(&links.iter().fold(chart.to_string(), |chart, link| chart.replace(link, "")));
    let model = fs::read_to_string(folder.join("Gate.asm")).expect("the model");
    let mut model = model
        .replacen("signature:\n", "signature:\n\tdomain Count subsetof Integer\n\tcontrolled pieces: Count\n", 1)
        .replacen("definitions:\n", "definitions:\n\tdomain Count = {0 : 2}\n", 1)
        .replacen("default init s0:\n", "default init s0:\n\tfunction pieces = 0\n", 1);
    for (rule, does) in rules {
        let with = format!("rule {rule} = {does}\n");
        assert!(model.contains(&format!("rule {rule} = skip\n")), "{rule}: {model}");
        model = model.replace(&format!("rule {rule} = skip\n"), &with);
    }
    fs::write(folder.join("Gate.asm"), model).expect("it is written");
    build(chart);
}

fn check(folder: &Path, options: &[&str], code: i32, says: &[&str]) -> String {
    let (found, text) = said(folder, &[&["chart", "check", "Gate.chart"], options].concat());
    assert_eq!(found, Some(code), "{text}");
    for wanted in says {
        assert!(text.contains(wanted), "{wanted}: {text}");
    }
    assert!(code == 0 || !text.contains("proved ("), "{text}");
    text
}

fn temporary(test: impl FnOnce(&Path)) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    test(folder.path());
}

const PROVE: [&str; 1] = ["--prove"];

#[test]
fn what_only_the_guard_asked_for_is_what_the_pattern_answers() {
    temporary(|folder| {
        prepare(folder, CHART, &[("r_count", COUNT)]);
        let command =
            "`asked`, to refine by `asking`: refined, not proved; `groundstate chart check Gate.chart --prove` looks";
        check(folder, &[], 0, &[command]);
        check(folder, &PROVE, 0, &["to refine by `asking`: proved (", "observed pieces, phase)"]);
        // What is observed must not change on the way.
        prepare(folder, CHART, &[("r_count", COUNT), ("r_note", "pieces := 0")]);
        let run = ["refuted, nothing matches step", "in asked = true", "askAnswer", "input asked is false"];
        let run = run.map(|line| line.replace("askAnswer", "askingAnswer"));
        check(folder, &PROVE, 1, &run.each_ref().map(String::as_str));
    });
}

#[test]
fn a_guard_over_the_state_is_what_the_pattern_has_to_answer() {
    let over = CHART.replace("guard asked \"Asked\"", "guard asked \"Asked\" {pieces < 2}");
    // It looks in a step of its own.
    let looks = |yes: &str, no: &str| {
        let pattern = format!(
            "pattern asking \"Look\"\n\tcontrol ask\n\tstate first \"First\"\n\tguard few \"Few\" {{pieces < 2}}\n\
             \taction note \"NOTE\"\n\tenter -> note -> first\n\tfirst -> few yes -> exit {yes}\n\tfew no -> exit {no}\n\
             endpattern\n"
        );
        format!("{}{pattern}", over.split("pattern").next().expect("the machine"))
    };
    let rules = [("r_count", COUNT)];
    let still = [("r_count", COUNT), ("r_note", "if pieces = 1 then pieces := 2 endif")];
    temporary(|folder| {
        prepare(folder, &looks("yes", "no"), &rules);
        check(folder, &PROVE, 0, &["proved (", "observed pieces, phase)"]);
        // The answers are exchanged.
        prepare(folder, &looks("no", "yes"), &rules);
        let run = ["refuted, nothing matches step", "askingAnswer: undef -> false", "phase: ASKED -> SHUT"];
        check(folder, &PROVE, 1, &run);
        // An answer that leads back to where the machine was is an answer, not waiting.
        let wrong = ["refuted, nothing matches step", "abstract.askedSaid = concrete.askedSaid"];
        check(folder, &["--prove", "--allow-waiting"], 1, &wrong);
        // What the guard is about is changed before the pattern looks at it.
        prepare(folder, &looks("yes", "no"), &still);
        check(folder, &PROVE, 1, &["refuted, nothing matches step", "pieces: 1 -> 2"]);
        // It answers by something else.
        let other = looks("yes", "no").replace("guard few \"Few\" {pieces < 2}", "guard few \"Few\" {pieces < 1}");
        prepare(folder, &other, &rules);
        check(folder, &PROVE, 1, &["refuted, nothing matches step"]);
    });
}

#[test]
fn an_input_that_the_pattern_reads_itself_stays_one() {
    // The guard's own input, sampled where the pattern is entered.
    let pattern = |yes: &str, no: &str| {
        format!(
            "pattern asking \"Sample\"\n\tcontrol ask\n\tstate was \"Was\"\n\tstate wasNot \"Was not\"\n\
             \tguard now \"Now\" {{asked}}\n\tenter -> now yes -> was\n\tnow no -> wasNot\n\twas -> exit {yes}\n\
             \twasNot -> exit {no}\nendpattern\n"
        )
    };
    let chart =
        |yes: &str, no: &str| format!("{}{}", CHART.split("pattern").next().expect("the machine"), pattern(yes, no));
    temporary(|folder| {
        prepare(folder, &chart("yes", "no"), &[("r_count", COUNT)]);
        check(folder, &PROVE, 0, &["proved ("]);
        prepare(folder, &chart("no", "yes"), &[("r_count", COUNT)]);
        check(folder, &PROVE, 1, &["refuted, nothing matches step", "input asked is "]);
        // Something else reads it, and the pattern does not: it answers by another input.
        let elsewhere = CHART.replace("guard passed \"Passed\"", "guard passed \"Passed\" {asked}");
        prepare(folder, &elsewhere, &[("r_count", COUNT)]);
        check(folder, &PROVE, 1, &["refuted, nothing matches step"]);
    });
}

#[test]
fn a_guard_with_one_exit_waits_for_it() {
    let waits = CHART.replace("\tasked no -> shut\n", "");
    temporary(|folder| {
        // Another machine goes on meanwhile, and the gate may wait as long as the pattern is at work.
        let beside = "\nmachine clock \"Clock\"\n\tcontrol hand\n\tinitial state tick \"Tick\"\n\tstate tock \"Tock\"\n\ttick -> tock -> tick\nendmachine\n";
        prepare(folder, &format!("{waits}{beside}"), &[("r_count", COUNT)]);
        check(folder, &PROVE, 0, &["proved (", "observed pieces, phase, hand)"]);
        // With two exits it would have to choose one of them at once.
        prepare(folder, &format!("{CHART}{beside}"), &[("r_count", COUNT), ("r_note", "pieces := 0")]);
        check(folder, &PROVE, 1, &["refuted"]);
        let turned = waits.replace("asked yes -> count", "asked no -> count");
        prepare(folder, &format!("{turned}{beside}"), &[("r_count", COUNT)]);
        check(folder, &PROVE, 0, &["proved ("]);
        prepare(folder, &format!("{turned}{beside}"), &[("r_count", COUNT), ("r_note", COUNT)]);
        check(folder, &PROVE, 1, &["refuted"]);
    });
}

#[test]
fn guards_of_machines_with_parameters_and_of_composite_states_are_replaced_too() {
    let over = CHART
        .replace("machine gate", "machine gate ($g in Gate)")
        .replace("pattern asking", "pattern asking ($g in Gate)")
        .replace("{wanted}", "{wanted($g)}");
    temporary(|folder| {
        fs::write(folder.join("Gate.chart"), &over).expect("it is written");
        let (code, text) = said(folder, &["chart", "build", "Gate.chart"]);
        assert_eq!(code, Some(0), "{text}");
        check(folder, &PROVE, 0, &["proved (", "observed phase; whether it can always be left was not looked at)"]);
    });
    let composite = CHART
        .replace("\tstate open", "\tendstate\n\tstate open")
        .replace(
            "\tguard asked \"Asked\" to refine by asking\n",
            "\tstate night \"Night\"\n\tguard dark \"Dark\"\n\tday -> dark yes -> night\n",
        )
        .replace(
            "\tinitial state shut",
            "\tinitial composite state day \"Day\"\n\tguard asked \"Asked\" to refine by asking\n\tinitial state shut",
        );
    temporary(|folder| {
        prepare(folder, &composite, &[("r_count", COUNT)]);
        check(folder, &PROVE, 0, &["proved (", "observed pieces, phase)"]);
        prepare(folder, &composite, &[("r_count", COUNT), ("r_note", COUNT)]);
        check(folder, &PROVE, 1, &["refuted"]);
    });
}

/// Of a guard with one exit the other answer is waiting, which the chart's machine does only where its guard says so.
#[test]
fn an_answer_without_an_exit_is_waiting_only_where_the_guard_waits() {
    let over = |asked: &str, branch: &str, few: &str| {
        format!(
            "chart Gate\n\nmachine gate \"Gate\"\n\tcontrol phase\n\tinitial state shut\n\tstate open\n\
             \tguard asked \"Asked\" {{{asked}}} to refine by asking\n\taction count \"COUNT\"\n\
             \tshut -> asked {branch} -> open\n\topen -> count -> shut\nendmachine\n\n\
             pattern asking \"Look\"\n\tcontrol ask\n\tstate first\n\tguard few {{{few}}}\n\
             \tenter -> first -> few yes -> exit yes\n\tfew no -> exit no\nendpattern\n"
        )
    };
    let rules = [("r_count", COUNT)];
    let never = "refuted, there is a state from which it is never left, though `pieces < 2` is always true";
    temporary(|folder| {
        // With two pieces, both wait for ever.
        prepare(folder, &over("pieces < 2", "yes", "pieces < 2"), &rules);
        check(folder, &PROVE, 0, &["proved (", "observed pieces, phase)"]);
        // With one piece, the guard says yes and the pattern no.
        prepare(folder, &over("pieces < 2", "yes", "pieces < 1"), &rules);
        check(folder, &PROVE, 1, &[never]);
        check(folder, &["--prove", "--allow-waiting"], 1, &[never]);
        // The exit may be that of the other answer.
        prepare(folder, &over("not (pieces < 2)", "no", "not (pieces < 2)"), &rules);
        check(folder, &PROVE, 0, &["proved ("]);
        prepare(folder, &over("not (pieces < 2)", "no", "pieces < 2"), &rules);
        let never = "refuted, there is a state from which it is never left, though `not (pieces < 2)` is always false";
        check(folder, &PROVE, 1, &[never]);
    });
}

#[test]
fn what_never_answers_is_refuted() {
    let never = CHART
        .replace("exit yes\n", "second\n")
        .replace("exit no\n", "first\n")
        .replace("endpattern", "\tguard never \"Never\" {false}\n\tguard nor \"Nor\" {false}\n\tfirst -> never yes -> exit yes\n\tsecond -> nor yes -> exit no\nendpattern");
    temporary(|folder| {
        prepare(folder, &never, &[("r_count", COUNT)]);
        check(folder, &PROVE, 1, &["refuted, the concrete machine goes on for ever"]);
        // That waiting ends is not taken for granted where it cannot.
        let stuck = ["refuted, there is a state from which it is never left", "ask: undef -> FIRST"];
        check(folder, &["--prove", "--allow-waiting"], 1, &stuck);
        let once = CHART.replace("second -> still yes -> exit yes", "second -> still yes -> exit no").replace(
            "\tstill no -> exit no\n",
            "\tstill no -> exit no\n\tguard never \"Never\" {false}\n\tstate third\n\tfirst -> never yes -> third -> exit yes\n",
        );
        prepare(folder, &once, &[("r_count", COUNT)]);
        check(folder, &["--prove"], 0, &["observed pieces, phase; it never answers yes)"]);
    });
}

#[test]
fn what_does_not_fit_is_open_and_warned_of() {
    let open = |chart: &str, says: &[&str]| {
        temporary(|folder| {
            prepare(folder, chart, &[]);
            let text = check(folder, &PROVE, 0, says);
            assert!(!text.contains("proved ("), "{text}");
        });
    };
    let plain = CHART.replace("exit yes", "exit").replace("exit no", "exit");
    open(
        &plain,
        &[
            "open, a guard has two exits, and asking is left without an answer",
            "warning[unfit-refinement]: `asked` cannot be refined by `asking`",
            "let the paths of the pattern end at `exit yes` and `exit no`",
        ],
    );
    let action = CHART
        .replace("\"Asked\" to refine by asking", "\"Asked\"")
        .replace("action count \"COUNT\"", "action count \"COUNT\" to refine by asking");
    open(&action, &["open, asking answers yes or no, and an action has one way on", "warning[unfit-refinement]"]);
    let within = CHART.replace("action note \"NOTE\"", "action note \"NOTE\" to refine by asking");
    open(
        &within.replace("\"Asked\" to refine by asking", "\"Asked\""),
        &["cannot be refined by `asking`: the pattern leads back to `asking`: asking"],
    );
    open(&CHART.replace("by asking", "by askin"), &["open, there is no pattern askin", "did you mean `asking`?"]);
    open(&CHART.replace("by asking", "by gate"), &["open, gate is a machine, which is never left"]);
}

#[test]
fn pictures_tell_what_a_pattern_answers() {
    temporary(|folder| {
        let drawn = |chart: &str, machine: &str| {
            prepare(folder, chart, &[]);
            let (code, text) = said(folder, &["chart", "draw", "Gate.chart", "--machine", machine, "-o", "gate.svg"]);
            assert_eq!(code, Some(0), "{text}");
            fs::read_to_string(folder.join("gate.svg")).expect("a picture")
        };
        let words = |picture: &str| (picture.matches(">yes<").count(), picture.matches(">no<").count());
        // Those of the guards, and those of the exits.
        assert_eq!(words(&drawn(CHART, "asking")), (2 + 1, 2 + 2));
        assert!(drawn(CHART, "gate").contains("style=\"stroke-dasharray:14 3\""));
        // The block has the exits of the guard.
        let block = CHART.replace("guard asked \"Asked\" to refine by asking", "instance asked of asking \"Asked\"");
        assert_eq!(words(&drawn(&block, "gate")), (2, 1));
    });
}
