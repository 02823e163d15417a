//! Proofs by induction: what no search ends, what solvers must not accept, and that on finite machines the search says the same.
//!
//! Solvers that are not installed are left out; where there are not two, nothing is asked, and stderr says so. Most tests search no pairs
//! before the proof, so that the solvers alone decide.

use std::sync::Arc;

use program::Program;
use refine::{Coupling, Gap, Options, Provers, Report, Said, Vacuous, Verdict, prove};
use solve::session::Solvers;
use syntax::SourceFile;
use testkit::sample::seeds;
use testkit::solver::{Installed, solvers};
use testkit::{Page, Random};

use crate::enumerated::Enumerated;
use crate::naive::{changed, machine_of, rule};
use crate::small::{example, machine, report};

/// The two solvers, if both are there.
pub fn both() -> Option<Vec<Installed>> {
    let both = solvers(false);
    (both.len() == 2).then_some(both)
}

pub fn coupled(one: &Arc<Program>, other: &Arc<Program>, text: &str) -> Coupling {
    let text = SourceFile::new("c.refine", text);
    let coupling = Coupling::new([one, other], Some(text), &machine::Limits::default());
    coupling.unwrap_or_else(|faulty| panic!("{:#?}", faulty.faults))
}

pub fn proved_by(mut by: Vec<impl Solvers>, coupling: &Coupling, pairs: u64) -> Report {
    let solvers = by.iter_mut().map(|solver| -> &mut dyn Solvers { solver }).collect();
    let options = Options { max_pairs: pairs, ..Options::default() };
    prove(coupling, &options, Provers { solvers, seconds: 20, depth: 0 }, &mut |_| true).expect("it begins")
}

/// The report of the solvers alone; none if they are not there.
pub fn proved(one: &Arc<Program>, other: &Arc<Program>, coupling: &str) -> Option<Report> {
    Some(proved_by(both()?, &coupled(one, other, coupling), 0))
}

/// The diagrams of a proof; none if there are no solvers.
#[track_caller]
pub fn refines(one: &Arc<Program>, other: &Arc<Program>, coupling: &str) -> Option<Vec<(u32, u32)>> {
    let report = proved(one, other, coupling)?;
    let proof = report.proof.expect("a proof");
    assert_eq!(report.verdict, Verdict::Refines, "{coupling}: {:#?}", proof.gap);
    assert!(proof.obligations.iter().all(|obligation| obligation.is_accepted()));
    Some(proof.diagrams)
}

/// The same, and that these are its diagrams.
#[track_caller]
pub fn refines_by(one: &Arc<Program>, other: &Arc<Program>, coupling: &str, diagrams: &[(u32, u32)]) {
    if let Some(found) = refines(one, other, coupling) {
        assert_eq!(found, diagrams);
    }
}

#[track_caller]
pub fn stuck(one: &Arc<Program>, other: &Arc<Program>, coupling: &str, at: &str) {
    let Some(report) = proved(one, other, coupling) else { return };
    let proof = report.proof.expect("a proof");
    let Some(Gap::Stuck(index, _)) = &proof.gap else { panic!("{coupling}: {:?} {:#?}", report.verdict, proof.gap) };
    assert_eq!(proof.obligations[*index].name, at, "{coupling}: {:#?}", proof.gap);
    assert!(matches!(report.verdict, Verdict::Unknown(_)));
}

#[track_caller]
pub fn outside(one: &Arc<Program>, other: &Arc<Program>, coupling: &str, says: &str) {
    let Some(report) = proved(one, other, coupling) else { return };
    let proof = report.proof.expect("a proof");
    let Some(Gap::Outside(_, outside)) = &proof.gap else { panic!("{:?} {:#?}", report.verdict, proof.gap) };
    assert!(outside.what.contains(says), "{}", outside.what);
}

fn peak(rule: &str) -> Arc<Program> {
    let signature = "monitored reading: Integer controlled peak: Integer";
    machine(signature, &format!("main rule r_Main = {rule}"), "function peak = 0")
}

/// A counter up to a number that no search reaches, and a counter of two digits.
fn digits(rule: &str) -> [Arc<Program>; 2] {
    let one = machine("controlled n: Integer", "main rule r_Main = n := (n + 1) mod 1000000000000", "function n = 0");
    let other = machine(
        "controlled low: Integer controlled high: Integer",
        &format!("main rule r_Main = {rule}"),
        "function low = 0 function high = 0",
    );
    [one, other]
}

