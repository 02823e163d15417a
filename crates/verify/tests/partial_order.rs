//! With partial-order reduction the verdicts are the same as with all steps, with fewer states.
//!
//! `GROUNDSTATE_CASES` sets how many random models (a few seconds' worth if absent), `GROUNDSTATE_SEED` the first seed.

#![allow(clippy::disallowed_methods, reason = "a test reads the repository's own models")]

use std::collections::BTreeMap;
use std::fmt::Write;
use std::sync::Arc;

use machine::{Location, Value};
use program::Program;
use syntax::SourceFile;
use testkit::{Random, repository, sample};
use verify::{EngineKind, Options, Outcome, Report, Subject, Trace, Unreduced, verify};

use crate::models::{Disk, lowered};

fn program(path: &str) -> Arc<Program> {
    let path = repository::root().join(path);
    lowered(Disk::read(&path).expect("the model is there"))
}

fn check(program: &Arc<Program>, options: &Options) -> Report {
    verify(program, options, &mut |_| true).expect("there is an initial state")
}

/// Each step of a run begins in the state that the previous one led to.
fn is_a_run(trace: &Trace) {
    let mut values: BTreeMap<&Location, &Value> =
        trace.values.iter().map(|(location, value)| (location, value)).collect();
    for change in trace.steps.iter().flat_map(|step| &step.changes) {
        let before = values.insert(&change.location, &change.after).unwrap_or(&Value::Undef);
        assert_eq!(*before, change.before);
    }
}

/// By subject: H, V or U.
fn verdicts(report: &Report) -> Vec<(Subject, char)> {
    let each = report.verdicts.iter().map(|verdict| match &verdict.outcome {
        Outcome::Holds => (verdict.subject, 'H'),
        Outcome::Violated(trace) => {
            is_a_run(trace);
            (verdict.subject, 'V')
        }
        Outcome::Unknown(_) => (verdict.subject, 'U'),
    });
    each.collect()
}

/// The number of states with all steps, and with the reduction; the verdicts must be equal for any number of workers.
fn agrees(program: &Arc<Program>, text: &str) -> (u64, u64) {
    let options = Options { engine: EngineKind::Explicit, ..Options::default() };
    let whole = check(program, &options);
    let mut states = Vec::new();
    for workers in [1, 2] {
        let report = check(program, &Options { partial_order: true, workers, alone: Some(0), ..options.clone() });
        assert_eq!(verdicts(&report), verdicts(&whole), "{text}");
        assert_eq!(report.unreachable, whole.unreachable, "{text}");
        assert!(report.progress.states <= whole.progress.states);
        if report.reduced != Some(Ok(())) {
            assert_eq!(report.progress.states, whole.progress.states);
        }
        states.push(report.progress.states);
    }
    assert_eq!(states[0], states[1], "{text}");
    (whole.progress.states, states[0])
}

#[test]
fn the_reference_systems_have_the_same_verdicts() {
    let models = ["Swing", "SwingUnlocked", "ChainXS", "ChainS", "AlternatingBit"];
    let counts = models.map(|name| agrees(&program(&format!("bench/models/verify/{name}.asm")), name));
    assert_eq!(counts.map(|(whole, _)| whole), [203, 725, 99_584, 2_977_088, 60_273]);
    assert!(counts[3].1 * 2 < counts[3].0, "{counts:?}");
}

#[test]
fn what_cannot_be_reduced_says_why() {
    let text = |inputs: &str, main: &str| {
        format!(
            "asm M\nimport StandardLibrary\nsignature:\n enum domain Who = {{AA | BB}}\n enum domain Level = {{LOW | MID | TOP}}\n \
             monitored go: Boolean\n controlled level: Who -> Level\n controlled both: Boolean\ndefinitions:\n \
             invariant inv_both over both: {inputs}\n \
             main rule r_Main = {main}\ndefault init s0:\n function level($w in Who) = LOW\n function both = false\n"
        )
    };
    let move_on = "if level($w) = LOW then level($w) := MID else if level($w) = MID then level($w) := TOP endif endif";
    let choose = format!("choose $w in Who with true do {move_on}");
    let all = format!("forall $w in Who with true do {move_on}");
    let of = |inputs: &str, main: &str| {
        let program = lowered(SourceFile::new("M.asm", text(inputs, main)));
        let report = check(&program, &Options { partial_order: true, ..Options::default() });
        (report.reduced.expect("it was asked for"), report.progress.states)
    };
    assert_eq!(of("not both", &choose), (Ok(()), 5));
    assert_eq!(of("not both", &all), (Err(Unreduced::NoChoice), 3));
    assert_eq!(of("not both or go", &choose), (Err(Unreduced::Inputs), 9));
    assert_eq!(of("level(AA) = LOW or level(BB) != TOP or true", &choose), (Err(Unreduced::AllShared), 9));
}

