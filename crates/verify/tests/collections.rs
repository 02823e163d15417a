//! Sequences and sets that stand in pieces: on random models of them, explorers agree with the machine, and a search gives
//! the verdicts of one that holds them by number.
//!
//! The models edit sequences and sets in every way that is told apart (at both ends, of another location, twice, in a `seq`, with
//! elements that are in no domain, undef, nested), and look at them whole and in pieces.

use std::sync::Arc;

use machine::EngineChoice;
use program::Program;
use syntax::SourceFile;
use testkit::{NoFiles, Random, sample};
use verify::{EngineKind, Options, Outcome, Report, Subject, verify};

use crate::exploration::{Total, compare};
use crate::models::lowered;

const UPDATES: [&str; 40] = [
    "q(n + 4) := append(q(n + 4), $x)",
    "if isDef(q(n + 4)) then n := length(q(n + 4)) mod 2 else q(n + 4) := [] endif",
    "seq a := tail(a) n := first(a) mod 2 endseq",
    "seq a := prepend($x, a) n := last(a) mod 2 endseq",
    "seq q(n) := tail(q(n)) n := first(q(n)) mod 2 endseq",
    "seq t := excluding(t, 0) if not contains(t, 0) then n := 1 - n endif endseq",
    "a := append(a, $x)",
    "a := append(a, $x)",
    "a := append(b, $x)",
    "a := prepend($x, a)",
    "a := prepend($x, b)",
    "a := tail(a)",
    "a := tail(b)",
    "a := b",
    "a := []",
    "a := union(a, b)",
    "a := append(tail(a), $x)",
    "b := append(b, first(a))",
    "b := tail(b)",
    "b := append(b, last(a))",
    "b := append(b, 1 + $x)",
    "q($i) := append(q($i), $x)",
    "q($i) := append(q(1 - $i), $x)",
    "q(n) := prepend($x, q(n))",
    "q(n) := tail(q(n))",
    "s := including(s, ($x, $i))",
    "s := excluding(s, ($x, $i))",
    "s := including(s, (n, $i))",
    "s := including(s, ($x + 5, $i))",
    "s := {}",
    "t := including(t, $x)",
    "t := excluding(t, $x)",
    "t := including(excluding(t, $x), 1 - $i)",
    "c := append(c, $x)",
    "c := undef",
    "w := append(w, a)",
    "w := tail(w)",
    "n := length(a) mod 2",
    "n := first(q($i)) mod 2",
    "n := at(a, 1n) mod 2",
];

const GUARDS: [&str; 16] = [
    "length(a) < 3",
    "length(a) < 2",
    "length(b) < 2",
    "not isEmpty(a)",
    "not isEmpty(b)",
    "isEmpty(q($i))",
    "contains(s, ($x, $i))",
    "not contains(t, $x)",
    "notin(t, $x)",
    "first(b) = $x",
    "last(a) != $x",
    "contains(a, $x)",
    "n = $i",
    "a != b",
    "isDef(c)",
    "size(s) < 3",
];

fn rule(random: &mut Random, depth: u64) -> String {
    match random.below(if depth == 0 { 4 } else { 10 }) {
        0..4 => random.pick(&UPDATES).to_string(),
        4 | 5 => {
            let (guard, body) = (random.pick(&GUARDS), rule(random, depth - 1));
            format!("if {guard} then {body} endif")
        }
        6 => {
            let (guard, yes, no) = (random.pick(&GUARDS), rule(random, depth - 1), rule(random, depth - 1));
            format!("if {guard} then {yes} else {no} endif")
        }
        7 | 8 => format!("par {} {} endpar", rule(random, depth - 1), rule(random, depth - 1)),
        _ => format!("seq {} {} endseq", rule(random, depth - 1), rule(random, depth - 1)),
    }
}

fn model(seed: u64) -> String {
    let mut random = Random(seed);
    let guard = if random.below(2) == 0 { "true" } else { random.pick(&GUARDS) };
    let main = rule(&mut random, 3);
    let (invariant, starts) = (random.pick(&GUARDS), ["[]", "[1]", "[0, 2, 1]"]);
    let start = random.pick(&starts);
    format!(
        "asm Model import StandardLibrary signature: domain Small subsetof Integer domain Index subsetof Integer\n\
         controlled a: Seq(Small) controlled b: Seq(Small) controlled c: Seq(Small) controlled q: Index -> Seq(Small)\n\
         controlled s: Powerset(Prod(Small, Index)) controlled t: Powerset(Small) controlled w: Seq(Seq(Small))\n\
         controlled n: Index\n\
         definitions: domain Small = {{0 : 2}} domain Index = {{0 : 1}}\n\
         invariant inv_some over a: (forall $x in Small, $i in Index with n = 1 or {invariant})\n\
         main rule r_Main = choose $x in Small, $i in Index with {guard} do {main}\n\
         default init s0: function a = {start} function b = [] function c = [] function q($i in Index) = []\n\
         function s = {{}} function t = {{}} function w = [] function n = 0"
    )
}

fn program(text: &str) -> Option<Arc<Program>> {
    let checked = model::check(SourceFile::new("Model.asm", text), &mut NoFiles);
    assert!(checked.diagnostics.is_empty(), "{text}\n{:?}", checked.diagnostics);
    program::lower(&checked.model).ok().map(Arc::new)
}

