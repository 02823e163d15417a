//! Runs that solvers find from the initial states: what is refuted, how soon, and that nothing right ever is.
//!
//! Solvers that are not installed are left out. No pairs are searched before, so that the solvers alone find what there is.

use std::collections::BTreeSet;
use std::sync::Arc;

use program::Program;
use refine::{Coupling, Ended, Left, Options, Provers, Refutation, Report, Runs, Verdict, Why, refute};
use solve::session::Solvers;
use testkit::sample::seeds;
use testkit::solver::solvers;
use testkit::{Random, solver::Installed};

use crate::enumerated::Enumerated;
use crate::induction::coupled;
use crate::naive::{Graph, Mapped, State, changed, graph, machine_of, rule};
use crate::small::{machine, report};

pub fn sought(mut by: Vec<impl Solvers>, coupling: &Coupling, pairs: u64, depth: u64) -> Report {
    let solvers = by.iter_mut().map(|solver| -> &mut dyn Solvers { solver }).collect();
    let options = Options { max_pairs: pairs, ..Options::default() };
    refute(coupling, &options, Provers { solvers, seconds: 20, depth }, &mut |_| true).expect("it begins")
}

fn found(report: Report) -> (Refutation, Runs) {
    match (report.verdict, report.runs) {
        (Verdict::DoesNot(refutation), Some(runs)) => (*refutation, *runs),
        other => panic!("{other:#?}"),
    }
}

/// Some solver that is installed, the other one each time.
pub fn one_of(random: u64) -> Option<Vec<Installed>> {
    let mut all = solvers(false);
    (!all.is_empty()).then(|| vec![all.swap_remove(random as usize % all.len())])
}

/// A wrong machine is refuted by a run of so many steps, which both machines make again.
#[track_caller]
fn refuted(one: &Arc<Program>, other: &Arc<Program>, text: &str, steps: u64) {
    let Some(by) = one_of(steps) else { return };
    let (refutation, runs) = found(sought(by, &coupled(one, other, text), 0, 12));
    assert_eq!(runs.found.map(|(steps, _)| steps), Some(steps), "{text}");
    let made = refutation.runs[refine::CONCRETE].steps.len() as u64;
    assert!((steps.min(1)..=steps).contains(&made) && !matches!(refutation.ended, Ended::Waits(_)), "{refutation:#?}");
}

/// Nothing is found of a right machine, and it is not known.
#[track_caller]
fn stands(one: &Arc<Program>, other: &Arc<Program>, text: &str, depth: u64) {
    let Some(by) = one_of(depth) else { return };
    let report = sought(by, &coupled(one, other, text), 0, depth);
    assert_eq!(report.verdict, Verdict::Unknown(vec![Why::NoRun]), "{text}");
    let runs = report.runs.expect("runs");
    assert_eq!((runs.depth, &runs.left, &runs.found), (depth, &None, &None), "{text}");
}

fn peak(rule: &str) -> Arc<Program> {
    let signature = "monitored reading: Integer controlled peak: Integer";
    machine(signature, &format!("main rule r_Main = {rule}"), "function peak = 0")
}

#[test]
fn inputs_without_bounds() {
    let one = peak("peak := max(peak, reading)");
    stands(&one, &peak("if reading > peak then peak := reading endif"), "same peak;", 6);
    refuted(&one, &peak("if reading > peak + 1 then peak := reading endif"), "same peak; diagrams 1:1;", 1);
    // Where the abstract machine may wait, only the largest number is one too many.
    refuted(&one, &peak("if reading > peak + 1 then peak := reading endif"), "same peak;", 2);
    refuted(&one, &peak("if reading >= 0 then peak := reading endif"), "same peak;", 2);
    refuted(&one, &peak("if reading > peak then peak := reading + 1 endif"), "same peak;", 1);
    refuted(&one, &peak("if reading > peak and peak < 777 then peak := reading endif"), "same peak; diagrams 1:1;", 2);
    let other = "if reading > peak and reading != 123456789 then peak := reading endif";
    refuted(&one, &peak(other), "same peak; diagrams 1:1;", 1);
}

/// A counter up to a number that no search reaches, and a counter of two digits of six.
fn digits(rule: &str, init: &str) -> [Arc<Program>; 2] {
    let one = machine("controlled n: Integer", "main rule r_Main = n := (n + 1) mod 1000000000000", "function n = 0");
    let signature = "controlled low: Integer controlled high: Integer controlled base: Integer";
    [one, machine(signature, &format!("main rule r_Main = {rule}"), &format!("function high = 0 {init}"))]
}

