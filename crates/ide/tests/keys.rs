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