fn report(program: &Arc<Program>, options: &Options) -> Report {
    verify(program, options, &mut |_| true).expect("there is an initial state")
}

/// How many states and steps there are, and what came of each check, with the length of a counterexample.
fn told(report: &Report) -> (u64, u64, Vec<(Subject, i64)>) {
    let length = |outcome: &Outcome| match outcome {
        Outcome::Violated(trace) => trace.steps.len() as i64,
        Outcome::Holds => -1,
        Outcome::Unknown(_) => -2,
    };
    let verdicts = report.verdicts.iter().map(|verdict| (verdict.subject, length(&verdict.outcome))).collect();
    (report.progress.states, report.progress.transitions, verdicts)
}

/// Searches that hold collections in pieces, by number, and make their steps in any way, find the same.
fn agrees(program: &Arc<Program>, most: &Options) -> Report {
    let pieces = report(program, most);
    let others = [
        // No elements are interchangeable: this holds them by number, and is a search like any other.
        Options { symmetry: true, ..most.clone() },
        Options { forgetful: true, ..most.clone() },
        Options { steps: EngineChoice::Interpreted, ..most.clone() },
        Options { steps: EngineChoice::Compiled, ..most.clone() },
        Options { workers: 2, alone: Some(0), ..most.clone() },
    ];
    for other in others {
        assert_eq!(told(&pieces), told(&report(program, &other)), "{other:?}");
    }
    pieces
}

#[test]
fn explorers_of_pieces_do_what_the_machine_does() {
    let mut total = Total::default();
    let full = sample::is_full();
    for seed in sample::seeds(400, 6_000) {
        let text = model(seed);
        let attempt = std::panic::AssertUnwindSafe(|| {
            let program = program(&text).expect("it can be lowered");
            let mut widening = explore::Widening::default();
            let compiles = full || seed % 16 == 0;
            while let Err(explore::Trouble::TooNarrow(more)) = compare(&program, &mut widening, compiles, &mut total) {
                widening.merge(&more);
            }
        });
        if let Err(panic) = std::panic::catch_unwind(attempt) {
            panic!("seed {seed}: {}\n{text}", panic.downcast_ref::<String>().map_or("", String::as_str));
        }
    }
    assert!(total.was_thorough(), "{total:?}");
}

#[test]
fn searches_find_the_same_in_pieces_and_by_number() {
    let most = Options { engine: EngineKind::Explicit, max_depth: 4, max_states: 2_000, ..Options::default() };
    let mut found = [0, 0];
    for seed in sample::seeds(60, 3_000) {
        let text = model(seed);
        let attempt = std::panic::AssertUnwindSafe(|| {
            let report = agrees(&program(&text).expect("it can be lowered"), &most);
            found[0] += report.progress.states;
            found[1] += u64::from(told(&report).2.iter().any(|(_, length)| *length > 0));
        });
        if let Err(panic) = std::panic::catch_unwind(attempt) {
            panic!("seed {seed}: {}\n{text}", panic.downcast_ref::<String>().map_or("", String::as_str));
        }
    }
    assert!(found[0] > 1_000 && found[1] > 10, "{found:?}");
}

/// A model with these functions, rule and initial values, in which every state is explored.
fn whole(functions: &str, main: &str, init: &str) -> Report {
    let text = format!(
        "asm Model\nimport StandardLibrary\nsignature:\n domain Small subsetof Integer\n dynamic abstract domain Part\n {functions}\n\
         definitions:\n domain Small = {{0 : 3}}\n main rule r_Main = {main}\ndefault init s0:\n {init}\n"
    );
    agrees(
        &lowered(SourceFile::new("Model.asm", text)),
        &Options { engine: EngineKind::Explicit, ..Options::default() },
    )
}

/// The states by number and in one word, where the search has found how long sequences become.
#[test]
fn a_sequence_that_grows_late_is_found_longer() {
    // 4 + 16 + … + 4⁷ sequences, and the one in which it begins; a longer one is a step from the last of all.
    let functions = "controlled a: Seq(Small)\n controlled done: Boolean";
    let grows = "choose $x in Small with length(a) < 7 do a := append(a, $x) ifnone \
                 if a = [3, 3, 3, 3, 3, 3, 3] and not done then par a := [0, 1, 2, 3, 0, 1, 2, 3, 0] done := true endpar endif";
    let report = whole(functions, grows, "function a = []\n function done = false");
    assert_eq!(report.progress.states, (0..8).map(|length| 4u64.pow(length)).sum::<u64>() + 1);
    assert_eq!(report.width.0, 1, "{:?}", report.width);
}

#[test]
fn a_set_of_elements_that_come_up_has_numbers() {
    let functions = "controlled s: Powerset(Part)\n controlled n: Small";
    let main = "if n < 3 then extend Part with $p do par s := including(s, $p) n := n + 1 endpar endif";
    assert_eq!(whole(functions, main, "function s = {}\n function n = 0").progress.states, 4);
}

#[test]
fn undef_and_what_is_in_no_domain_has_numbers() {
    let functions = "controlled a: Seq(Prod(Small, Small))\n controlled n: Small\n controlled b: Seq(Small)";
    let main = "if n < 3 then par n := n + 1 a := append(a, (n, 7 * n)) if n = 2 then b := undef else b := append(b, n) endif endpar endif";
    assert_eq!(whole(functions, main, "function a = []\n function b = []\n function n = 0").progress.states, 4);
}
