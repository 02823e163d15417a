//! Invariants as hypotheses of a proof: each is proved before it is used, and none that is false lets a wrong refinement through.

use std::sync::Arc;

use program::Program;
use refine::{ABSTRACT, CONCRETE, Verdict};
use testkit::Random;
use testkit::sample::seeds;

use crate::induction::{proved, refines, stuck};
use crate::naive::{changed, machine_with, rule};
use crate::small::{machine, report};

/// Which invariants are used, and which are not, with the reasons.
#[track_caller]
fn known(one: &Arc<Program>, other: &Arc<Program>, coupling: &str, used: &[(usize, &str)], unused: &[&str]) {
    let Some(report) = proved(one, other, coupling) else { return };
    let proof = report.proof.expect("a proof");
    let has: Vec<(usize, &str)> =
        proof.known.iter().filter(|one| one.unused.is_none()).map(|one| (one.side, one.name.as_str())).collect();
    assert_eq!(has, used, "{:#?}", proof.known);
    let has_not: Vec<String> =
        proof.known.iter().filter_map(|one| Some(format!("{}: {}", one.name, one.unused.as_ref()?))).collect();
    assert_eq!(has_not, unused);
    for (_, name) in used {
        let name = format!("{name} kept");
        assert!(proof.obligations.iter().any(|obligation| obligation.name == name && obligation.is_accepted()));
    }
}

const SIGNATURE: &str = "monitored reading: Integer controlled seen: Integer controlled peak: Integer";
const FILTER: &str = "if peak < seen then if seen - peak > 100 then peak := peak + 100 else peak := seen endif
    else seen := max(seen, reading) endif";
const COUPLING: &str = "couple abstract.peak = concrete.seen; variant concrete.seen - concrete.peak;";

fn peak() -> Arc<Program> {
    let signature = "monitored reading: Integer controlled peak: Integer";
    machine(signature, "main rule r_Main = peak := max(peak, reading)", "function peak = 0")
}

fn filter(invariants: &str, rule: &str) -> Arc<Program> {
    let definitions = format!("{invariants}\nmain rule r_Main = {rule}");
    machine(SIGNATURE, &definitions, "function seen = 0 function peak = 0")
}

#[test]
fn an_invariant_that_is_proved_is_a_hypothesis() {
    let (one, plain) = (peak(), filter("", FILTER));
    stuck(&one, &plain, COUPLING, "step 1 made");
    let other = filter("invariant inv_peak over peak: peak >= 0", FILTER);
    refines(&one, &other, COUPLING);
    known(&one, &other, COUPLING, &[(CONCRETE, "inv_peak")], &[]);
}

#[test]
fn one_that_is_not_proved_is_told_and_not_used() {
    let one = peak();
    let why = "the induction does not prove it";
    // False, false at the beginning alone, true but not kept by itself.
    for invariant in ["peak >= 1 and peak >= 0", "peak >= 5", "seen != 3 and peak >= 0", "peak != 150 or seen = 150"] {
        let other = filter(&format!("invariant inv_odd over peak, seen: {invariant}"), FILTER);
        stuck(&one, &other, COUPLING, "step 1 made");
        known(&one, &other, COUPLING, &[], &[&format!("inv_odd: {why}")]);
    }
    let other = filter("invariant inv_input over reading: reading >= 0", FILTER);
    known(&one, &other, COUPLING, &[], &["inv_input: it looks at inputs"]);
    // One that falls does not take the others along.
    let other = filter("invariant inv_odd over seen: seen < 7\ninvariant inv_peak over peak: peak >= 0", FILTER);
    refines(&one, &other, COUPLING);
    known(&one, &other, COUPLING, &[(CONCRETE, "inv_peak")], &[&format!("inv_odd: {why}")]);
}

