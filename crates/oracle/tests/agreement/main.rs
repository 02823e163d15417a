//! Machine and oracle agree: on random models, and on every model of library/ and examples/.
//!
//! Both run the same steps with the same inputs and choices; states, domains, faults, candidates, inputs asked for and
//! values of invariants must be the same. `GROUNDSTATE_FULL` takes long runs and many random models; `GROUNDSTATE_CASES` sets
//! how many random models, `GROUNDSTATE_STEPS` how long runs, `GROUNDSTATE_SEED` the first seed. A model on which they disagree is made small and printed.
#![allow(
    clippy::disallowed_methods,
    clippy::disallowed_macros,
    reason = "a test reads files and the environment, and tells what it found"
)]

mod compare;
mod convert;
mod world;

use std::collections::BTreeMap;
use std::panic::AssertUnwindSafe;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};

use compare::{Disagreement, Outcome, Plan};
use machine::EngineChoice;
use oracle::Bounds;
use syntax::{Severity, SourceFile};
use testkit::sample::{self, is_full as full, setting};
use testkit::{Disk, NoFiles, repository};

/// The oracle recurses as deep as the model: its threads have room.
const STACK: usize = 256 << 20;

/// What became of a text.
enum Verdict {
    /// It is no model.
    Rejected(String),
    Agreed(Outcome),
    Disagreed(Disagreement),
}

/// What became of all random models.
#[derive(Debug, Default)]
struct Total {
    rejected: u64,
    agreed: u64,
    steps: u64,
    held: u64,
    known: u64,
    faults: BTreeMap<&'static str, u64>,
}

impl Total {
    fn add(&mut self, outcome: Outcome) {
        self.agreed += 1;
        self.steps += outcome.steps;
        self.held += outcome.held;
        self.known += outcome.known;
        for (id, count) in outcome.faults {
            *self.faults.entry(id).or_default() += count;
        }
    }
}

/// Runs a text in both.
fn judge(text: &str, plan: Plan) -> Verdict {
    let attempt = AssertUnwindSafe(|| {
        let checked = model::check(SourceFile::new("Model.asm", text), &mut NoFiles);
        if let Some(error) = checked.diagnostics.iter().find(|found| found.severity == Severity::Error) {
            let at = checked.sources.position(error.primary.span);
            let source = checked.sources.text(error.primary.span);
            return Verdict::Rejected(format!("{}: {} {}: `{source}`", error.id, at, error.message));
        }
        let program = match program::lower(&checked.model) {
            Ok(program) => program,
            Err(faults) => return Verdict::Rejected(faults[0].message.clone()),
        };
        if let Err(fault) = program::verify(&program) {
            return Verdict::Disagreed(Disagreement::new("verifier", format!("{fault:?}")));
        }
        match compare::run(&checked.model, program, plan) {
            Ok(outcome) => Verdict::Agreed(outcome),
            Err(disagreement) => Verdict::Disagreed(disagreement),
        }
    });
    std::panic::catch_unwind(attempt).unwrap_or_else(|panic| {
        let text = panic.downcast_ref::<String>().cloned();
        let text = text.or_else(|| panic.downcast_ref::<&str>().map(|text| text.to_string())).unwrap_or_default();
        Verdict::Disagreed(Disagreement::new("panic", text))
    })
}

/// Runs with a deep stack.
fn deep<T: Send>(body: impl FnOnce() -> T + Send) -> T {
    std::thread::scope(|scope| {
        let thread = std::thread::Builder::new().stack_size(STACK).spawn_scoped(scope, body).expect("a thread");
        thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    })
}

