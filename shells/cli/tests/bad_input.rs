//! Generated bad inputs: every one gets a message and the right exit code, and none makes the program panic.
#![allow(clippy::disallowed_methods, reason = "the test makes the files it gives to the command")]

use std::fs;
use std::io::{Read, Write};
use std::path::Path;
use std::process::{Command, Output, Stdio};

fn groundstate(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_groundstate"));
    command.args(arguments).current_dir(folder).stdin(Stdio::null()).output().expect("it starts")
}

/// Checks the exit code, and that the output contains this text.
fn check(folder: &Path, arguments: &[&str], code: i32, says: &str) {
    let output = groundstate(folder, arguments);
    let text = format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    let shown: String = text.chars().take(2_000).collect();
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {shown}");
    assert!(text.contains(says), "{arguments:?}: `{says}` is not in: {shown}");
    assert!(!text.contains("panicked"), "{arguments:?}: {shown}");
    assert!(text.len() < 200_000, "{arguments:?}: {} bytes of output", text.len());
}

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

fn write(folder: &Path, name: &str, text: impl AsRef<[u8]>) {
    fs::write(folder.join(name), text).expect("the file can be written");
}

/// A model whose main rule is this.
fn model(name: &str, rule: &str) -> String {
    format!(
        "asm {name}\nimport StandardLibrary\nsignature:\n\tcontrolled x: Integer\ndefinitions:\n\tmain rule r_Main = {rule}\n\
         default init s0:\n\tfunction x = 0\n"
    )
}

#[test]
fn invalid_utf8() {
    let folder = folder();
    write(folder.path(), "Bytes.asm", b"asm Bytes\n\xff\xfe\0");
    check(folder.path(), &["check", "Bytes.asm"], 2, "not UTF-8 text: byte 10");
    write(folder.path(), "Bytes.asm", b"asm Bytes\n\xff\xfe");
    check(folder.path(), &["check", "Bytes.asm"], 1, "byte 0xFF at offset 10");
}

#[test]
fn a_file_that_is_too_large() {
    let folder = folder();
    let path = folder.path().join("Large.asm");
    fs::File::create(&path).and_then(|file| file.set_len(100 << 20)).expect("a sparse file");
    check(folder.path(), &["check", "Large.asm"], 2, "larger than 16777216 bytes");
    check(folder.path(), &["check", "Large.asm"], 2, "--max-file-size");
}

#[test]
fn an_import_that_is_too_large() {
    let folder = folder();
    write(folder.path(), "Main.asm", "asm Main\nimport Large\nsignature:\ndefinitions:\n\tmain rule r_Main = skip\n");
    let path = folder.path().join("Large.asm");
    fs::File::create(&path).and_then(|file| file.set_len(100 << 20)).expect("a sparse file");
    check(folder.path(), &["check", "Main.asm"], 1, "larger than 16777216 bytes");
}

#[test]
fn ten_thousand_parentheses() {
    let folder = folder();
    let (open, close) = ("(".repeat(10_000), ")".repeat(10_000));
    write(folder.path(), "Deep.asm", model("Deep", &format!("x := {open}1{close}")));
    check(folder.path(), &["check", "Deep.asm"], 1, "Deep.asm:6");
    check(folder.path(), &["run", "Deep.asm"], 1, "Deep.asm:6");
}

#[test]
fn a_line_of_many_operators() {
    let folder = folder();
    write(folder.path(), "Wide.asm", model("Wide", &format!("x := 1{}", " + 1".repeat(200_000))));
    let output = groundstate(folder.path(), &["check", "Wide.asm"]);
    assert!(matches!(output.status.code(), Some(0 | 1)), "{output:?}");
}

#[test]
fn a_thousand_faults() {
    let folder = folder();
    let updates = "y := 1 ".repeat(1_000);
    write(folder.path(), "Many.asm", model("Many", &format!("par {updates} endpar")));
    check(folder.path(), &["check", "Many.asm"], 1, "more");
}

#[test]
fn endless_recursion() {
    let folder = folder();
    let text = "asm Recurse\nimport StandardLibrary\nsignature:\n\tcontrolled x: Integer\ndefinitions:\n\t\
                turbo rule r_down($n in Integer) = r_down($n + 1)\n\tmain rule r_Main = r_down(x)\n\
                default init s0:\n\tfunction x = 0\n";
    write(folder.path(), "Recurse.asm", text);
    check(folder.path(), &["run", "Recurse.asm"], 1, "--max-depth");
    check(folder.path(), &["run", "Recurse.asm", "--max-depth", "50000"], 1, "limit of 50000");
    check(folder.path(), &["run", "Recurse.asm", "--max-depth", "1000000000"], 2, "200000");
}