#[test]
fn invariants_may_need_each_other_and_the_coupling() {
    let rule = "par a := b b := if a > 1000000 then 0 else a endif n := max(n, 0) endpar";
    let signature = "controlled a: Integer controlled b: Integer controlled n: Integer";
    let (one, two) = ("invariant inv_a over a: a >= 0", "invariant inv_b over b: b >= 0");
    let make = |invariants: &str| {
        machine(
            signature,
            &format!("{invariants}\nmain rule r_Main = {rule}"),
            "function a = 1 function b = 2 function n = 0",
        )
    };
    let abstractly = make("");
    known(&abstractly, &make(&format!("{one}\n{two}")), "same a;", &[(CONCRETE, "inv_a"), (CONCRETE, "inv_b")], &[]);
    known(&abstractly, &make(one), "same n;", &[], &["inv_a: the induction does not prove it"]);
    // The coupling says of `a` what the invariant about `b` lacks.
    known(&abstractly, &make(two), "same n; couple concrete.a >= 0 and concrete.b >= 0;", &[(CONCRETE, "inv_b")], &[]);
    // Where a segment has several steps the coupling says nothing of the states in between.
    let segment = "same n; couple concrete.a >= 0 and concrete.b >= 0; segment concrete.n = 0; diagrams 1:2;";
    known(&abstractly, &make(two), segment, &[], &["inv_b: the induction does not prove it"]);
}

#[test]
fn invariants_of_the_abstract_machine_are_known_as_well() {
    let signature = "controlled n: Integer controlled k: Integer";
    let make = |invariants: &str, rule: &str| {
        machine(signature, &format!("{invariants}\nmain rule r_Main = {rule}"), "function n = 0 function k = 0")
    };
    let one =
        |invariants: &str| make(invariants, "par if k = 0 then n := 1 - n else n := n + 7 endif k := 2 * k endpar");
    let other = make("", "n := 1 - n");
    stuck(&one(""), &other, "same n; couple concrete.n >= 0 and concrete.n <= 1;", "step 1 answered");
    let with = one("invariant inv_k over k: k = 0");
    refines(&with, &other, "same n; couple concrete.n >= 0 and concrete.n <= 1;");
    known(&with, &other, "same n; couple concrete.n >= 0 and concrete.n <= 1;", &[(ABSTRACT, "inv_k")], &[]);
}

#[test]
fn a_false_invariant_lets_no_wrong_refinement_through() {
    // Wrong from some state on that only a false invariant excludes.
    let one = machine("controlled n: Integer", "main rule r_Main = n := (n + 1) mod 1000000", "function n = 0");
    let wrong = "n := if n = 70000 then 0 else (n + 1) mod 1000000 endif";
    for invariant in ["n != 70000", "n < 70000", "n >= 0 and n < 70000", "n > 0", "false"] {
        let other = machine(
            "controlled n: Integer",
            &format!("invariant inv_n over n: {invariant}\nmain rule r_Main = {wrong}"),
            "function n = 0",
        );
        let Some(report) = proved(&one, &other, "same n; couple concrete.n >= 0 and concrete.n < 1000000;") else {
            return;
        };
        assert_ne!(report.verdict, Verdict::Refines, "{invariant}");
    }
}

#[test]
fn random_invariants_change_no_verdict_of_random_machines() {
    let invariants = ["n <= 2", "n < 2", "h implies n > 0", "not h", "n != 2", "n = 0", "h or n = 0", "h = (n = 1)"];
    let couplings = ["same n; allow waiting;", "same n, h;", "same n; diagrams 0..1:1..2; allow waiting;"];
    let (mut proofs, mut used) = (0, 0);
    for seed in seeds(20, 400) {
        let mut random = Random(seed * 65_537 + 11);
        let abstractly = rule(&mut random);
        let concretely = match random.below(3) {
            0 => abstractly.clone(),
            _ => changed(&mut random, &abstractly),
        };
        let mut some = || {
            let all = (0..random.below(3)).map(|index| {
                let invariant = random.pick(&invariants);
                format!("invariant inv_{index} over n: {invariant}\n")
            });
            all.collect::<String>()
        };
        let (of_one, of_other) = (some(), some());
        let (one, other) = (machine_with(&abstractly, &of_one), machine_with(&concretely, &of_other));
        let text = random.pick(&couplings);
        let Some(found) = proved(&one, &other, text) else { return };
        let proof = found.proof.as_ref();
        used += proof.map_or(0, |proof| proof.known.iter().filter(|known| known.unused.is_none()).count());
        if found.verdict == Verdict::Refines {
            proofs += 1;
            let expected = report(&one, &other, Some(text)).verdict;
            let of = || format!("seed {seed}: {text}\n{of_one}{abstractly}\n{of_other}{concretely}\n{proof:#?}");
            assert!(matches!(expected, Verdict::Refines | Verdict::Vacuous(_)), "{expected:?} {}", of());
        }
    }
    assert!(proofs > 3 && used > 3, "{proofs} {used}");
}