#[test]
fn random_models() {
    let seeds = sample::seeds(100, 1_500);
    let (cases, first) = (seeds.end - seeds.start, seeds.start);
    let total = std::sync::Mutex::new(Total::default());
    let failures = std::sync::Mutex::new(Vec::new());
    let next = AtomicU64::new(0);
    let work = || {
        loop {
            let case = next.fetch_add(1, Ordering::Relaxed);
            if case >= cases || failures.lock().expect("unpoisoned").len() >= 5 {
                return;
            }
            let seed = first + case;
            let bounds = Bounds { iterations: 200, depth: 50, elements: 2000 };
            let engine = if seed.is_multiple_of(3) { EngineChoice::Interpreted } else { EngineChoice::Compiled };
            let plan = Plan { seed, steps: 6, bounds, engine };
            if std::env::var("GROUNDSTATE_TRACE").is_ok() {
                eprintln!("begin {seed}");
            }
            let piece = oracle::generate::model(seed, 2 + (seed % 3) as u32);
            let text = piece.to_string();
            let verdict = judge(&text, plan);
            if std::env::var("GROUNDSTATE_TRACE").is_ok() {
                eprintln!("end {seed}");
            }
            match verdict {
                Verdict::Rejected(reason) => {
                    total.lock().expect("unpoisoned").rejected += 1;
                    if std::env::var("GROUNDSTATE_REJECTED").is_ok() {
                        eprintln!("{seed}: {reason}");
                    }
                }
                Verdict::Agreed(outcome) => total.lock().expect("unpoisoned").add(outcome),
                Verdict::Disagreed(found) => {
                    let same = |text: &str| match judge(text, plan) {
                        Verdict::Disagreed(other) => other.kind == found.kind,
                        _ => false,
                    };
                    let small = oracle::reduce::reduce(piece, 3000, same).to_string();
                    let detail = match judge(&small, plan) {
                        Verdict::Disagreed(found) => found.detail,
                        _ => String::new(),
                    };
                    let report = format!(
                        "seed {seed}: {}\nat first: {}\n--- made small ---\n{detail}\n{small}",
                        found.kind, found.detail
                    );
                    failures.lock().expect("unpoisoned").push(report);
                }
            }
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..setting("GROUNDSTATE_THREADS", 2) {
            std::thread::Builder::new().stack_size(STACK).spawn_scoped(scope, work).expect("a thread");
        }
    });
    let total = total.into_inner().expect("unpoisoned");
    println!("{total:?}");
    let failures = failures.into_inner().expect("unpoisoned");
    assert!(failures.is_empty(), "machine and oracle disagree\n\n{}", failures.join("\n\n"));
    assert!(
        total.rejected * 20 <= cases,
        "too many of the generated models are refused: {} of {cases}",
        total.rejected
    );
    assert!(total.known * 4 > total.held, "compiled code knew only {} of {} invariants", total.known, total.held);
}

#[test]
fn models_of_the_library_and_the_examples() {
    let engines = [EngineChoice::Interpreted, EngineChoice::Compiled];
    let steps = setting("GROUNDSTATE_STEPS", if full() { 50 } else { 10 });
    // In the order of paths: examples, then the library.
    let models = ["examples", "library"].map(|folder| repository::files(folder, &["asm"])).concat();
    let models: Vec<_> = models.into_iter().flat_map(|path| engines.map(|engine| (path.clone(), engine))).collect();
    let (next, run) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let work = || {
        while let Some((path, engine)) = models.get(next.fetch_add(1, Ordering::Relaxed)) {
            let plan = Plan { seed: 1, steps, bounds: Bounds::default(), engine: *engine };
            let name = path.display().to_string();
            let checked = model::check(Disk::read(path).expect("a readable file"), &mut Disk);
            if checked.model.main.is_none() {
                continue;
            }
            let errors = checked.diagnostics.iter().filter(|found| found.severity == Severity::Error);
            let errors: Vec<&str> = errors.map(|found| found.message.as_str()).collect();
            assert!(errors.is_empty(), "{name}: {errors:?}");
            let program = program::lower(&checked.model).expect("small enough");
            match compare::run(&checked.model, program, plan) {
                Ok(_) => run.fetch_add(1, Ordering::Relaxed),
                Err(found) => panic!("machine and oracle disagree on {name}: {}\n{}", found.kind, found.detail),
            };
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..setting("GROUNDSTATE_THREADS", 2) {
            std::thread::Builder::new().stack_size(STACK).spawn_scoped(scope, work).expect("a thread");
        }
    });
    let run = run.into_inner();
    assert!(run > 5, "only {run} models found");
}