/// The first fault shows behind six steps.
#[test]
fn faults_that_lie_deep() {
    const COUPLING: &str = "couple abstract.n = 6 * concrete.high + concrete.low; diagrams 1:1;";
    let rule = "if low < base then low := low + 1 else par low := 0 high := (high + 1) mod 166666666666 endpar endif";
    let begun = "function low = 0 function base = 5";
    let check = |rule: &str, init: &str, steps: Option<u64>| {
        let [one, other] = digits(rule, init);
        match steps {
            Some(steps) => refuted(&one, &other, COUPLING, steps),
            None => stands(&one, &other, COUPLING, 9),
        }
    };
    check(rule, begun, None);
    check(&rule.replace("high + 1", "high + 2"), begun, Some(6));
    check(&rule.replace("low := 0", "skip"), begun, Some(6));
    check(&rule.replace("low < base", "low <= base"), begun, Some(7));
    check(&rule.replace("low < base", "low < base and high < 1"), begun, Some(7));
    // A value that it begins with, at which the coupling does not look.
    check(rule, "function low = 0 function base = 4", Some(5));
    check(rule, "function low = 0 function base = 7", Some(8));
}

/// Readings are added up, in one register or in two that take turns.
#[test]
fn registers_that_take_turns() {
    let signature = "monitored reading: Integer controlled sum: Integer controlled spare: Integer controlled turn: Integer \
                     out odd: Boolean";
    let one = machine(
        "monitored reading: Integer controlled sum: Integer out odd: Boolean",
        "main rule r_Main = if reading > 0 and reading < 1000 and sum < 1000000 then
            par sum := sum + reading odd := not odd endpar endif",
        "function sum = 0 function odd = false",
    );
    let rule = "if reading > 0 and reading < 1000 and sum + spare < 1000000 then
        par if turn = 0 then par sum := sum + reading turn := 1 endpar
            else par spare := spare + reading turn := if turn < 5 then turn + 1 else 0 endif endpar endif
            odd := not odd endpar endif";
    let coupling = "couple abstract.sum = concrete.sum + concrete.spare; same odd; diagrams 1:1;";
    let check = |from: &str, to: &str, steps: Option<u64>| {
        let text = format!("main rule r_Main = {}", rule.replace(from, to));
        let other =
            machine(signature, &text, "function sum = 0 function spare = 0 function turn = 0 function odd = false");
        match steps {
            Some(steps) => refuted(&one, &other, coupling, steps),
            None => stands(&one, &other, coupling, 6),
        }
    };
    check("", "", None);
    // The fifth reading, the largest one, a wrong output, and a sum that cannot be computed.
    check("spare := spare + reading", "spare := spare + if turn = 4 then 0 else reading endif", Some(5));
    check("reading < 1000", "reading < 999", Some(1));
    check("odd := not odd", "odd := if turn = 3 then odd else not odd endif", Some(4));
    check("turn + 1 else", "turn + 1 + idiv(0, 4 - turn) else", Some(5));
    check(
        "spare := spare + reading",
        "par spare := spare + reading if turn = 2 and reading = 77 then odd := odd endif endpar",
        Some(3),
    );
}

