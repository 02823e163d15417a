//! What newcomers type first: a new folder and the commands of its page, built-in patterns, completions, manual pages.
#![allow(clippy::disallowed_methods, reason = "the test makes the files it gives to the command")]

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

fn groundstate(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_groundstate"));
    command.args(arguments).current_dir(folder).stdin(Stdio::null()).output().expect("it starts")
}

/// Runs a command, checks its exit code and returns its output.
fn check(folder: &Path, arguments: &[&str], code: i32) -> String {
    let output = groundstate(folder, arguments);
    let text = format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {text}");
    text
}

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

/// The commands of a page, indented by four.
fn commands(page: &str) -> Vec<Vec<&str>> {
    let lines = page.lines().filter_map(|line| line.strip_prefix("    groundstate "));
    lines.map(|line| line.split_whitespace().collect()).collect()
}

#[test]
fn a_new_folder_does_what_its_page_says() {
    let above = folder();
    for template in ["machine", "system", "robot"] {
        let name = format!("My_{template}1");
        check(above.path(), &["new", &name, "--template", template], 0);
        let folder = above.path().join(&name);
        let said = check(&folder, &["check", ".", "--strict"], 0);
        assert_eq!(said.lines().count(), said.matches(": no faults").count(), "{said}");
        check(&folder, &["test", "."], 0);
        let page = fs::read_to_string(folder.join("README.md")).expect("a page");
        assert!(!page.contains("NAME"), "{page}");
        let commands = commands(&page);
        assert!(commands.len() >= 5, "{template}: {commands:?}");
        for command in &commands {
            let said = check(&folder, command, 0);
            for word in ["warning", "error", "FAIL", "unknown"] {
                assert!(!said.contains(word), "{command:?}: {said}");
            }
        }
        // Each command with `-o` has written its file.
        for output in commands.iter().filter_map(|c| c.iter().position(|w| *w == "-o").map(|at| c[at + 1])) {
            assert!(folder.join(output).exists(), "{template}: {output}");
        }
        let models = fs::read_dir(&folder).expect("the folder").filter_map(Result::ok);
        let texts = models
            .filter(|entry| entry.path().extension().is_some_and(|e| e == "asm" || e == "avalla" || e == "chart"));
        let texts: Vec<String> = texts.map(|entry| entry.file_name().into_string().expect("a name")).collect();
        let mut command = vec!["fmt", "--check"];
        command.extend(texts.iter().map(String::as_str));
        check(&folder, &command, 0);
    }
}

#[test]
fn a_new_model_is_the_one_that_its_chart_builds() {
    let above = folder();
    for (name, template) in [("Axis", "system"), ("Arm", "robot")] {
        check(above.path(), &["new", name, "--template", template], 0);
        let (folder, model) = (above.path().join(name), format!("{name}.asm"));
        let before = fs::read_to_string(folder.join(&model)).expect("the model");
        check(&folder, &["chart", "build", &format!("{name}.chart")], 0);
        assert_eq!(fs::read_to_string(folder.join(&model)).expect("the model"), before, "{template}");
    }
}

#[test]
fn a_new_folder_overwrites_nothing() {
    let above = folder();
    fs::create_dir(above.path().join("Empty")).expect("a folder");
    check(above.path(), &["new", "Empty"], 0);
    let before = fs::read(above.path().join("Empty/Empty.asm")).expect("the model");
    let said = check(above.path(), &["new", "Empty", "--template", "system"], 2);
    assert!(said.contains("not empty"), "{said}");
    assert_eq!(fs::read(above.path().join("Empty/Empty.asm")).expect("the model"), before);
    assert!(!above.path().join("Empty/Empty.chart").exists());
    fs::write(above.path().join("File"), "text").expect("a file");
    check(above.path(), &["new", "File"], 2);
    for name in ["1st", "my-robot", "a b", "..", "Ümlaut", "StandardLibrary", ""] {
        let said = check(above.path(), &["new", name], 2);
        assert!(said.contains("error"), "{name}: {said}");
    }
    assert_eq!(fs::read_dir(above.path()).expect("the folder").count(), 2, "nothing else was made");
}