/// Collections that compiled code looks through and does not make: their order, what repeats in them, and which of their
/// elements is at fault.
#[test]
fn collections_that_are_not_made() {
    let terms = [
        ("if (exists $v in asSet([x + 1, 0]) with 6 mod $v = 0) then 1 else 2 endif", "division-by-zero"),
        ("if (forall $v in asSet([x + 1, x + 2, x + 1]) with 6 mod $v = 0) then 1 else 2 endif", ""),
        ("if (exists unique $v in asSet([x, x]) with $v = x) then 1 else 2 endif", ""),
        ("size(asSet([x, x, 1]))", ""),
        ("size(union({x, 1}, {$i in {0 : x} | $i != 2 : $i mod 3}))", ""),
        ("indexOf(union([x], [1, x, 5]), 5)", ""),
        ("indexOf([x, y, undef], undef)", ""),
        ("length([$a in {0 : 3}, $b in [x, 1, $a] | $a != $b : $a + $b])", ""),
        ("length([$a in [x, 3], $b in {x : $a} : $b])", ""),
        ("if contains(append([$i in {3 : x} : $i], x), x) then 1 else 0 endif", ""),
        ("let ($all = {$i in {0 : x} | $i > 1 : $i}) in size($all) + size({$j in $all | $j > 2 : $j}) endlet", ""),
        ("if isEmpty([$i in {x : 2} : $i]) then 7 else 8 endif", ""),
        // `y` is undefined in the first step
        ("if contains({x, 3}, y) then 1 else 2 endif", ""),
        ("if contains({x, undef}, y) then 1 else 2 endif", ""),
        ("if notin({2, x}, y) then 1 else 2 endif", ""),
        ("size({m : y})", "undefined-operand"),
    ];
    for (term, expected) in terms {
        let text = format!(
            "asm Model import StandardLibrary signature: controlled x: Integer controlled y: Integer\n\
             controlled m: Integer controlled s: Seq(Integer)\ndefinitions:\n\
             main rule r_Main = par y := {term} x := x + 1 s := append(s, x) endpar\n\
             default init s0: function x = 0 function s = [1]"
        );
        for engine in [EngineChoice::Interpreted, EngineChoice::Compiled] {
            let plan = Plan { seed: 3, steps: 6, bounds: Bounds::default(), engine };
            match deep(|| judge(&text, plan)) {
                Verdict::Rejected(why) => panic!("refused: {why}\n{text}"),
                Verdict::Disagreed(found) => panic!("{}: {}\n{text}", found.kind, found.detail),
                Verdict::Agreed(outcome) => {
                    let faults: Vec<&str> = outcome.faults.keys().copied().collect();
                    let expected: Vec<&str> = [expected].into_iter().filter(|id| !id.is_empty()).collect();
                    assert_eq!(faults, expected, "{text}");
                }
            }
        }
    }
}

/// What the generator does not write.
#[test]
fn models_without_definitions_and_with_lost_results() {
    let model = |declarations: &str, main: &str| {
        format!(
            "asm Model import StandardLibrary signature: controlled x: Integer controlled y: Integer\n\
             monitored m: Boolean abstract domain Door static door: Door\n{declarations}\n\
             main rule r_Main = {main}\ndefault init s0: function x = 0"
        )
    };
    let missing = "static limit: Integer static next: Door -> Door\ndefinitions:";
    let turbo = "definitions: turbo rule r_Count in Boolean = par x := x + 1 result := true endpar";
    let cases = [
        (model(missing, "par if m then y := limit endif x := x + 1 endpar"), "no-definition"),
        (model(missing, "if x > 2 then y := y + limit else x := x + 1 endif"), "no-definition"),
        (model(missing, "if m then if next(door) = door then skip endif else x := 1 endif"), "no-definition"),
        (model(turbo, "seq m <- r_Count() if m then y := x endif endseq"), ""),
        (model(turbo, "par m <- r_Count() x := 7 endpar"), "inconsistent-update"),
    ];
    for (text, expected) in cases {
        for engine in [EngineChoice::Interpreted, EngineChoice::Compiled] {
            let plan = Plan { seed: 3, steps: 20, bounds: Bounds::default(), engine };
            match deep(|| judge(&text, plan)) {
                Verdict::Rejected(why) => panic!("refused: {why}\n{text}"),
                Verdict::Disagreed(found) => panic!("{}: {}\n{text}", found.kind, found.detail),
                Verdict::Agreed(outcome) => {
                    let faults: Vec<&str> = outcome.faults.keys().copied().collect();
                    let expected: Vec<&str> = [expected].into_iter().filter(|id| !id.is_empty()).collect();
                    assert_eq!(faults, expected, "{text}");
                }
            }
        }
    }
}
