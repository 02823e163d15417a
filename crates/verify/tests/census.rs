//! States packed more tightly while a search goes on: it finds the same, whenever it counts the values of locations, and however often
//! these turn out to be more.

#![allow(clippy::disallowed_methods, reason = "a test reads the repository's own models")]

use std::fmt::Write;
use std::sync::Arc;

use program::Program;
use syntax::SourceFile;
use testkit::repository;
use testkit::sample::seeds;
use verify::{EngineKind, Options, Report, Stop, verify};

use crate::models::{Disk, lowered};

/// LIMIT: the states of a model.
const STATES: u64 = 40_000;

fn check(program: &Arc<Program>, options: &Options) -> Report {
    let options = Options { engine: EngineKind::Explicit, ..options.clone() };
    verify(program, &options, &mut |_| true).expect("there is an initial state")
}

/// What a report says: how many states and steps there are, each verdict with its run, which rules never ran.
fn told(report: &Report) -> String {
    let progress = &report.progress;
    let verdicts: Vec<_> = report.verdicts.iter().map(|verdict| (&verdict.subject, &verdict.outcome)).collect();
    let counts = (progress.states, progress.transitions, progress.depth, progress.blocked, report.complete);
    format!("{counts:?} {verdicts:#?} {:?}", report.unreachable)
}

/// The search finds the same with a census after its first round and later, by any number of workers; returns how many words its states had, and
/// the fewest that they came to have; of a model that is too large, neither.
fn agrees(program: &Arc<Program>, options: &Options) -> (usize, usize) {
    let plain = check(
        program,
        &Options { census: Some(u64::MAX), max_states: options.max_states.min(STATES), ..options.clone() },
    );
    if plain.stop == Some(Stop::States) {
        return (0, 0);
    }
    let mut fewest = plain.width.0;
    // Levels are small: workers share them only if they always do.
    for (census, workers, alone) in [(0, 1, 0), (0, 2, 64), (0, 2, 0), (1 << 16, 1, 0), (1 << 17, 3, 8)] {
        let report = check(program, &Options { census: Some(census), workers, alone: Some(alone), ..options.clone() });
        assert_eq!(told(&report), told(&plain), "census after {census} bytes, {workers} workers, alone below {alone}");
        fewest = fewest.min(report.width.0);
    }
    (plain.width.0, fewest)
}

/// A random machine whose cells count up to different bounds, some of them in large steps, with a register that depends on all of them, a
/// sequence that grows late, and a cell that wakes up late.
fn counters(seed: u64) -> Arc<Program> {
    let mut random = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut below = |bound: u64| {
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (random >> 33) % bound
    };
    let cells = 3 + below(2);
    let mut text = format!(
        "asm Counters\nimport StandardLibrary\nimport CTLLibrary\nimport LTLLibrary\nsignature:\n domain Cell subsetof Integer\n monitored slow: Boolean\n \
         controlled count: Cell -> Integer\n controlled most: Cell -> Integer\n controlled sum: Integer\n \
         controlled asleep: Cell -> Integer\n controlled trail: Seq(Integer)\n controlled phase: Integer\ndefinitions:\n \
         domain Cell = {{1 : {cells}}}\n"
    );
    let (reached, late) = (below(20), 1 + below(3));
    let _ = write!(
        text,
        " invariant inv_sum over sum: sum != {reached}\n invariant inv_trail over trail: length(trail) < {}\n \
         CTLSPEC ag(ef(sum = 0))\n LTLSPEC g(sum >= 0)\n main rule r_Main = par\n",
        1 + below(4)
    );
    let _ = write!(
        text,
        " phase := (phase + {}) mod {}\n choose $c in Cell with count($c) < most($c) do par count($c) := count($c) + 1 \
         sum := (sum * {} + $c) mod {} if count($c) = {late} then par if $c = 1 then asleep($c) := sum endif trail := if length(trail) < 3 then \
         append(trail, $c) else trail endif endpar endif if slow then most($c) := most($c) - 1 endif endpar\n endpar\n\
         default init s0:\n function sum = 0\n function phase = 0\n function trail = []\n function asleep($c in Cell) = 7\n \
         function count($c in Cell) = 0\n function most($c in Cell) = switch($c)",
        1 + below(3),
        1 + below(6),
        1 + below(3),
        2 + below(20)
    );
    for cell in 1..=cells {
        let _ = write!(text, " case {cell}: {}", 1 + below(3));
    }
    text.push_str(" endswitch\n");
    lowered(SourceFile::new("Counters.asm", text))
}

#[test]
fn random_counters_are_found_alike() {
    let seeds = seeds(30, 300);
    let (mut shorter, count) = (0, seeds.clone().count());
    for seed in seeds {
        let (before, after) = agrees(&counters(seed), &Options::default());
        shorter += usize::from(after < before);
    }
    assert!(2 * shorter > count, "only {shorter} of {count} models came to have shorter states");
}

#[test]
fn limits_end_the_search_where_they_did() {
    for options in [
        Options { first: true, ..Options::default() },
        Options { max_depth: 4, ..Options::default() },
        Options { forgetful: true, ..Options::default() },
        Options { steps: machine::EngineChoice::Compiled, ..Options::default() },
    ] {
        for seed in 100..106 {
            agrees(&counters(seed), &options);
        }
    }
}

#[test]
fn the_library_is_verified_alike() {
    for (name, most) in [("Queue", 4), ("SendingInTicks", 4)] {
        let path = repository::root().join(format!("library/verification/{name}.asm"));
        let program = lowered(Disk::read(&path).expect("the model is there"));
        let (before, after) = agrees(&program, &Options::default());
        assert!(after <= most && before > 2 * most, "{name}: {before} words, then {after}");
    }
}