#[test]
fn the_patterns_are_built_in() {
    let folder = folder();
    let model = "asm Cell\nimport StandardLibrary\nimport patterns/SharedValue\nsignature:\n\tstatic goal: SharedValue\ndefinitions:\n\
                 \tmain rule r_Main = r_sv_write[goal]\ndefault init s0:\n\tfunction sv_staged($v in SharedValue) = 3\n\
                 \tfunction sv_sequence($v in SharedValue) = 0\n\tfunction sv_receivedSequence($v in SharedValue) = 0\n\
                 \tfunction sv_overwritten($v in SharedValue) = 0\n";
    fs::write(folder.path().join("Cell.asm"), model).expect("a model");
    check(folder.path(), &["check", "Cell.asm", "--strict"], 0);
    assert!(check(folder.path(), &["run", "Cell.asm", "-n", "1"], 0).contains("sv_value(goal)"));
    // A file in the working folder does not replace one that the library imports.
    fs::write(folder.path().join("Task.asm"), "module Task\nnonsense").expect("a file");
    fs::write(
        folder.path().join("All.asm"),
        model.replace("Cell", "All").replace("SharedValue\nsig", "ControlTask\nsig"),
    )
    .expect("a model");
    check(folder.path(), &["check", "All.asm"], 0);
    // A fault shows where the text came from.
    fs::write(
        folder.path().join("Wrong.asm"),
        model.replace("Cell", "Wrong").replace("r_sv_write[goal]", "r_sv_wrte[goal]"),
    )
    .expect("a model");
    let said = check(folder.path(), &["check", "Wrong.asm"], 1);
    assert!(said.contains("r_sv_write"), "{said}");
    let fault = model.replace("Cell", "Fault").replace("\tfunction sv_sequence($v in SharedValue) = 0\n", "");
    fs::write(folder.path().join("Fault.asm"), fault).expect("a model");
    let said = check(folder.path(), &["run", "Fault.asm"], 1);
    assert!(said.contains("<patterns>/SharedValue.asm:"), "{said}");
    // A path into a clone of the repository, which is not here.
    fs::write(
        folder.path().join("Far.asm"),
        model.replace("Cell", "Far").replace("patterns/", "../../library/patterns/"),
    )
    .expect("a model");
    let said = check(folder.path(), &["check", "Far.asm"], 1);
    assert!(said.contains("`import patterns/SharedValue` takes the built-in library"), "{said}");
    // A file beside the model wins.
    fs::create_dir(folder.path().join("patterns")).expect("a folder");
    fs::write(
        folder.path().join("patterns/SharedValue.asm"),
        "module SharedValue\nexport *\nsignature:\ndefinitions:\n",
    )
    .expect("a module");
    assert!(check(folder.path(), &["check", "Cell.asm"], 1).contains("SharedValue"));
}

#[test]
fn a_chart_takes_built_in_patterns() {
    let folder = folder();
    let chart = "chart Cell\nimport StandardLibrary\nimport \"patterns/PatternMachines.chart\"\nmachine cell\n\tcontrol place\n\
                 \tinitial state here\n\tstate there\n\there -> there\n\tthere -> here\nendmachine\n";
    fs::write(folder.path().join("Cell.chart"), chart).expect("a chart");
    check(folder.path(), &["chart", "draw", "Cell.chart", "-o", "cell.svg"], 0);
    check(folder.path(), &["chart", "build", "Cell.chart"], 0);
    check(folder.path(), &["check", "Cell.asm"], 0);
    // A stop leaves a pattern at work, which gives back what it holds.
    let chart = "chart Stopped\nimport StandardLibrary\nimport \"patterns/PatternMachines.chart\"\nmachine robot($c in Scheduler)\n\tcontrol mode\n\
                 \tinitial composite state working\n\t\tinitial state ready\n\t\tinstance reading of asyncSlave($c)\n\tendstate\n\
                 \tstate stopped\n\tguard stop\n\tready -> reading -> ready\n\tworking -> stop yes -> stopped\nendmachine\n";
    fs::write(folder.path().join("Stopped.chart"), chart).expect("a chart");
    let said = check(folder.path(), &["chart", "build", "Stopped.chart"], 1);
    assert!(said.contains("an import declares `READY`, which `ready` becomes in the model, too"), "{said}");
    assert_eq!(said.matches("error[").count(), 1, "{said}");
    fs::write(folder.path().join("Stopped.chart"), chart.replace("ready", "resting")).expect("a chart");
    check(folder.path(), &["chart", "build", "Stopped.chart"], 0);
    check(folder.path(), &["check", "Stopped.asm"], 0);
    let built = fs::read_to_string(folder.path().join("Stopped.asm")).expect("the model");
    let given_back = "if isDef(sb_ctrlState(scheduler_currentPhase($c))) then r_abortPattern[$c] endif";
    assert!(built.contains(given_back), "{built}");
}

