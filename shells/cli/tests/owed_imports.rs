//! What `chart check --prove` says of guards and actions that a pattern of an imported chart is to refine.

#![allow(clippy::disallowed_methods, reason = "a test runs the command on files")]

use std::fs;
use std::path::Path;
use std::process::Command;

const CHART: &str = r#"chart Belt
import "parts/Grip.chart"

machine belt "Belt"
	control phase
	initial state empty "Empty"
	state loaded "Loaded"
	guard there "Part there" to refine by looking
	guard gone "Gone"
	action grip "GRIP" to refine by gripping
	empty -> there yes -> loaded
	there no -> empty
	loaded -> gone yes -> grip -> empty
endmachine
"#;

const PARTS: &str = r#"chart Grip

pattern looking "Look twice"
	control eye
	state first "First look"
	guard seen "Seen"
	guard still "Still seen" {seen}
	enter -> seen yes -> first -> still yes -> exit yes
	seen no -> exit no
	still no -> exit no
endpattern

pattern gripping "Close and lift"
	control hand
	state closed "Closed"
	action close "CLOSE"
	action lift "LIFT"
	enter -> close -> closed -> lift -> exit
endpattern
"#;

fn said(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_groundstate")).args(arguments).current_dir(folder).output();
    let output = output.expect("it starts");
    let text = format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    (output.status.code(), text)
}

fn says(folder: &Path, arguments: &[&str], code: i32, wanted: &[&str]) -> String {
    let (found, text) = said(folder, arguments);
    assert_eq!(found, Some(code), "{text}");
    wanted.iter().for_each(|wanted| assert!(text.contains(wanted), "{wanted}: {text}"));
    text
}

fn write(folder: &Path, name: &str, text: &str) {
    let path = folder.join(name);
    fs::create_dir_all(path.parent().expect("a folder")).expect("it is made");
    fs::write(path, text).expect("it is written");
}

/// Builds the parts, then the belt.
fn prepare(folder: &Path, chart: &str, parts: &str) {
    write(folder, "parts/Grip.chart", parts);
    write(folder, "Belt.chart", chart);
    says(folder, &["chart", "build", "parts/Grip.chart"], 0, &[]);
    says(folder, &["chart", "build", "Belt.chart"], 0, &[]);
}

const PROVE: [&str; 4] = ["chart", "check", "Belt.chart", "--prove"];

#[test]
fn patterns_of_an_imported_chart_refine_guards_and_actions() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    prepare(folder, CHART, PARTS);
    let command = "refined, not proved; `groundstate chart check Belt.chart --prove` looks";
    says(folder, &PROVE[..3], 0, &[&format!("`there`, to refine by `looking`: {command}")]);
    let proved = ["`there`, to refine by `looking`: proved (", "`grip`, to refine by `gripping`: proved ("];
    says(folder, &PROVE, 0, &proved);
    says(folder, &["chart", "draw", "Belt.chart", "-o", "belt.svg"], 0, &[]);
    let picture = fs::read_to_string(folder.join("belt.svg")).expect("a picture");
    assert_eq!(picture.matches("style=\"stroke-dasharray:14 3\"").count(), 2, "{picture}");
    // What the part does is what its own model says.
    let model = fs::read_to_string(folder.join("Belt.asm")).expect("the model");
    let counts = |text: &str| {
        text.replacen("definitions:\n", "definitions:\n\tdomain Count = {0 : 2}\n", 1).replacen(
            "signature:\n",
            "signature:\n\tdomain Count subsetof Integer\n\tcontrolled count: Count\n",
            1,
        )
    };
    let add = "count := (count + 1) mod 3";
    let belt = model.replace("rule r_grip = skip", &format!("rule r_grip = {add}")).replacen(
        "default init s0:\n",
        "default init s0:\n\tfunction count = 0\n",
        1,
    );
    write(folder, "Belt.asm", &belt);
    let part = fs::read_to_string(folder.join("parts/Grip.asm")).expect("the model of the parts");
    write(folder, "parts/Grip.asm", &counts(&part).replace("rule r_lift = skip", &format!("rule r_lift = {add}")));
    says(folder, &PROVE, 0, &proved);
    write(folder, "parts/Grip.asm", &counts(&part).replace("rule r_close = skip", &format!("rule r_close = {add}")));
    says(folder, &PROVE, 0, &proved);
    write(folder, "parts/Grip.asm", &counts(&part));
    says(folder, &PROVE, 1, &[proved[0], "`grip`, to refine by `gripping`: refuted, nothing matches step"]);
}

#[test]
fn files_that_are_missing_circles_and_charts_farther_away_are_told() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    write(folder, "Belt.chart", CHART);
    write(
        folder,
        "Belt.asm",
        "asm Belt\nimport StandardLibrary\nsignature:\ndefinitions:\n\tmain rule r_Main = skip\n",
    );
    says(folder, &PROVE, 1, &["error[chart-import]: the chart \"parts/Grip.chart\" cannot be read"]);
    // The parts name a pattern of the belt's chart.
    let back = PARTS
        .replace("chart Grip\n", "chart Grip\nimport \"../Belt.chart\"\n")
        .replace("action lift \"LIFT\"", "action lift \"LIFT\" to refine by belting");
    write(folder, "parts/Grip.chart", &back);
    says(folder, &PROVE, 1, &["error[chart-import]: the charts import each other", "Belt.chart"]);
    // A chart between the two does not pass patterns on.
    write(folder, "parts/far/Far.chart", &PARTS.replace("chart Grip", "chart Far"));
    says(folder, &["chart", "build", "parts/far/Far.chart"], 0, &[]);
    let between = "chart Grip\nimport \"far/Far.chart\"\n\npattern other \"Other\"\n\taction rest \"REST\"\n\tenter -> rest -> exit\nendpattern\n";
    write(folder, "parts/Grip.chart", between);
    fs::remove_file(folder.join("Belt.asm")).expect("it is removed");
    prepare(folder, CHART, between);
    let far = "`grip` cannot be refined by `gripping`: the pattern stands in a chart that an imported chart imports";
    let open =
        "`grip`, to refine by `gripping`: open, there is no pattern gripping in the chart, nor in one that it imports";
    says(folder, &PROVE, 0, &[far, "import that chart here, too", open]);
    let both = CHART.replace("import \"parts", "import \"parts/far/Far.chart\"\nimport \"parts");
    prepare(folder, &both, between);
    says(folder, &PROVE, 0, &["`grip`, to refine by `gripping`: proved ("]);
}