#[test]
fn endless_while() {
    let folder = folder();
    write(folder.path(), "Spin.asm", model("Spin", "whilerec true do x := x"));
    check(folder.path(), &["run", "Spin.asm", "--max-iterations", "10000"], 1, "--max-iterations");
}

#[test]
fn a_step_without_end() {
    let folder = folder();
    let rule = "forall $a in {1 : 5000}, $b in {1 : 5000}, $c in {1 : 5000} with $a + $b + $c < x do x := 1";
    write(folder.path(), "Busy.asm", model("Busy", rule));
    check(folder.path(), &["run", "Busy.asm", "--max-work", "100000"], 1, "--max-work");
    check(folder.path(), &["run", "Busy.asm", "--max-heap", "1"], 1, "--max-heap");
}

#[test]
fn a_long_value_is_cut() {
    let folder = folder();
    let text = "asm Long\nimport StandardLibrary\nsignature:\n\tcontrolled q: Seq(Integer)\ndefinitions:\n\t\
                main rule r_Main = q := [1 : 50000]\n";
    write(folder.path(), "Long.asm", text);
    let output = groundstate(folder.path(), &["run", "Long.asm", "--steps", "1"]);
    let told = String::from_utf8_lossy(&output.stdout);
    assert!(told.contains("(cut here, of 50000 values)") && told.len() < 10_000, "{}", told.len());
}

#[test]
fn a_huge_collection() {
    let folder = folder();
    write(folder.path(), "Huge.asm", model("Huge", "forall $n in {1 : 1000000000} do x := 1"));
    check(folder.path(), &["run", "Huge.asm", "--max-collection", "100000"], 1, "--max-collection");
}

#[test]
fn nothing_is_left_half_written() {
    let folder = folder();
    write(folder.path(), "Count.asm", model("Count", "x := x + 1"));
    check(folder.path(), &["run", "Count.asm", "--trace", "no/such/folder/x.trace"], 2, "no/such/folder");
    check(folder.path(), &["run", "Count.asm", "--trace", "."], 2, "is a folder");
    let left: Vec<_> =
        fs::read_dir(folder.path()).expect("the folder").map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(left, ["Count.asm"]);
}

#[test]
fn traces_that_are_none() {
    let folder = folder();
    write(folder.path(), "Count.asm", model("Count", "x := x + 1"));
    check(folder.path(), &["run", "Count.asm", "-n", "3", "--trace", "t", "--quiet"], 0, "");
    let trace = fs::read_to_string(folder.path().join("t")).expect("a trace");
    let lines: Vec<&str> = trace.lines().collect();
    write(folder.path(), "cut", lines[..3].join("\n"));
    check(folder.path(), &["replay", "cut"], 2, "it has no end");
    write(folder.path(), "half", &trace[..trace.len() - 10]);
    check(folder.path(), &["replay", "half"], 2, "line 6");
    write(folder.path(), "empty", "");
    check(folder.path(), &["replay", "empty"], 2, "it is empty");
    write(folder.path(), "newer", trace.replace("\"version\":1", "\"version\":99"));
    check(folder.path(), &["replay", "newer"], 2, "version 99");
    write(folder.path(), "other", trace.replace("\"to\":\"2\"", "\"to\":\"7\""));
    check(folder.path(), &["replay", "other"], 1, "differs from the trace at step 2");
    write(folder.path(), "Count.asm", model("Count", "x := x + 2"));
    check(folder.path(), &["replay", "t"], 1, "the model has changed");
}

#[test]
fn a_closed_pipe_is_quiet() {
    let folder = folder();
    write(folder.path(), "Count.asm", model("Count", "x := x + 1"));
    let mut child = Command::new(env!("CARGO_BIN_EXE_groundstate"))
        .args(["run", "Count.asm", "-n", "200000"])
        .current_dir(folder.path())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("it starts");
    let mut first = [0; 64];
    child.stdout.take().expect("a pipe").read_exact(&mut first).expect("some output");
    let output = child.wait_with_output().expect("it ends");
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
    assert_eq!(output.status.code(), Some(0));
}