#[test]
fn a_system_says_what_its_report_shows() {
    let above = folder();
    check(above.path(), &["new", "Axis", "--template", "system"], 0);
    let folder = above.path().join("Axis");
    let said = check(&folder, &["report", "Missing.asm"], 2);
    assert!(said.contains("there is no file Missing.asm"), "{said}");
    let said = check(&folder, &["report", "Axis.asm", "--steps", "100", "-o", "run.html"], 0);
    for word in ["Sensing", "Control", "Drive", "Logger", "Sensing > Control", "20 ms"] {
        assert!(said.contains(word), "{word}: {said}");
    }
    let page = fs::read_to_string(folder.join("run.html")).expect("the page");
    assert!(page.contains("data-shape") && page.contains("what Axis.chart says"), "the system's picture and its name");
    // A named file must exist; if it does, it is used.
    check(&folder, &["report", "Axis.asm", "--spec", "Axis.report.yaml"], 2);
    fs::write(folder.join("Axis.report.yaml"), "title: My own\n").expect("a specification");
    assert!(check(&folder, &["report", "Axis.asm", "--steps", "4"], 0).starts_with("My own"));
}

#[test]
fn shells_complete_and_man_has_pages() {
    let folder = folder();
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = check(folder.path(), &["completions", shell], 0);
        assert!(script.contains("groundstate") && script.contains("verify"), "{shell}");
    }
    let page = check(folder.path(), &["man"], 0);
    assert!(page.contains(".TH groundstate 1") && page.contains("EXTRA") && page.contains("Exit codes"), "{page}");
    check(folder.path(), &["man", "-o", "man1"], 0);
    for (name, option) in [("run", "steps"), ("verify", "engine"), ("chart-build", "output"), ("generate-cpp", "wait")]
    {
        let page = fs::read_to_string(folder.path().join(format!("man1/groundstate-{name}.1"))).expect("a page");
        assert!(page.contains(option), "{name}: {page}");
    }
}

#[test]
fn what_is_random_has_weights() {
    let folder = folder();
    let model = "asm Stop\nimport StandardLibrary\nsignature:\n\tmonitored stop: Boolean\n\tmonitored level: Integer -> Integer\n\
                 \tcontrolled n: Integer\n\tcontrolled top: Integer\ndefinitions:\n\tmain rule r_Main = par\n\
                 \t\tif stop then n := n + 1 endif\n\t\ttop := max(top, level(1) + level(2))\n\tendpar\n\
                 default init s0:\n\tfunction n = 0\n\tfunction top = 0\n";
    fs::write(folder.path().join("Stop.asm"), model).expect("a model");
    let run = |more: &[&str], code| {
        check(
            folder.path(),
            &[&["run", "Stop.asm", "--random", "-n", "400", "--show", "all", "--engine", "interpreted"], more].concat(),
            code,
        )
    };
    let last = |text: &str, name: &str| -> i64 {
        let line =
            text.lines().rev().find_map(|line| line.trim().strip_prefix(&format!("{name} = ")).map(str::to_string));
        line.expect("a value").parse().expect("a number")
    };
    let text = run(&["--weight", "stop=true:1,false:99", "--weight", "level=1:1,2:1", "--weight", "level(2)=40:5"], 0);
    assert!((1..20).contains(&last(&text, "n")), "{}", last(&text, "n"));
    assert_eq!(last(&text, "top"), 42);
    assert!(last(&run(&[], 0), "n") > 100);
    for (weight, says) in
        [("stop=true:0", "above 0"), ("stop=maybe:1", "maybe"), ("n=1:1", "written by the machine"), ("stop", "form")]
    {
        assert!(run(&["--weight", weight], 2).contains(says), "{weight}");
    }
}