const DIGITS: &str = "couple abstract.n = 1000000 * concrete.high + concrete.low;
    couple concrete.low >= 0 and concrete.low < 1000000;
    couple concrete.high >= 0 and concrete.high < 1000000;";

const CARRIES: &str = "if low < 999999 then low := low + 1
    else par low := 0 high := (high + 1) mod 1000000 endpar endif";

#[test]
fn inputs_without_bounds() {
    let one = peak("peak := max(peak, reading)");
    refines_by(&one, &peak("if reading > peak then peak := reading endif"), "same peak;", &[(1, 1)]);
    stuck(&one, &peak("if reading > peak + 1 then peak := reading endif"), "same peak;", "step 1 made");
    stuck(&one, &peak("if reading >= 0 then peak := reading endif"), "same peak;", "step 1 answered");
    // The abstract machine may not take a value that nothing says.
    outside(
        &one,
        &peak("if reading > peak then peak := reading endif"),
        "same peak; free abstract.reading;",
        "input reading",
    );
}

#[test]
fn counters_that_no_search_ends() {
    let [one, other] = digits(CARRIES);
    refines(&one, &other, DIGITS);
    // Without what holds of the digits the induction does not go through.
    stuck(&one, &other, "couple abstract.n = 1000000 * concrete.high + concrete.low;", "step 1 answered");
    for wrong in [
        CARRIES.replace("999999 then", "1000000 then"),
        CARRIES.replace("high := (high + 1) mod 1000000", "high := high + 1"),
        CARRIES.replace("low := low + 1", "low := low + 2"),
        CARRIES.replace("low := 0", "skip"),
    ] {
        let [one, other] = digits(&wrong);
        stuck(&one, &other, DIGITS, "step 1 answered");
    }
    // The last number can be counted no further.
    let endless = machine("controlled n: Integer", "main rule r_Main = n := n + 1", "function n = 0");
    stuck(&endless, &endless, "same n;", "step 1 made");
}

/// A number that leaves 64 bits ends a run where that is allowed, and nothing else does.
#[test]
fn a_counter_without_end() {
    let count = |rule: &str| {
        let signature = "controlled n: Integer controlled m: Integer";
        machine(signature, &format!("main rule r_Main = {rule}"), "function n = 0 function m = 0")
    };
    let (one, text) = (count("n := n + 1"), "same n; allow overflow;");
    let proved = refines(&one, &count("par n := n + 1 m := 3 * m - n endpar"), text);
    assert!(proved.is_none_or(|diagrams| diagrams == [(1, 1)]));
    stuck(&one, &count("n := n + 2"), text, "step 1 answered");
    stuck(
        &one,
        &count("if m < 7 then par n := n + 1 m := n endpar else par n := 1 n := m endpar endif"),
        text,
        "step 1 made",
    );
    // The answer is to be made, whatever happens to the abstract machine's numbers.
    stuck(&count("par n := n + 1 m := 3 * m + 1 endpar"), &one, text, "step 1 answered");
    let steep = |then: &str| count(&format!("if n < 1000000000000 then n := 8 * n + 1 else {then} endif"));
    let (grows, ends) = (count("n := 8 * n + 1"), steep("n := 8 * n + 1"));
    let verdict = |other, text| report(&grows, other, Some(text)).verdict;
    assert!(matches!(verdict(&ends, "same n;"), Verdict::DoesNot(_)));
    assert_eq!(verdict(&ends, text), Verdict::Refines);
    assert!(matches!(verdict(&steep("par n := 1 n := 2 endpar"), text), Verdict::DoesNot(_)));
}

fn slow(rule: &str) -> [Arc<Program>; 2] {
    let one = machine("controlled on: Boolean", "main rule r_Main = on := not on", "function on = false");
    let other = machine(
        "monitored delay: Integer controlled left: Integer controlled on: Boolean",
        &format!("main rule r_Main = {rule}"),
        "function on = false function left = 0",
    );
    [one, other]
}

const SLOW: &str = "if left > 0 then left := left - 1 else par on := not on left := delay endpar endif";

#[test]
fn a_variant_shows_that_the_abstract_machine_goes_on() {
    let [one, other] = slow(SLOW);
    refines_by(&one, &other, "same on; variant concrete.left;", &[(1, 1), (0, 1)]);
    refines(&one, &other, "same on; allow waiting;");
    stuck(&one, &other, "same on;", "step 1 answered");
    stuck(&one, &other, "same on; variant - concrete.left;", "step 1 answered");
    stuck(&one, &other, "same on; variant 7;", "step 1 answered");
    stuck(&one, &other, "same on; variant concrete.left - 5;", "step 1 answered");
    let [one, other] = slow(&SLOW.replace("left - 1", "left"));
    stuck(&one, &other, "same on; variant concrete.left;", "step 1 answered");
}