/// The exit code and the stderr of a command whose output is closed after the first bytes.
fn closed(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let mut child = Command::new(env!("CARGO_BIN_EXE_groundstate"))
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("it starts");
    drop(child.stdout.take());
    let output = child.wait_with_output().expect("it ends");
    (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
}

#[test]
fn the_verdict_is_the_same_whoever_reads() {
    let folder = folder();
    let text = "asm Bad\nimport StandardLibrary\nsignature:\n\tcontrolled x: Integer\ndefinitions:\n\
                \tinvariant inv_few over x: x < 5\n\tmain rule r_Main = if x < 9 then x := x + 1 endif\n\
                default init s0:\n\tfunction x = 0\n";
    write(folder.path(), "Bad.asm", text);
    write(folder.path(), "Wrong.asm", model("Wrong", "x := true"));
    write(folder.path(), "Fails.avalla", "scenario Fails\nload Bad.asm\nstep\ncheck x = 7;\n");
    for arguments in [
        &["run", "Bad.asm"][..],
        &["run", "Bad.asm", "--format", "json"],
        &["run", "Bad.asm", "--keep-going", "--trace", "/dev/stdout"],
        &["check", "Wrong.asm", "--format", "json"],
        &["test", "Fails.avalla"],
        &["test", "Fails.avalla", "--format", "json"],
        &["verify", "Bad.asm"],
        &["review", "Wrong.asm", "--format", "json"],
    ] {
        let (code, said) = closed(folder.path(), arguments);
        assert_eq!(code, Some(1), "{arguments:?}: {said}");
        assert!(!said.contains("panicked"), "{arguments:?}: {said}");
    }
    // *Not known* stays, too: the condition never held.
    assert_eq!(closed(folder.path(), &["run", "Bad.asm", "-n", "3", "--until", "x = 9"]).0, Some(3));
}

#[test]
fn each_failing_scenario_tells_its_reason() {
    let folder = folder();
    let text = "asm Bad\nimport StandardLibrary\nsignature:\n\tcontrolled x: Integer\ndefinitions:\n\
                \tinvariant inv_few over x: x < 2\n\tmain rule r_Main = x := x + 1\ndefault init s0:\n\tfunction x = 0\n";
    write(folder.path(), "Bad.asm", text);
    for name in ["One", "Two"] {
        write(folder.path(), &format!("{name}.avalla"), format!("scenario {name}\nload Bad.asm\nstep 5\n"));
    }
    let output = groundstate(folder.path(), &["test", "One.avalla", "Two.avalla"]);
    let text = String::from_utf8_lossy(&output.stdout);
    assert_eq!(text.matches("invariant inv_few does not hold after 2 steps").count(), 2, "{text}");
    // A model that cannot run is reported once; the second scenario refers to it.
    write(folder.path(), "Bad.asm", model("Bad", "x := true"));
    let output = groundstate(folder.path(), &["test", "One.avalla", "Two.avalla"]);
    let text = String::from_utf8_lossy(&output.stdout);
    assert_eq!((text.matches("error[").count(), text.matches("faults are shown above").count()), (1, 1), "{text}");
}

#[test]
fn standard_input_that_is_no_terminal_is_not_asked() {
    let folder = folder();
    let text = "asm Ask\nimport StandardLibrary\nsignature:\n\tmonitored go: Boolean\n\tcontrolled x: Integer\n\
                definitions:\n\tmain rule r_Main = if go then x := 1 endif\n";
    write(folder.path(), "Ask.asm", text);
    let mut child = Command::new(env!("CARGO_BIN_EXE_groundstate"))
        .args(["run", "Ask.asm"])
        .current_dir(folder.path())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("it starts");
    child.stdin.take().expect("a pipe").write_all(b"true\n").ok();
    let output = child.wait_with_output().expect("it ends");
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("--random"));
}

#[test]
fn files_of_another_kind() {
    let folder = folder();
    write(folder.path(), "Model.asm", model("Model", "skip"));
    write(folder.path(), "Scenario.avalla", "scenario Scenario\nload Model.asm\nstep\n");
    check(folder.path(), &["run", "Scenario.avalla"], 2, "Scenario.avalla is a scenario");
    check(folder.path(), &["bench", "Scenario.avalla"], 2, "`groundstate test` runs scenarios");
    check(folder.path(), &["test", "Model.asm"], 2, "Model.asm is a model");
    check(folder.path(), &["replay", "Model.asm"], 2, "--trace FILE` writes one");
    check(folder.path(), &["run", "Model"], 2, "is Model.asm meant?");
    check(folder.path(), &["run", "Model.asm", "--steps", "-3"], 2, "write a whole number");
}