#[test]
fn operators_of_the_command_line_are_imported() {
    let folder = folder();
    let model = "asm Turn\nimport StandardLibrary\nsignature:\n\tcontrolled x: Integer\ndefinitions:\n\
                 \tmain rule r_Main = x := (x + 1) mod 3\ndefault init s0:\n\tfunction x = 0\n";
    fs::write(folder.path().join("Turn.asm"), model).expect("a model");
    let said = check(folder.path(), &["verify", "Turn.asm", "--ltl", "g(f(x = 2))", "--ctl", "ag(ef(x = 0))"], 0);
    assert!(said.contains("holds     ag(ef(x = 0))") && said.contains("holds     g(f(x = 2))"), "{said}");
    let said = check(folder.path(), &["verify", "Turn.asm", "--ltl", "g(x < 2)", "--ctl", "ag(x < 2)"], 1);
    assert_eq!((said.matches("violated ").count(), said.matches("  state 0").count()), (2, 2), "{said}");
    // A model whose own name clashes with an operator stays unchanged.
    let own = model.replace("controlled x", "static g: Boolean -> Boolean\n\tcontrolled x");
    let own = own.replace("definitions:\n", "definitions:\n\tfunction g($b in Boolean) = not $b\n");
    fs::write(folder.path().join("Turn.asm"), own).expect("a model");
    assert!(check(folder.path(), &["verify", "Turn.asm", "--ltl", "f(g(x < 2))"], 2).contains("no function `f`"));
}

#[test]
fn the_run_of_a_failing_scenario_can_be_seen() {
    let folder = folder();
    let model = "asm Step\nimport StandardLibrary\nsignature:\n\tmonitored go: Boolean\n\tcontrolled x: Integer\ndefinitions:\n\
                 \tmain rule r_Main = if go then choose $n in {2, 3} with true do x := x + $n endif\n\
                 default init s0:\n\tfunction x = 0\n";
    fs::write(folder.path().join("Step.asm"), model).expect("a model");
    let scenario = "scenario Step\nload Step.asm\nset go := true;\npick $n := 3;\nstep\nset go := false;\nstep 300\nexec x := 50;\ncheck x = 4;\n";
    fs::write(folder.path().join("Fails.avalla"), scenario.replace("300", "1")).expect("a scenario");
    fs::write(folder.path().join("Passes.avalla"), scenario.replace("= 4", "= 50")).expect("a scenario");
    let said = check(folder.path(), &["test", "Fails.avalla", "Passes.avalla", "--runs"], 1);
    let run = "  state 0\n    x = 0\n  step 1\n    in go = true\n    choose $n = 3\n    x: 0 -> 3\n  step 2\n    in go = false\n    no change\n  \
               exec\n    x: 3 -> 50\n";
    assert!(said.contains(run), "{said}");
    assert_eq!(said.matches("state 0").count(), 1, "{said}");
    assert!(!check(folder.path(), &["test", "Fails.avalla"], 1).contains("state 0"));
    let json = check(folder.path(), &["test", "Fails.avalla", "--runs", "--format", "json"], 1);
    assert!(json.contains(r#""run":[{"kind":"state""#), "{json}");
    fs::write(folder.path().join("Fails.avalla"), scenario).expect("a scenario");
    let said = check(folder.path(), &["test", "Fails.avalla", "--runs"], 1);
    assert!(said.contains("102 steps before those that follow") && said.contains("  step 301\n"), "{said}");
}

#[test]
fn what_is_shown_by_default_is_written_once_and_can_be_refined() {
    let above = folder();
    check(above.path(), &["new", "Lamp", "--template", "machine"], 0);
    let folder = above.path().join("Lamp");
    let said = check(&folder, &["report", "Lamp.asm", "--write-specification"], 0);
    assert_eq!(said, "written: Lamp.report.yaml\n");
    let without = check(&folder, &["report", "Lamp.asm", "--random", "-n", "20", "-o", "given.html"], 0);
    fs::rename(folder.join("Lamp.report.yaml"), folder.join("shown.yaml")).expect("it is there");
    let derived = check(&folder, &["report", "Lamp.asm", "--random", "-n", "20", "-o", "given.html"], 0);
    assert_eq!(without, derived, "what was written shows what is shown without it");
    // A file that is there is never written over, nor read as if it had been named.
    fs::write(folder.join("mine.yaml"), "mine: [").expect("a file");
    let said = check(&folder, &["report", "Lamp.asm", "--write-specification", "--spec", "mine.yaml"], 2);
    assert!(said.contains("mine.yaml is there already, and stays as it is"), "{said}");
    assert_eq!(fs::read_to_string(folder.join("mine.yaml")).expect("a file"), "mine: [");
}
