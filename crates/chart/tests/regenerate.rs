//! Building into a file that was edited by hand loses none of its contents, however the chart changed meanwhile.

use chart::{Known, build, read};
use syntax::{FileId, parse_chart};

const CHART: &str = "chart M machine m control phase initial state idle state busy guard ready action work action rest \
                     idle -> ready yes -> work -> busy busy -> rest -> idle endmachine";

/// Texts written by a user, which must all be preserved.
const BY_HAND: [&str; 7] = [
    "n := n + 1 // each time",
    "// my own rule",
    "rule r_mine = skip",
    "controlled n: Integer",
    "function twice = n * 2",
    "// before the initial state",
    "function n = 7",
];

fn built(chart: &str, existing: Option<&str>) -> String {
    let (chart, faults) = read(FileId(0), &parse_chart(FileId(0), chart));
    assert_eq!(faults, []);
    build(&chart, &Known::default(), existing).expect("the file has no faults").text
}

fn edited() -> String {
    let text = built(CHART, None)
        .replace("rule r_work = skip", "rule r_work =\n\t\tn := n + 1 // each time")
        .replace(
            "monitored ready: Boolean",
            "monitored ready: Boolean\n\tcontrolled n: Integer\n\tderived twice: Integer",
        )
        .replace(
            "definitions:\n",
            "definitions:\n\tfunction twice = n * 2\n\n\t// my own rule\n\trule r_mine = skip\n\n",
        )
        .replace("default init s0:", "// before the initial state\ndefault init s0:\n\tfunction n = 7");
    BY_HAND.iter().for_each(|part| assert!(text.contains(part), "{part}\n{text}"));
    text
}

#[test]
fn nothing_is_lost() {
    let before = edited();
    assert_eq!(built(CHART, Some(&before)), before, "an unchanged chart changes nothing");
    for (what, from, to) in [
        ("an action is renamed", "work", "labour"),
        ("an action is removed", "yes -> work -> busy", "yes -> rest -> busy"),
        ("a guard is renamed", "ready", "prepared"),
        ("a state is renamed", "busy", "working"),
        ("the machine is renamed", "machine m ", "machine other "),
        ("the machine is linked", "machine m ", "machine m {r_machine} "),
        ("the control variable is renamed", "control phase", "control mode"),
    ] {
        let mut chart = CHART.replace(from, to);
        if what == "an action is removed" {
            chart = chart.replace("action work ", "").replace("busy -> rest -> idle", "busy -> idle");
        }
        assert_ne!(chart, CHART, "{what}");
        let after = built(&chart, Some(&before));
        BY_HAND.iter().for_each(|part| assert!(after.contains(part), "{what}: {part} is lost\n{after}"));
        assert_eq!(built(&chart, Some(&after)), after, "{what}: once is enough");
    }
}

/// A main rule that is missing comes before the initial state, where it has to be.
#[test]
fn a_main_rule_is_added_where_it_belongs() {
    let before = edited();
    let (start, end) = (before.find("\tmain rule").expect("a rule"), before.find("// before").expect("a comment"));
    let without = format!("{}{}", &before[..start], &before[end..]);
    let after = built(CHART, Some(&without));
    BY_HAND.iter().for_each(|part| assert!(after.contains(part), "{part} is lost\n{after}"));
    let faults = syntax::parse_asmetal(FileId(0), &after).diagnostics;
    assert_eq!(faults, [], "{after}");
    assert!(after.contains("main rule r_Main ="), "{after}");
}

#[test]
fn a_file_with_faults_is_not_touched() {
    let (chart, _) = read(FileId(0), &parse_chart(FileId(0), CHART));
    let broken = edited().replace("rule r_mine = skip", "rule r_mine = if");
    assert!(build(&chart, &Known::default(), Some(&broken)).is_err());
}