const LAMP: &str = "chart Lamp\nmachine lamp\n\tcontrol light\n\tinitial state off\n\tstate on\n\tguard pressed\n\t\
                    off -> pressed yes -> on\n\ton -> pressed\n\tpressed no -> off\nendmachine\n";

#[test]
fn what_is_read_is_not_written_over() {
    let folder = folder();
    let model = model("Count", "x := x + 1");
    write(folder.path(), "Count.asm", &model);
    write(folder.path(), "Lamp.chart", LAMP);
    let says = "it is not overwritten";
    check(folder.path(), &["run", "Count.asm", "--trace", "Count.asm", "-n", "1"], 2, says);
    fs::create_dir(folder.path().join("inner")).expect("a new folder");
    check(folder.path(), &["run", "./Count.asm", "--trace", "inner/../Count.asm", "-n", "1"], 2, says);
    check(folder.path(), &["chart", "build", "Lamp.chart", "-o", "Lamp.chart"], 2, says);
    check(folder.path(), &["chart", "draw", "Lamp.chart", "-o", "./Lamp.chart"], 2, "");
    check(folder.path(), &["chart", "draw", "Lamp.chart", "-o", "Lamp.svg", "--quiet"], 0, "");
    check(folder.path(), &["chart", "build", "Count.asm"], 2, "Count.asm is a model");
    // A model that the chart imports must not be overwritten by the built one.
    write(folder.path(), "Wide.chart", LAMP.replace("chart Lamp", "chart Wide\nimport Library"));
    let library = "module Library\nimport StandardLibrary\nexport *\nsignature:\ndefinitions:\n";
    write(folder.path(), "Library.asm", library);
    check(folder.path(), &["chart", "build", "Wide.chart", "-o", "Library.asm"], 2, says);
    let text = |name: &str| fs::read_to_string(folder.path().join(name)).expect("it is there");
    assert_eq!((text("Count.asm"), text("Lamp.chart"), text("Library.asm")), (model, LAMP.into(), library.into()));
    // Updating in place still works.
    check(folder.path(), &["chart", "place", "Lamp.chart"], 0, "Lamp.chart");
    assert!(text("Lamp.chart").contains("layout lamp"));
    check(folder.path(), &["chart", "build", "Lamp.chart"], 0, "Lamp.asm");
    check(folder.path(), &["chart", "build", "Lamp.chart"], 0, "Lamp.asm");
}

#[test]
fn a_model_with_faults_is_not_built() {
    let folder = folder();
    let nothing_written = |name: &str| assert!(!folder.path().join(name).exists(), "{name} was written");
    write(folder.path(), "Empty.chart", "chart Empty\n");
    check(folder.path(), &["chart", "build", "Empty.chart"], 1, "error[empty-chart]");
    nothing_written("Empty.asm");
    write(
        folder.path(),
        "Link.chart",
        LAMP.replace("chart Lamp", "chart Link").replace("guard pressed", "guard pressed {level > 3}"),
    );
    check(folder.path(), &["chart", "build", "Link.chart"], 1, "Link.chart:6:");
    check(folder.path(), &["check", "Link.chart"], 1, "there is no function `level`");
    nothing_written("Link.asm");
    let twice = "chart Twice\nmachine go\n\tcontrol c\n\tinitial state off\n\tstate on\n\taction go\n\toff -> go -> on\nendmachine\n";
    write(folder.path(), "Twice.chart", twice);
    check(folder.path(), &["chart", "build", "Twice.chart"], 1, "a second rule `r_go` would be made");
    nothing_written("Twice.asm");
    // An existing model stays as it is.
    write(folder.path(), "Old.asm", model("Old", "skip"));
    write(
        folder.path(),
        "Old.chart",
        LAMP.replace("chart Lamp", "chart Old").replace("guard pressed", "guard pressed {x}"),
    );
    let before = fs::read_to_string(folder.path().join("Old.asm")).expect("it is there");
    check(folder.path(), &["chart", "build", "Old.chart"], 1, "was not built");
    assert_eq!(fs::read_to_string(folder.path().join("Old.asm")).expect("it is there"), before);
}