#[test]
fn several_steps_for_one() {
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
    let coupling = "same peak; segment not concrete.busy;";
    refines_by(&one, &latched(two), coupling, &[(1, 2)]);
    stuck(&one, &latched(&two.replace("peak := seen", "peak := reading")), coupling, "step 2 answered");
    stuck(&one, &latched(&two.replace("par busy := false", "par")), coupling, "segment over");
    // Two steps of the abstract machine for one.
    let half = machine(
        "controlled n: Integer",
        "main rule r_Main = if n < 1000000000 then n := n + 1 else n := 0 endif",
        "function n = 0",
    );
    let twice = |by: &str| {
        machine(
            "controlled n: Integer",
            &format!("main rule r_Main = if n < 999999999 then n := n + {by} else n := 0 endif"),
            "function n = 0",
        )
    };
    let pairs = "same n; couple concrete.n >= 0; diagrams 2:1, 1:1;";
    refines_by(&half, &twice("2"), pairs, &[(1, 1), (2, 1)]);
    stuck(&half, &twice("2"), "same n; couple concrete.n >= 0; diagrams 2:1;", "step 1 answered");
    stuck(&half, &twice("3"), pairs, "step 1 answered");
}

#[test]
fn choices_of_the_abstract_machine_are_answers() {
    let one = machine(
        "controlled n: Integer",
        "main rule r_Main = choose $x in {1 : 3} with true do if n < 1000000 then n := n + $x else n := 0 endif",
        "function n = 0",
    );
    let with = |step: &str| {
        let rule = format!("main rule r_Main = if n < 1000000 then n := n + {step} else n := 0 endif");
        machine("monitored quick: Boolean controlled n: Integer", &rule, "function n = 0")
    };
    refines(&one, &with("(if quick then 3 else 1 endif)"), "same n;");
    stuck(&one, &with("(if quick then 4 else 1 endif)"), "same n;", "step 1 answered");
    let any = machine(
        "controlled n: Integer",
        "main rule r_Main = choose $x in Integer with true do n := $x",
        "function n = 0",
    );
    outside(&any, &with("1"), "same n;", "infinitely many");
}

#[test]
fn steps_that_cannot_be_made() {
    let one = machine("controlled n: Integer", "main rule r_Main = skip", "function n = 0");
    let with = |rule: &str| {
        machine(
            "domain Small subsetof Integer monitored x: Integer controlled n: Integer controlled small: Small",
            &format!("domain Small = {{0 : 3}} main rule r_Main = {rule}"),
            "function n = 0 function small = 0",
        )
    };
    let coupling = "same n; allow waiting;";
    refines(&one, &with("if small < 3 then small := small + 1 else small := 0 endif"), coupling);
    stuck(&one, &with("small := small + 1"), coupling, "step 1 made");
    stuck(&one, &with("par small := 1 if x = 77 then small := 2 endif endpar"), coupling, "step 1 made");
    stuck(&one, &with("if idiv(5, x) > 1 then small := 1 else small := 2 endif"), coupling, "step 1 made");
}

#[test]
fn a_step_of_the_abstract_machine_that_cannot_be_made_is_no_answer() {
    let with = |rule: &str| {
        let signature = "domain Large subsetof Integer controlled n: Large controlled odd: Boolean";
        let rule = format!("domain Large = {{0 : 9}} main rule r_Main = {rule}");
        machine(signature, &rule, "function n = 0 function odd = false")
    };
    let (to_the_end, round) = (with("n := n + 1"), with("n := if n < 9 then n + 1 else 0 endif"));
    refines(&round, &round, "same n;");
    stuck(&to_the_end, &round, "same n;", "step 1 answered");
    refines(&to_the_end, &with("if n < 9 then n := n + 1 endif"), "same n; allow waiting;");
    // A clash, and something undefined.
    let clashes = with("par n := if n < 9 then n + 1 else 0 endif odd := true if n = 7 then odd := false endif endpar");
    stuck(&clashes, &round, "same n;", "step 1 answered");
    let divides = with("if idiv(9, 7 - n) < 99 then n := if n < 9 then n + 1 else 0 endif endif");
    stuck(&divides, &round, "same n;", "step 1 answered");
}