#[test]
fn several_steps_for_one_and_answers_that_are_chosen() {
    let one = peak("peak := max(peak, reading)");
    let latched = |rule: &str| {
        machine(
            "monitored reading: Integer controlled peak: Integer controlled seen: Integer controlled busy: Boolean",
            &format!("main rule r_Main = {rule}"),
            "function peak = 0 function seen = 0 function busy = false",
        )
    };
    let two = "if busy then par busy := false if seen > peak then peak := seen endif endpar
        else par busy := true seen := reading endpar endif";
    let coupling = "same peak; segment not concrete.busy; diagrams 1:2;";
    stands(&one, &latched(two), coupling, 6);
    refuted(&one, &latched(&two.replace("peak := seen", "peak := reading")), coupling, 2);
    refuted(&one, &latched(&two.replace("seen > peak", "seen > peak and peak < 5")), coupling, 4);
    let chosen = machine(
        "controlled n: Integer",
        "main rule r_Main = choose $x in {1 : 3} with true do if n < 1000000 then n := n + $x else n := 0 endif",
        "function n = 0",
    );
    let with = |step: &str| {
        let rule = format!("main rule r_Main = if n < 1000000 then n := n + {step} else n := 0 endif");
        machine("monitored quick: Boolean controlled n: Integer", &rule, "function n = 0")
    };
    stands(&chosen, &with("(if quick then 3 else 1 endif)"), "same n;", 6);
    refuted(&chosen, &with("(if quick and n > 8 then 4 else 2 endif)"), "same n;", 6);
    let half = machine("controlled n: Integer", "main rule r_Main = n := (n + 1) mod 1000000", "function n = 0");
    let twice = |by: &str| {
        machine("controlled n: Integer", &format!("main rule r_Main = n := (n + {by}) mod 1000000"), "function n = 0")
    };
    stands(&half, &twice("2"), "same n; diagrams 2:1;", 6);
    refuted(&half, &twice("if n = 8 then 3 else 2 endif"), "same n; diagrams 2:1;", 5);
    refuted(&half, &twice("if n = 8 then 3 else 2 endif"), "same n; diagrams 1..2:1;", 5);
}

/// A variant is one that decreases; without one the abstract machine may stand still as long as the run is.
#[test]
fn the_abstract_machine_may_stand_still() {
    let one = machine("controlled on: Boolean", "main rule r_Main = on := not on", "function on = false");
    let slow = |rule: &str| {
        machine(
            "monitored delay: Integer controlled left: Integer controlled on: Boolean",
            &format!("main rule r_Main = {rule}"),
            "function on = false function left = 0",
        )
    };
    let rule = "if left > 0 then left := left - 1 else par on := not on left := delay endpar endif";
    for coupling in ["same on; variant concrete.left;", "same on;", "same on; allow waiting;"] {
        stands(&one, &slow(rule), coupling, 6);
    }
    refuted(&one, &slow(rule), "same on; variant - concrete.left;", 2);
    refuted(&one, &slow(rule), "same on; variant concrete.left - 3;", 2);
    refuted(&one, &slow(&rule.replace("left - 1", "left")), "same on; variant concrete.left;", 2);
    stands(&one, &slow(&rule.replace("left - 1", "left + 0")), "same on;", 6);
}

#[test]
fn inputs_that_are_terms_or_free_or_not_looked_at() {
    let one = machine(
        "monitored level: Integer monitored go: Boolean controlled high: Integer",
        "main rule r_Main = if go then high := level else skip endif",
        "function high = 0",
    );
    let with = |rule: &str| {
        let signature = "monitored raw: Integer monitored go: Boolean controlled high: Integer";
        machine(signature, &format!("main rule r_Main = {rule}"), "function high = 0")
    };
    let right = with("if go and raw < 1000 then high := raw + 1 else skip endif");
    let coupling = "same high; input abstract.level = concrete.raw + 1;";
    stands(&one, &right, coupling, 5);
    refuted(&one, &with("if go and raw < 1000 then high := raw + 2 else skip endif"), coupling, 1);
    refuted(&one, &with("if raw = 12345 then high := 7 else skip endif"), coupling, 1);
    // Who ignores an input must answer each value of it.
    refuted(&one, &with("if raw < 1000 and raw > 7 then high := raw + 1 else skip endif"), coupling, 1);
    stands(
        &one,
        &with("if raw < 1000 and raw > 7 then high := raw + 1 else skip endif"),
        &format!("{coupling} free abstract.go;"),
        5,
    );
}