#[test]
fn a_chart_without_a_model_is_not_compared() {
    let folder = folder();
    write(folder.path(), "Lamp.chart", LAMP);
    write(folder.path(), "Empty.chart", "chart Empty\n");
    check(folder.path(), &["chart", "check", "Lamp.chart"], 3, "not compared: there is no model Lamp.asm");
    check(folder.path(), &["chart", "check", "Empty.chart"], 3, "not compared");
    check(folder.path(), &["chart", "check", "Lamp.chart", "--model", "Other.asm"], 2, "there is no file Other.asm");
}

/// What stands beside a model and cannot be read was meant to be something.
#[cfg(unix)]
#[test]
fn a_link_to_nowhere_is_no_missing_file() {
    let folder = folder();
    write(folder.path(), "Count.asm", model("Count", "x := (x + 1) mod 3"));
    check(folder.path(), &["verify", "Count.asm"], 0, "holds");
    std::os::unix::fs::symlink("Gone.yaml", folder.path().join("Count.verify.yaml")).expect("a link");
    check(folder.path(), &["verify", "Count.asm"], 2, "Count.verify.yaml");
}

#[test]
fn check_takes_all_that_a_project_is_made_of() {
    let folder = folder();
    write(folder.path(), "Count.asm", model("Count", "x := x + 1"));
    write(folder.path(), "Lamp.chart", LAMP);
    write(folder.path(), "Count.verify.yaml", "invariants: [x >= 0]\n");
    check(folder.path(), &["check", "Lamp.chart"], 0, "Lamp.chart: no faults (1 machine)");
    check(folder.path(), &["check", "Count.verify.yaml"], 0, "no faults");
    write(folder.path(), "Count.verify.yaml", "invariants: [y >= 0]\n");
    check(folder.path(), &["check", "Count.verify.yaml"], 1, "there is no function `y`");
    check(folder.path(), &["check", "."], 1, "there is no function `y`");
    write(folder.path(), "Count.verify.yaml", "bounds: {z: 0..3}\n");
    check(folder.path(), &["check", "Count.verify.yaml"], 1, "`z` is no monitored or shared function");
    // Every command that reads the file names it and the place.
    for command in [&["verify"][..], &["review"], &["generate-tests", "-o", "tests"]] {
        let command: Vec<&str> = command.iter().copied().chain(["Count.asm"]).collect();
        check(folder.path(), &command, 2, "Count.verify.yaml:1:10");
        check(folder.path(), &command, 2, "bound z=0..3: `z` is no monitored or shared function");
    }
    write(folder.path(), "Count.verify.yaml", "fair: often\n");
    check(folder.path(), &["verify", "Count.asm"], 2, "Count.verify.yaml:1:7");
    write(folder.path(), "Count.report.yaml", "nonsense: 1\n");
    check(folder.path(), &["check", "Count.report.yaml"], 1, "nonsense");
    write(folder.path(), "Other.verify.yaml", "invariants: [x >= 0]\n");
    check(folder.path(), &["check", "Other.verify.yaml"], 3, "not checked: there is no model Other.asm");
    check(folder.path(), &["check", "other.yaml"], 2, "there is no file");
}

#[test]
fn a_keyword_as_a_name_is_told_once() {
    let folder = folder();
    for word in ["init", "case", "rule", "par", "import"] {
        let text = model("Word", "if x > 1 then x := x + 1 endif").replace('x', word);
        write(folder.path(), "Word.asm", text);
        check(folder.path(), &["check", "Word.asm"], 1, "Word.asm: 1 error");
    }
}

#[test]
fn messages_name_what_is_meant() {
    let folder = folder();
    check(folder.path(), &["explain", "chanel-master"], 2, "did you mean `channel-master`?");
    write(folder.path(), "Rule.asm", model("Rule", "stop[]"));
    check(folder.path(), &["check", "Rule.asm"], 1, "declare `rule r_stop = …`");
    let system =
        "chart S\nsystem s\n\tcomponent a synchronous period 10\n\t\telaborate x 6 ms\n\tendcomponent\nendsystem\n";
    write(folder.path(), "S.chart", system);
    check(folder.path(), &["chart", "draw", "S.chart"], 1, "S.chart:3:");
    check(folder.path(), &["chart", "draw", "S.chart"], 1, "expected a unit");
}