#[test]
fn questions_that_say_nothing() {
    let count = |rule: &str| machine("controlled n: Integer", &format!("main rule r_Main = {rule}"), "function n = 0");
    let (one, idle) = (count("if n < 1000000 then n := n + 1 else n := 0 endif"), count("skip"));
    let check = |one: &Arc<Program>, other: &Arc<Program>, coupling: &str, expected: Vacuous| {
        let Some(report) = proved(one, other, coupling) else { return };
        assert_eq!(report.verdict, Verdict::Vacuous(expected), "{coupling}: {:#?}", report.proof);
    };
    check(&one, &idle, "same n; allow waiting;", Vacuous::NoStep);
    check(&one, &one, "couple abstract.n >= 0 and concrete.n >= 0;", Vacuous::Total);
    check(&one, &one, "couple abstract.n >= 0 or concrete.n < 0 or concrete.n >= 0;", Vacuous::Total);
}

#[test]
fn one_solver_is_not_enough() {
    let one = peak("peak := max(peak, reading)");
    let other = peak("if reading > peak then peak := reading endif");
    for solver in solvers(false) {
        let report = proved_by(vec![solver], &coupled(&one, &other, "same peak;"), 0);
        assert!(matches!(report.verdict, Verdict::Unknown(_)));
        assert_eq!(report.proof.expect("a proof").gap, Some(Gap::Alone));
    }
    let none = proved_by(Vec::<Installed>::new(), &coupled(&one, &other, "same peak;"), 0);
    assert!(matches!(none.verdict, Verdict::Unknown(_)), "{none:?}");
}