/// An input that the initial state has looked at keeps its value in the first step; later it may differ.
#[test]
fn what_an_initial_state_looked_at_is_kept() {
    let one = machine("controlled n: Integer", "main rule r_Main = n := (n + 1) mod 3", "function n = 0");
    let with = |at: &str| {
        let rule = format!("main rule r_Main = n := if n = {at} and begun != level then 2 else (n + 1) mod 3 endif");
        machine(
            "monitored level: Integer controlled begun: Integer controlled n: Integer",
            &rule,
            "function n = 0 function begun = level",
        )
    };
    let check = |at: &str, steps: Option<u64>| {
        let Some(by) = one_of(steps.unwrap_or(0)) else { return };
        let coupling = coupled(&one, &with(at), "same n; diagrams 1:1;");
        let mut options = Options { max_pairs: 0, ..Options::default() };
        let extent = &mut options.extents[refine::CONCRETE];
        let level = with(at).find_function("level", 0).expect("an input");
        // The initial states have to be finitely many.
        extent.bounds.insert(level, [3, 5, 8].map(machine::Value::Integer).to_vec());
        extent.assumed.insert(level, ("level in {3, 5, 8}".to_string(), "here".to_string()));
        let mut by = by;
        let solvers = by.iter_mut().map(|solver| -> &mut dyn Solvers { solver }).collect();
        let provers = Provers { solvers, seconds: 20, depth: 5 };
        let runs = refute(&coupling, &options, provers, &mut |_| true).expect("it begins").runs.expect("runs");
        assert_eq!(runs.found.map(|(steps, _)| steps), steps, "{at}");
        options.max_pairs = u64::MAX;
        let whole = refine::refine(&coupling, &options, &mut |_| true).expect("it begins");
        let refuted = match whole.verdict {
            Verdict::DoesNot(refutation) => Some(refutation.runs[refine::CONCRETE].steps.len() as u64),
            _ => None,
        };
        assert_eq!(refuted, steps, "{at}");
    };
    check("0", Some(4));
    check("1", None);
    check("2 and begun = 8", Some(3));
}

#[test]
fn what_is_not_looked_at_is_told() {
    let one = peak("peak := max(peak, reading)");
    let check = |one: &Arc<Program>, other: &Arc<Program>, coupling: &str, is_it: &dyn Fn(&Left) -> bool| {
        let Some(by) = one_of(0) else { return };
        let report = sought(by, &coupled(one, other, coupling), 0, 4);
        assert_eq!(report.verdict, Verdict::Unknown(vec![Why::NoRun]), "{coupling}");
        let left = report.runs.expect("runs").left;
        assert!(left.as_ref().is_some_and(is_it), "{coupling}: {left:?}");
    };
    let names = |what: &'static str| move |left: &Left| matches!(left, Left::Outside(_, outside) if outside.what.contains(what));
    let list = machine(
        "monitored reading: Integer controlled peak: Integer controlled all: Seq(Integer)",
        "main rule r_Main = all := append(all, reading)",
        "function peak = 0 function all = []",
    );
    check(&one, &list, "same peak; allow waiting;", &names("Seq(Integer)"));
    check(&one, &peak("peak := reading"), "same peak; free abstract.reading;", &names("input reading"));
    let any = peak("choose $x in Integer with true do peak := $x");
    check(&any, &peak("peak := 1"), "same peak;", &names("infinitely many"));
    // The machine cannot go through what the concrete machine chooses.
    check(&one, &any, "same peak;", &|left| matches!(left, Left::Unclear(1, Why::Unbounded(1, _))));
}

/// The least number of steps of a run that leaves all runs of the abstract machine: each concrete step is matched by one or by none.
fn shortest(one: &(State, Graph), other: &(State, Graph), most: u64, mapped: Mapped) -> Option<u64> {
    let mut last = BTreeSet::from([(other.0, BTreeSet::from([one.0]))]);
    for steps in 1..=most {
        let mut next = BTreeSet::new();
        for (there, states) in &last {
            for go in [false, true] {
                let inputs = mapped(go, *there);
                for to in &other.1[&(*there, go)] {
                    let made = states.iter().flat_map(|state| one.1[&(*state, inputs)].iter().chain([state]));
                    let made: BTreeSet<State> = made.filter(|state| state.0 == to.0).copied().collect();
                    if made.is_empty() {
                        return Some(steps);
                    }
                    next.insert((*to, made));
                }
            }
        }
        last = next;
    }
    None
}

/// Makes a report of runs of so many steps.
type Seeks<'s> = &'s dyn Fn(&Coupling, u64) -> Option<Report>;

/// It finds what a naive judge finds, and as soon.
#[test]
fn runs_are_those_of_a_naive_judge() {
    found_as_soon(seeds(60, 1500), 3, &|coupling, depth| Some(sought(vec![Enumerated], coupling, 0, depth)));
}

#[test]
fn so_they_are_by_solvers() {
    found_as_soon(seeds(12, 300), 5, &|coupling, depth| Some(sought(one_of(depth)?, coupling, 0, depth)));
}