/// A model whose agents move by random rules over their own and shared locations.
fn random_model(seed: u64) -> String {
    let mut random = Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) + 1);
    let mut text = String::from(
        "asm Agents\nimport StandardLibrary\nsignature:\n enum domain Who = {AA | BB | CC}\n domain Count subsetof Integer\n \
         domain Place subsetof Integer\n monitored wind: Boolean\n controlled place: Who -> Place\n \
         controlled count: Who -> Count\n controlled lock: Boolean\n controlled common: Count\n controlled sum: Integer\n \
         derived busy: Who -> Boolean\n static next: Who -> Who\ndefinitions:\n domain Count = {0 : 3}\n domain Place = {0 : 2}\n \
         function busy($w in Who) = count($w) > 0 and place($w) != 2\n \
         function next($w in Who) = if $w = AA then BB else if $w = BB then CC else AA endif endif\n",
    );
    let conditions = [
        "count($w) < 3",
        "lock",
        "not lock",
        "common > 0",
        "place(next($w)) = 1",
        "busy($w)",
        "busy(next($w))",
        "true",
        "wind",
        "count($w) = 0",
    ];
    let actions = [
        "count($w) := (count($w) + 1) mod 4",
        "count($w) := count($w) + 1",
        "count($w) := 3",
        "count(next($w)) := 0",
        "lock := not lock",
        "common := (common + 1) mod 4",
        "common := count($w)",
        "sum := (sum + 1) mod 3",
        "skip",
        "seq count($w) := 1 if count($w) = 1 then count($w) := 2 endif endseq",
        "choose $c in Count with $c > count($w) do count($w) := $c ifnone count($w) := 0",
    ];
    for who in ["A", "B", "C"] {
        let _ = writeln!(text, " rule r_{who}($w in Who) = switch place($w)");
        for place in 0..3 {
            let (condition, action, more) = (random.pick(&conditions), random.pick(&actions), random.below(3));
            let _ = write!(text, "  case {place}: if {condition} then par {action} ");
            if more > 0 {
                let _ = write!(text, "place($w) := {} ", (place + more) % 3);
            }
            let otherwise = random.pick(&["", "", "else count($w) := (count($w) + 1) mod 4", "else place($w) := 0"]);
            let _ = writeln!(text, "endpar {otherwise} endif");
        }
        let _ = writeln!(text, " endswitch");
    }
    let invariants = [
        "not (lock and common = 3)",
        "place(AA) != 2 or place(BB) != 2",
        "count(CC) < 3",
        "common < 3 or lock",
        "true",
    ];
    let _ = writeln!(text, " invariant inv_a over lock: {}", random.pick(&invariants));
    let _ = writeln!(text, " invariant inv_b over lock: {}", random.pick(&invariants));
    if random.below(4) == 0 {
        let _ = writeln!(text, " INVAR not (lock and place(BB) = 2)");
    }
    let guard = random.pick(&["true", "true", "place($w) != 2 or count($w) < 3", "busy($w) or not lock"]);
    let none = random.pick(&["", "", "ifnone lock := not lock"]);
    let _ = writeln!(
        text,
        " main rule r_Main = choose $w in Who with {guard} do switch $w case AA: r_A[AA] case BB: r_B[$w] case CC: r_C[CC] endswitch {none}"
    );
    text.push_str(
        "default init s0:\n function place($w in Who) = 0\n function count($w in Who) = 0\n function lock = false\n \
         function common = 0\n function sum = 0\n",
    );
    text
}

#[test]
fn random_agents_have_the_same_verdicts() {
    let seeds = sample::seeds(120, 1_000);
    let cases = seeds.end - seeds.start;
    let (mut reduced, mut violated) = (0, 0);
    for seed in seeds {
        let text = random_model(seed);
        let program = lowered(SourceFile::new("Agents.asm", text.clone()));
        let (whole, fewer) = agrees(&program, &text);
        reduced += u64::from(fewer < whole);
        let report = check(&program, &Options { partial_order: true, ..Options::default() });
        violated += u64::from(verdicts(&report).iter().any(|(_, verdict)| *verdict == 'V'));
    }
    assert!(reduced > cases / 10 && violated > cases / 4, "{reduced} reduced, {violated} violated");
}