/// A solver that gives these answers, whatever it is asked.
#[derive(Clone)]
struct Says(&'static str);

impl Solvers for Says {
    fn name(&self) -> Result<String, String> {
        Ok(format!("says {}", self.0))
    }

    fn start(&mut self) -> Result<Box<dyn solve::session::Session>, solve::session::Silence> {
        Ok(Box::new(self.clone()))
    }
}

impl solve::session::Session for Says {
    fn ask(&mut self, commands: &str, _: u32, _: &mut dyn FnMut() -> bool) -> Result<String, solve::session::Silence> {
        Ok(if commands.starts_with("(get-value") { "()\n".to_string() } else { format!("{}\n", self.0) })
    }
}

#[test]
fn solvers_that_disagree_or_do_not_know_prove_nothing() {
    let one = peak("peak := max(peak, reading)");
    let coupling = coupled(&one, &peak("if reading > peak then peak := reading endif"), "same peak;");
    let check = |says: [&'static str; 2]| {
        let mut both = says.map(Says);
        let solvers = both.iter_mut().map(|solver| -> &mut dyn Solvers { solver }).collect();
        let options = Options { max_pairs: 0, ..Options::default() };
        let report =
            prove(&coupling, &options, Provers { solvers, seconds: 1, depth: 0 }, &mut |_| true).expect("it begins");
        assert!(matches!(report.verdict, Verdict::Unknown(_) | Verdict::Vacuous(_)), "{says:?}: {:?}", report.verdict);
        report.proof.expect("a proof").gap
    };
    assert!(matches!(check(["sat", "unsat"]), Some(Gap::Contradicted(0))));
    assert!(matches!(check(["unsat", "unknown"]), Some(Gap::Silent(0))));
    assert!(matches!(check(["unknown", "unknown"]), Some(Gap::Silent(0))));
    assert!(matches!(check(["unsat", "(error \"line 1\")"]), Some(Gap::Silent(0))));
    // Who accepts all finds no pair that corresponds, either.
    assert!(matches!(check(["unsat", "unsat"]), Some(Gap::Silent(1))));
}

/// A solver that says of each formula what its script hopes for.
#[derive(Clone)]
struct Obliging(std::rc::Rc<std::cell::Cell<u32>>);

impl Solvers for Obliging {
    fn name(&self) -> Result<String, String> {
        Ok("obliging".to_string())
    }

    fn start(&mut self) -> Result<Box<dyn solve::session::Session>, solve::session::Silence> {
        Ok(Box::new(self.clone()))
    }
}

impl solve::session::Session for Obliging {
    fn ask(&mut self, commands: &str, _: u32, _: &mut dyn FnMut() -> bool) -> Result<String, solve::session::Silence> {
        self.0.set(self.0.get() + 1);
        let hoped = commands.lines().find_map(|line| line.strip_prefix("; accepted if the answer is "));
        Ok(format!("{}\n", hoped.unwrap_or("unsat")))
    }
}

/// The search before a proof stops at a state with very many steps, whichever state that is, and the proof begins.
#[test]
fn a_state_with_very_many_steps_does_not_keep_a_proof_from_beginning() {
    let with = |rule: &str| {
        let names = ["a", "b", "c", "d", "e"];
        let inputs: Vec<String> = names.iter().map(|name| format!("monitored {name}: N")).collect();
        let signature = format!("domain N subsetof Integer {} controlled n: N controlled m: Integer", inputs.join(" "));
        let rule = format!("domain N = {{0:99}} main rule r_Main = {rule}");
        machine(&signature, &rule, "function n = 0 function m = 0")
    };
    let all = "n := (a + b + c + d + e) mod 100";
    for rule in [all.to_string(), format!("if m < 3 then m := m + 1 else {all} endif")] {
        let (one, asked) = (with(&rule), std::rc::Rc::default());
        let by = vec![Obliging(std::rc::Rc::clone(&asked)); 2];
        let report = proved_by(by, &coupled(&one, &one, "same n, m;"), u64::MAX);
        assert!(report.progress.steps.iter().all(|steps| *steps <= 20_000), "{:?}", report.progress);
        let proof = report.proof.expect("a proof");
        assert!(asked.get() > 0 && proof.obligations.iter().any(|one| one.name == "step 1 answered"), "{proof:#?}");
    }
}

#[test]
fn what_is_outside_is_named() {
    let one = peak("peak := max(peak, reading)");
    let list = machine(
        "monitored reading: Integer controlled peak: Integer controlled all: Seq(Integer)",
        "main rule r_Main = all := append(all, reading)",
        "function peak = 0 function all = []",
    );
    outside(&one, &list, "same peak; allow waiting;", "Seq(Integer)");
    let halves = machine("controlled x: Real", "main rule r_Main = x := x / 2.0", "function x = 1.0");
    outside(&halves, &halves, "same x;", "real numbers");
}

/// What the solvers alone prove the search proves, too, and what is wrong they never accept.
#[test]
fn the_search_says_the_same_of_random_machines() {
    agree(seeds(20, 600), &|coupling, pairs| Some(proved_by(both()?, coupling, pairs)));
}

/// So it is where all values are tried instead, wherever the tests run.
#[test]
fn the_search_says_the_same_of_random_machines_whose_values_are_tried() {
    agree(seeds(60, 2000), &|coupling, pairs| Some(proved_by(vec![Enumerated; 2], coupling, pairs)));
}

/// Makes a report of so many pairs of states, and a proof.
type Proves<'p> = &'p dyn Fn(&Coupling, u64) -> Option<Report>;

fn agree(cases: std::ops::Range<u64>, proves: Proves<'_>) {
    let couplings = [
        "same n;",
        "same n, h;",
        "same n; allow waiting;",
        "same n; variant if concrete.h then 1 else 0 endif;",
        "same n; couple concrete.h implies abstract.h; variant if concrete.h then 0 else 1 endif;",
        "same n; diagrams 1..2:1, 1:2; allow waiting;",
        "same n; segment not concrete.h; diagrams 0..1:1..3; allow waiting;",
        "same h; couple abstract.n <= concrete.n; allow waiting;",
        "same n, h; free abstract.go;",
        "same n; input abstract.go = concrete.h; allow waiting;",
        "same n; input abstract.go = not concrete.go; allow waiting;",
        "same n; input abstract.go = (concrete.go or concrete.h); allow waiting;",
        "same n; input abstract.go = (concrete.go and concrete.n = 0); diagrams 0..1:1..2; allow waiting;",
    ];
    let mut counts = [0; 4];
    for seed in cases.clone() {
        let mut random = Random(seed * 104_729 + 3);
        let abstractly = rule(&mut random);
        let concretely = match random.below(4) {
            0 => rule(&mut random),
            1 => abstractly.clone(),
            _ => changed(&mut random, &abstractly),
        };
        let (one, other) = (machine_of(&abstractly), machine_of(&concretely));
        let text = random.pick(&couplings);
        let Some(found) = proves(&coupled(&one, &other, text), 0) else { return };
        let expected = report(&one, &other, Some(text));
        let of = || format!("seed {seed}: {text}\nabstract {abstractly}\nconcrete {concretely}\n{:#?}", found.proof);
        match found.verdict {
            Verdict::Refines => {
                if let Verdict::Vacuous(_) = expected.verdict {
                    // No reached pair has such a step; the search that goes before a proof says so.
                    let Some(searched) = proves(&coupled(&one, &other, text), 500) else { return };
                    assert_eq!(searched.verdict, expected.verdict, "{}", of());
                    continue;
                }
                assert_eq!(expected.verdict, Verdict::Refines, "{}", of());
                counts[0] += 1;
            }
            Verdict::Unknown(_) => {
                let proof = found.proof.as_ref().expect("a proof");
                assert!(matches!(proof.gap, Some(Gap::Stuck(..))), "{}", of());
                counts[if expected.verdict == Verdict::Refines { 1 } else { 2 }] += 1;
            }
            Verdict::Vacuous(_) => counts[3] += 1,
            Verdict::DoesNot(_) => panic!("{}", of()),
        }
    }
    let all = cases.count();
    assert!(counts[0] * 8 > all && counts[2] * 8 > all, "{counts:?}");
}

/// Each coupling of the page that is proved by induction is one that the search proves.
#[test]
fn the_page_is_not_contradicted() {
    let page = Page::spec("refine");
    let mut models = [None, None];
    let mut proofs = 0;
    for block in page.blocks() {
        match block.info.split_whitespace().collect::<Vec<_>>()[..] {
            ["asmetal", "abstract"] => models[0] = Some(example(block.text)),
            ["asmetal", "concrete"] => models[1] = Some(example(block.text)),
            ["refine", expected, ..] => {
                let [Some(one), Some(other)] = &models else { panic!("line {}: no models", block.line) };
                let text = SourceFile::new("example.refine", block.text);
                let Ok(coupling) = Coupling::new([one, other], Some(text), &machine::Limits::default()) else {
                    continue;
                };
                let Some(both) = both() else { return };
                let verdict = proved_by(both, &coupling, 0).verdict;
                assert!(verdict != Verdict::Refines || expected == "refines", "line {}", block.line);
                proofs += usize::from(verdict == Verdict::Refines);
            }
            _ => {}
        }
    }
    assert!(proofs >= 3, "{proofs}");
}

/// A check of sense needs one solver that has a state, and none that denies it.
#[test]
fn when_an_obligation_is_accepted() {
    let check = |sense: bool, said: &[Said], expected: bool| {
        let (name, claim, script) = Default::default();
        let obligation = refine::Obligation { name, claim, script, sense, said: said.to_vec() };
        assert_eq!(obligation.is_accepted(), expected, "{sense} {said:?}");
    };
    check(false, &[Said::Impossible, Said::Impossible], true);
    check(false, &[Said::Impossible], false);
    check(false, &[], false);
    check(false, &[Said::Impossible, Said::Late], false);
    check(true, &[Said::Possible, Said::Unknown], true);
    check(true, &[Said::Possible, Said::Impossible], false);
    check(true, &[Said::Unknown, Said::Unknown], false);
}

/// Properties come along by the diagrams that are allowed.
#[test]
fn properties_come_along() {
    let with = |name: &str, properties: &str| {
        let text = format!(
            "asm {name}\nimport StandardLibrary\nimport CTLLibrary\nsignature:\nmonitored reading: Integer\n\
             controlled peak: Integer\ndefinitions:\n{properties}\nmain rule r_Main = peak := max(peak, reading)\n\
             default init s0: function peak = 0\n"
        );
        crate::small::program(name, &text)
    };
    let one = with(
        "Peak",
        "invariant inv_low over peak: peak >= 0 CTLSPEC ag(peak >= 0) CTLSPEC af(peak >= 0) CTLSPEC ax(peak >= 0)",
    );
    let other = peak("if reading > peak then peak := reading endif");
    let come = |coupling: &str| -> Vec<bool> {
        let report = proved(&one, &other, coupling);
        report.map_or(Vec::new(), |report| report.properties.iter().map(|property| property.form.is_ok()).collect())
    };
    let check = |coupling: &str, expected: [bool; 4]| {
        let come = come(coupling);
        assert!(come.is_empty() || come == expected, "{coupling}: {come:?}");
    };
    check("same peak;", [true; 4]);
    check("same peak; diagrams 1:1;", [true; 4]);
    check("same peak; variant 0;", [true, true, true, false]);
    check("same peak; allow waiting;", [true, true, false, false]);
    check("same peak; allow waiting; diagrams 1:1;", [true; 4]);
    check("same peak; diagrams 1..2:1;", [true, true, false, false]);
    check("same peak; diagrams 1:1..2;", [false; 4]);
}