fn found_as_soon(cases: std::ops::Range<u64>, depth: u64, seeks: Seeks<'_>) {
    let couplings: [(&str, Mapped); 3] = [
        ("same n; allow waiting;", |go, _| go),
        ("same n; allow waiting; input abstract.go = not concrete.go;", |go, _| !go),
        ("same n; input abstract.go = (concrete.go or concrete.n = 1);", |go, (n, _)| go || n == 1),
    ];
    let (mut counts, mut silent) = ([0; 2], 0);
    for seed in cases.clone() {
        let mut random = Random(seed * 15_485_863 + 11);
        let abstractly = rule(&mut random);
        let concretely = if random.below(3) == 0 { rule(&mut random) } else { changed(&mut random, &abstractly) };
        let (one, other) = (machine_of(&abstractly), machine_of(&concretely));
        let (text, mapped) = &couplings[random.below(couplings.len() as u64) as usize];
        let Some(report) = seeks(&coupled(&one, &other, text), depth) else { return };
        let of = || format!("seed {seed}: {text}\nabstract {abstractly}\nconcrete {concretely}\n{:#?}", report.runs);
        let expected = shortest(&graph(&one), &graph(&other), depth, *mapped);
        if let Verdict::Vacuous(_) = report.verdict {
            continue;
        }
        let runs = report.runs.as_ref().expect("runs");
        // Where there is too much to try, it says how far it came; that far nothing is missed.
        if let (Some(Left::Silent(..) | Left::Outside(..)), None) = (&runs.left, &runs.found) {
            assert!(expected.is_none_or(|steps| steps > runs.depth), "{}", of());
            silent += 1;
            continue;
        }
        assert_eq!(runs.found.as_ref().map(|(steps, _)| *steps), expected, "{}", of());
        assert_eq!(matches!(report.verdict, Verdict::DoesNot(_)), expected.is_some(), "{}", of());
        assert_eq!(runs.left, None, "{}", of());
        counts[usize::from(expected.is_some())] += 1;
    }
    let all = cases.count();
    assert!(counts[0] * 5 > all && counts[1] * 5 > all && silent * 100 <= all, "{counts:?}, {silent} silent");
}

/// What it refutes the search refutes, whatever diagrams are.
#[test]
fn the_search_is_never_contradicted() {
    let couplings = [
        "same n;",
        "same n, h;",
        "same n; variant if concrete.h then 1 else 0 endif;",
        "same n; diagrams 1..2:1, 1:2; allow waiting;",
        "same n; segment not concrete.h; diagrams 0..1:1..3; allow waiting;",
        "same n; segment not concrete.h; diagrams 0..1:1..2; allow waiting;",
        "same h; couple abstract.n <= concrete.n; allow waiting;",
        "same n, h; free abstract.go;",
        "same n; input abstract.go = concrete.h; allow waiting;",
        "same n; input abstract.go = (concrete.go and concrete.n = 0); diagrams 0..2:1..2; allow waiting;",
    ];
    let (mut counts, mut outside) = ([0; 3], 0);
    let cases = seeds(60, 1500);
    for seed in cases.clone() {
        let mut random = Random(seed * 32_452_843 + 7);
        let abstractly = rule(&mut random);
        let concretely = if random.below(3) == 0 { rule(&mut random) } else { changed(&mut random, &abstractly) };
        let (one, other) = (machine_of(&abstractly), machine_of(&concretely));
        let text = random.pick(&couplings);
        let found = sought(vec![Enumerated], &coupled(&one, &other, text), 0, 3);
        let expected = report(&one, &other, Some(text)).verdict;
        let of = || format!("seed {seed}: {text}\nabstract {abstractly}\nconcrete {concretely}\n{:#?}", found.runs);
        match (&found.verdict, &expected) {
            (Verdict::DoesNot(_), Verdict::DoesNot(_)) => counts[0] += 1,
            (Verdict::Unknown(_), _) => {
                match &found.runs.as_ref().expect("runs").left {
                    None | Some(Left::Silent(..)) => counts[1] += 1,
                    // More than may be tried: it is said.
                    Some(Left::Outside(..)) => outside += 1,
                    Some(_) => panic!("{}", of()),
                }
            }
            (Verdict::Vacuous(_), _) => counts[2] += 1,
            _ => panic!("{}\n{expected:?}", of()),
        }
    }
    let all = cases.count();
    assert!(counts[0] * 5 > all && counts[1] * 5 > all && outside * 50 <= all, "{counts:?} {outside}");
}
