//! Damaged charts: whatever is cut out, doubled or exchanged, reading them never panics, and what has no errors is built
//! to a text that parses, drawn, exported, and written so that it reads back.

#![allow(clippy::disallowed_methods, reason = "a test reads the repository's own charts")]

use std::path::Path;

use chart::{Known, build, probed, read, unbuilt, write};
use draw::{Notation, Theme, drawings, export};
use syntax::{FileId, Severity, assert_invariants, parse_asmetal, parse_chart};

/// Numbers that look random and are the same in every run.
struct Dice(u64);

impl Dice {
    fn throw(&mut self, sides: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % sides.max(1)
    }
}

fn errors(faults: &[syntax::Diagnostic]) -> usize {
    faults.iter().filter(|fault| fault.severity == Severity::Error).count()
}

fn check(text: &str) -> bool {
    assert_invariants(text.as_bytes());
    let (chart, faults) = read(FileId(0), &parse_chart(FileId(0), text));
    let _ = chart::dump(&chart);
    // The library's patterns are not looked for here.
    let unbuilt = unbuilt(&chart, &Known::default());
    if errors(&faults) > 0 || unbuilt.iter().any(|fault| fault.id != "chart-import") {
        return false;
    }
    let built = build(&chart, &Known::default(), None).expect("there was no file").text;
    assert_eq!(errors(&parse_asmetal(FileId(0), &built).diagnostics), 0, "{text}\n{built}");
    build(&chart, &Known::default(), Some(&built)).expect("what was built parses");
    probed(&chart, &built).expect("what was built parses");
    for drawing in drawings(&chart) {
        drawing.svg(Theme::Auto).unwrap_or_else(|fault| panic!("{fault}\n{text}"));
        for notation in [Notation::Mermaid, Notation::Dot, Notation::Scxml] {
            let _ = export(&drawing, notation);
        }
    }
    if chart.system.is_none() {
        let again = write(&chart);
        assert_eq!(errors(&read(FileId(0), &parse_chart(FileId(0), &again)).1), 0, "{text}\n{again}");
    }
    true
}

/// The words and marks of a text, with the blanks before them.
fn pieces(text: &str) -> Vec<&str> {
    let mut pieces = Vec::new();
    let mut start = 0;
    let mut before = ' ';
    for (at, letter) in text.char_indices() {
        let word = |c: char| c.is_alphanumeric() || c == '_';
        if at > start && !before.is_whitespace() && !(word(before) && word(letter)) {
            pieces.push(&text[start..at]);
            start = at;
        }
        before = letter;
    }
    pieces.push(&text[start..]);
    pieces
}

#[test]
fn damaged_charts() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let files = [
        "library/patterns/DataProducer.chart",
        "library/patterns/PatternMachines.chart",
        "examples/visual_servoing/VisionSystem.chart",
        "examples/visual_servoing/VisualServoingComponent.chart",
    ];
    // Each is laid out, which takes most of the time.
    let each = if testkit::sample::is_full() { 150 } else { 20 };
    let mut whole = 0;
    for (seed, file) in files.iter().enumerate() {
        let text = std::fs::read_to_string(root.join(file)).expect("the chart is there");
        assert!(check(&text), "{file}");
        let pieces = pieces(&text);
        let mut dice = Dice(seed as u64 + 1);
        for _ in 0..each {
            let mut damaged = pieces.clone();
            for _ in 0..=dice.throw(3) {
                let (at, other) = (dice.throw(damaged.len()), dice.throw(damaged.len()));
                match dice.throw(4) {
                    0 => _ = damaged.remove(at),
                    1 => damaged.insert(at, pieces[dice.throw(pieces.len())]),
                    2 => damaged.swap(at, other),
                    _ => damaged.truncate(damaged.len().saturating_sub(dice.throw(40))),
                }
            }
            whole += usize::from(check(&damaged.concat()));
        }
    }
    assert!(whole * 30 > each * files.len(), "only {whole} of the damaged charts were whole");
}

#[test]
fn a_way_in_a_circle_is_shown_and_ends() {
    let text = "chart C machine m control c initial state idle guard ready action work \
                idle -> ready yes -> idle ready no -> work -> ready endmachine";
    let (chart, faults) = read(FileId(0), &parse_chart(FileId(0), text));
    assert_eq!(faults.iter().map(|fault| fault.id).collect::<Vec<_>>(), ["circular-path"]);
    assert!(chart::dump(&chart).contains("idle --[ready]/--> idle"), "{}", chart::dump(&chart));
}
