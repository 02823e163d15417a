//! The keys that are completed in specifications are those that the readers of these files know.

use groundstate::report::read_specification;
use syntax::FileId;

use crate::support::project;

/// The keys that are offered at the end of a text.
fn offered(path: &str, text: &str) -> Vec<String> {
    let model = "asm Two\nsignature:\n\tcontrolled n: Integer\ndefinitions:\n\tmain rule r_Main = n := 1\n";
    let files = [("Two.asm".to_string(), model.to_string()), (path.to_string(), text.to_string())];
    let completion = ide::completion(&mut project(&files.into()), path, text.len() as u32);
    let mut keys: Vec<String> = completion.items.into_iter().map(|item| item.label).collect();
    keys.sort();
    keys
}

fn sorted(list: &str) -> Vec<String> {
    let mut words: Vec<String> = list.split(", ").map(str::to_string).collect();
    words.sort();
    words
}

#[test]
fn keys_of_a_report_are_those_that_are_read() {
    for place in [
        "",
        "tasks:\n  ",
        "tasks:\n  terms:\n    ",
        "tasks:\n  each:\n    left:\n      ",
        "tasks:\n  each:\n    left: { ",
        "buffers:\n  ",
        "buffers:\n  each:\n    b: {}\n  terms:\n    ",
        "buffers:\n  each:\n    b: { ",
        "queues:\n  terms:\n    ",
        "queues:\n  each:\n    q:\n      ",
        "series:\n  Age of data:\n    ",
        "flow:\n  ",
        "flow:\n  hops:\n    - ",
        "flow:\n  hops:\n    - { ",
        "charts:\n  a/B.chart:\n    ",
        "charts:\n  B.chart:\n    machines:\n      m: { ",
    ] {
        let close = if place.ends_with("{ ") { " }" } else { "" };
        // Where terms are shared, something must share them for them to be read.
        let shares = if place.contains("terms") && !place.contains("each") { "\n  each:\n    one: {}" } else { "" };
        let faults = read_specification(FileId(0), &format!("{place}nokey: 1{close}{shares}\n")).expect_err(place);
        let help = faults.iter().find(|fault| fault.message.contains("`nokey`")).and_then(|fault| fault.help.clone());
        let help = help.unwrap_or_else(|| panic!("{place:?}: {faults:?}"));
        let known = sorted(help.strip_prefix("known are: ").expect("a list"));
        assert_eq!(offered("Two.report.yaml", place), known, "{place:?}");
    }
}

#[test]
fn keys_of_a_verification_are_those_that_are_read() {
    let fault = groundstate::inputs::verification::read(FileId(0), "a text").expect_err("a fault");
    let known = sorted(fault.message.strip_prefix("a mapping is expected: ").expect("a list"));
    assert_eq!(offered("Two.verify.yaml", ""), known);
    assert_eq!(offered("Two.verify.yaml", "fair: "), ["strong", "weak"]);
}

#[test]
fn what_is_asked_of_a_system_has_its_names_before_a_model_is_built() {
    let chart = "chart Two\nsystem two\n\ttick 1 ms\n\tcomponent one synchronous period 5 ms\n\t\telaborate count 1 ms by Count\n\tendcomponent\nendsystem\n";
    let count = "asm Count\nimport StandardLibrary\nsignature:\n\tcontrolled isOdd: Boolean\ndefinitions:\n\tmain rule r_Main = isOdd := not isOdd\ndefault init s0: function isOdd = false\n";
    let text = "invariants:\n  - one_is";
    let files = [("Two.chart", chart), ("Count.asm", count), ("Two.verify.yaml", text)];
    let files = files.map(|(path, text)| (path.to_string(), text.to_string()));
    let mut project = project(&files.into());
    let completion = ide::completion(&mut project, "Two.verify.yaml", text.len() as u32);
    assert!(completion.items.iter().any(|item| item.label == "one_isOdd"), "{completion:?}");
    let whole = "invariants:\n  - one_isOdd\n";
    project.set_text("Two.verify.yaml", 1, whole).expect("the first");
    let hover = ide::hover(&mut project, "Two.verify.yaml", 20).expect("it is known");
    assert!(format!("{hover:?}").contains("one_isOdd"), "{hover:?}");
    // The model that declares it was not built: nowhere to go.
    assert_eq!(ide::definition(&mut project, "Two.verify.yaml", 20), []);
}
