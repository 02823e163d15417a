//! Solvers agree with the explicit search: what one proves the other does not find, and runs have the same length.

use std::path::PathBuf;
use std::sync::Arc;

use machine::{Bounds, Limits, Value};
use model::Basic;
use program::{DomainKind, FunctionId, FunctionKind, Program};
use syntax::{Severity, SourceFile};
use testkit::solver::solvers;
use testkit::{repository, sample};
use verify::solver::{Left, Method, Proof};
use verify::{EngineKind, NoStart, Options, Outcome, Progress, Reason, Report, Request, Subject, verify};

use crate::models::{Disk, lowered};

fn model(text: &str) -> Arc<Program> {
    lowered(SourceFile::new("example.asm", format!("asm example\nimport StandardLibrary\nsignature:\n{text}\n")))
}

/// The report of each solver.
fn ask(program: &Arc<Program>, method: Method, depth: u64) -> Vec<Result<Report, NoStart>> {
    let options = Options { engine: EngineKind::Solver(method), max_depth: depth, ..Options::default() };
    let horn = matches!(method, Method::Reachability | Method::Portfolio);
    let mut solvers = solvers(horn);
    let request = Request::of(program, options).build().expect("nothing is in conflict");
    solvers.iter_mut().map(|solver| request.verify(solver, &mut |_: &Progress| true)).collect()
}

/// Each verdict in a word.
fn words(program: &Program, report: &Report) -> Vec<(String, String)> {
    let name = |subject: &Subject| match subject {
        Subject::Property(index) => program.properties[*index].name.clone(),
        other => format!("{other:?}"),
    };
    let word = |subject: &Subject, outcome: &Outcome| match outcome {
        Outcome::Holds => match report.proofs.get(subject) {
            Some(Proof::Induction(steps)) => format!("holds, k = {steps}"),
            Some(Proof::Reachability) => "holds, reachability".to_string(),
            None => "holds".to_string(),
        },
        Outcome::Violated(trace) => format!("violated in {} steps", trace.steps.len()),
        Outcome::Unknown(_) => match report.left.get(subject) {
            Some(Left::Beyond(outside)) => format!("beyond: {}", outside.what),
            left => format!("unknown {left:?}"),
        },
    };
    report.verdicts.iter().map(|one| (name(&one.subject), word(&one.subject, &one.outcome))).collect()
}

#[track_caller]
fn check(program: &Arc<Program>, method: Method, expected: &[(&str, &str)]) {
    for outcome in ask(program, method, 20) {
        let report = outcome.expect("it is told to the solver");
        let words = words(program, &report);
        for (name, word) in expected {
            let found = words.iter().find(|(other, _)| other == name);
            assert_eq!(found.map(|(_, word)| word.as_str()), Some(*word), "{name}\n{words:#?}");
        }
    }
}

const TANK: &str = "enum domain Valve = {OPEN | SHUT}
    monitored inflow: Integer
    controlled level: Integer
    controlled valve: Valve
    definitions:
    INVAR inflow >= 0
    invariant inv_low over level: level >= 0
    invariant inv_high over level: level < 12
    invariant inv_valve over valve: valve = OPEN implies level > 0
    main rule r_Main = par
        valve := if level + inflow > 5 then OPEN else SHUT endif
        level := if valve = OPEN then 0 else min(level + inflow, 7 + level) endif
    endpar
    default init s0: function level = 0 function valve = SHUT";

/// Of nothing everything could be proved: by each engine it is unknown, with the reason.
#[test]
fn assumptions_that_no_initial_state_satisfies() {
    let program = lowered(SourceFile::new(
        "example.asm",
        "asm example import StandardLibrary import LTLLibrary signature:
        domain Level subsetof Integer controlled level: Level definitions: domain Level = {0 : 3} INVAR level > 2
        invariant inv_level over level: level > 9 LTLSPEC ltlSpec_level: g(level > 9)
        main rule r_Main = level := (level + 1) mod 4 default init s0: function level = 0",
    ));
    let check = |report: &Report, engine: &str, solves: bool| {
        for verdict in &report.verdicts {
            let is_told =
                |reasons: &[Reason]| reasons.contains(&Reason::Vacuous) || solves && reasons == [Reason::Temporal];
            assert!(matches!(&verdict.outcome, Outcome::Unknown(reasons) if is_told(reasons)), "{engine}: {verdict:?}");
        }
    };
    for engine in [EngineKind::Explicit, EngineKind::Symbolic, EngineKind::Automatic] {
        let options = Options { engine, ..Options::default() };
        let report = verify(&program, &options, &mut |_| true).expect("it begins");
        check(&report, &format!("{engine:?}"), false);
    }
    for method in [Method::Induction, Method::Reachability, Method::Portfolio] {
        for outcome in ask(&program, method, 20) {
            let Ok(report) = outcome else { continue };
            check(&report, &format!("{method:?}"), true);
        }
    }
}

/// Where no step is left, little was looked at; an input without bounds leaves it to solvers to find that out.
#[test]
fn assumptions_that_no_step_satisfies() {
    let program = |assumed: &str| {
        model(&format!(
            "monitored inflow: Integer controlled level: Integer definitions: INVAR {assumed} \
             invariant inv_level over level: level < 9 \
             main rule r_Main = level := min(level + max(inflow, 0), 8) default init s0: function level = 0"
        ))
    };
    for method in [Method::Induction, Method::Reachability, Method::Portfolio] {
        // The second leaves the input no value.
        let nothing = ["inflow > level and inflow < level", "inflow > 5 and inflow < 3"];
        for outcome in nothing.into_iter().flat_map(|assumed| ask(&program(assumed), method, 20)) {
            let Ok(report) = outcome else { continue };
            let is_told =
                |outcome: &Outcome| matches!(outcome, Outcome::Unknown(reasons) if reasons.contains(&Reason::Stepless));
            assert!(report.verdicts.iter().all(|verdict| is_told(&verdict.outcome)), "{:?}", report.verdicts);
        }
        for outcome in ask(&program("inflow >= level"), method, 20) {
            let Ok(report) = outcome else { continue };
            let of_level = report.verdicts.last().map(|verdict| &verdict.outcome);
            assert_eq!(of_level, Some(&Outcome::Holds), "{method:?}: {:?}", report.left);
        }
    }
}

/// An invariant that cannot be evaluated, or is undef, is violated; the steps are made all the same, so that the others are judged by them. Each
/// engine says so, whether the invariant reads an input or not.
#[test]
fn an_invariant_that_cannot_be_evaluated_hides_nothing() {
    for ratio in ["go + idiv(1, cap) < 9", "idiv(1, cap) < 9", "(if cap = 0 then go > 9 endif)", "go + nothing < 9"] {
        let program = model(&format!(
            "domain Few subsetof Integer monitored go: Few controlled cap: Few controlled nothing: Few
            controlled burning: Boolean definitions: domain Few = {{0 : 1}}
            invariant inv_ratio over cap: {ratio}
            invariant inv_fine over cap: go + cap < 2
            invariant inv_safe over burning: not burning
            main rule r_Main = burning := true
            default init s0: function cap = 0 function burning = false"
        ));
        let check = |report: &Report, engine: &str| {
            let words = words(&program, report);
            let expected = [
                ("Defined", "holds".to_string()),
                ("inv_ratio", "violated".to_string()),
                ("inv_fine", "holds".to_string()),
                ("inv_safe", "violated in 1 steps".to_string()),
            ];
            for (name, word) in expected {
                let found = words.iter().find(|(other, _)| other == name).expect("it is asked");
                // A bounded search by a solver proves nothing.
                let is_open = engine == "Bounded" && word == "holds" && !found.1.starts_with("violated");
                let is_proved = word == "holds" && found.1.starts_with("holds");
                let is_found = word.starts_with("violated") && found.1.starts_with("violated");
                assert!(is_open || is_proved || is_found, "{engine}, {ratio}: {words:?}");
                if name == "inv_safe" {
                    assert!(found.1 == word, "{engine}, {ratio}: {words:?}");
                }
            }
        };
        for (engine, workers) in [(EngineKind::Explicit, 1), (EngineKind::Explicit, 2), (EngineKind::Symbolic, 1)] {
            let options = Options { engine, workers, ..Options::default() };
            let report = verify(&program, &options, &mut |_| true).expect("it begins");
            check(&report, &format!("{engine:?}"));
        }
        for (method, name) in [(Method::Bounded, "Bounded"), (Method::Induction, "Induction")] {
            for outcome in ask(&program, method, 4) {
                check(&outcome.expect("it is told to the solver"), name);
            }
        }
    }
}

/// A location that has no value has one for the solver, which has to be in its domain: else it does not see the state. Here that value
/// would be what the other choice writes.
#[test]
fn a_location_without_a_value_hides_no_state() {
    for outside in ["if b then 3 else 0 endif", "size({$d in {1, 2, 3} | b : $d})"] {
        let program = model(&format!(
            "domain Few subsetof Integer controlled y: Boolean controlled u: Few controlled b: Boolean monitored k: Boolean
            definitions: domain Few = {{0 : 2}} invariant inv_c over y: not y
            main rule r_Main = par
                choose $c in {{1, 2}} with k do let ($z = {outside}) in u := $z endlet ifnone y := true
                choose $e in {{1, 2}} with b do u := undef
            endpar
            default init s0: function y = false function u = 0 function b = true"
        ));
        check(&program, Method::Bounded, &[("inv_c", "violated in 1 steps")]);
        check(&program, Method::Induction, &[("inv_c", "violated in 1 steps"), ("InDomain", "violated in 1 steps")]);
        for method in [Method::Reachability, Method::Portfolio] {
            for (name, word) in said(&program, method) {
                assert!(name != "inv_c" || !word.starts_with("holds"), "{method:?}: {word}");
            }
        }
    }
}

/// What all solvers say of all checks.
fn said(program: &Arc<Program>, method: Method) -> Vec<(String, String)> {
    ask(program, method, 20).into_iter().flatten().flat_map(|report| words(program, &report)).collect()
}

/// What an initial value gives a function outside of its domain is not told to the solver, which therefore says nothing.
#[test]
fn an_invariant_that_looks_outside_of_a_domain_is_not_violated() {
    let program = model(
        "enum domain Side = {LEFT | RIGHT} controlled f: Side -> Side controlled g: Side controlled b: Boolean
        definitions: invariant inv_f over f: f(g) != LEFT
        main rule r_Main = b := not b
        default init s0: function f($s in Side) = RIGHT function b = true",
    );
    check(&program, Method::Bounded, &[("inv_f", "beyond: an argument outside of its domain")]);
    for method in [Method::Induction, Method::Reachability, Method::Portfolio] {
        let said = said(&program, method).into_iter().filter(|(name, _)| name == "inv_f");
        said.for_each(|(_, word)| {
            assert!(word.starts_with("unknown") || word.starts_with("beyond"), "{method:?}: {word}")
        });
    }
}

#[test]
fn inputs_without_a_bound() {
    let program = model(TANK);
    let bmc = [("inv_high", "violated in 2 steps"), ("inv_low", "unknown Some(Depth(20))")];
    check(&program, Method::Bounded, &bmc);
    check(&program, Method::Induction, &[("inv_low", "holds, k = 1"), ("inv_high", "violated in 2 steps")]);
    check(&program, Method::Reachability, &[("inv_low", "holds, reachability"), ("inv_high", "violated in 2 steps")]);
}

/// The violated checks, with the number of steps; other checks are left out.
fn violated(program: &Program, report: &Report) -> Vec<(String, String)> {
    words(program, report).into_iter().filter(|(_, word)| word.starts_with("violated")).collect()
}

/// Checks a solver's report against that of an explicit search that explored all states.
#[track_caller]
fn fits(program: &Arc<Program>, explicit: &Report, solved: &Report, depth: usize, text: &str) {
    let near = |trace: &verify::Trace| trace.steps.len() <= depth;
    for (one, other) in explicit.verdicts.iter().zip(&solved.verdicts) {
        let context =
            || format!("{:?}\n{:#?}\n{:#?}\n{text}", one.subject, words(program, explicit), words(program, solved));
        assert_ne!(solved.left.get(&one.subject), Some(&Left::Odd), "{}", context());
        let beyond = matches!(solved.left.get(&one.subject), Some(Left::Beyond(_) | Left::Late(_) | Left::Untold));
        match (&one.outcome, &other.outcome) {
            (Outcome::Violated(a), Outcome::Violated(b)) => assert_eq!(a.steps.len(), b.steps.len(), "{}", context()),
            (Outcome::Violated(a), _) => assert!(beyond || !near(a) || a.branch || a.turn.is_some(), "{}", context()),
            (Outcome::Holds, Outcome::Violated(_)) => panic!("{}", context()),
            (Outcome::Unknown(reasons), Outcome::Violated(_)) => {
                assert!(reasons.iter().any(|reason| !matches!(reason, Reason::Bounded(_))), "{}", context());
            }
            _ => {}
        }
        if matches!(other.outcome, Outcome::Holds) {
            assert!(!matches!(one.outcome, Outcome::Violated(_)), "{}", context());
        }
    }
}

#[test]
fn reference_models() {
    for (name, method, depth) in [("Swing", Method::Induction, 3), ("SwingUnlocked", Method::Bounded, 12)] {
        let path = repository::root().join(format!("bench/models/verify/{name}.asm"));
        let program = lowered(Disk::read(&path).expect("the model is there"));
        let explicit = verify(&program, &Options::default(), &mut |_| true).expect("it starts");
        for outcome in ask(&program, method, depth) {
            let solved = outcome.expect("it is told to the solver");
            fits(&program, &explicit, &solved, depth as usize, name);
            assert_eq!(violated(&program, &solved), violated(&program, &explicit));
        }
    }
}

/// The models of the repository that are small enough to be explored.
#[test]
fn examples() {
    let root = repository::root();
    let (mut inside, mut outside) = (0, Vec::new());
    let folders = std::fs::read_dir(root.join("examples")).expect("there are examples");
    let mut folders: Vec<PathBuf> = folders.flatten().map(|entry| entry.path()).filter(|path| path.is_dir()).collect();
    folders.extend(["library/runtime", "library/verification"].map(|name| root.join(name)));
    folders.sort();
    for folder in folders {
        let files = std::fs::read_dir(folder).expect("a folder");
        let mut files: Vec<PathBuf> = files.flatten().map(|entry| entry.path()).collect();
        files.sort();
        for path in files.into_iter().filter(|path| path.extension().is_some_and(|ending| ending == "asm")) {
            let checked = model::check(Disk::read(&path).expect("a model"), &mut Disk);
            let program = Arc::new(program::lower(&checked.model).expect("it can be lowered"));
            if program.main.is_none() {
                continue;
            }
            const DEPTH: u64 = 4;
            let name = path.display().to_string();
            let mut explicit = None;
            for outcome in ask(&program, Method::Bounded, DEPTH) {
                match outcome {
                    Ok(solved) => {
                        let options =
                            Options { engine: EngineKind::Explicit, max_depth: DEPTH + 1, ..Options::default() };
                        let explicit = explicit.get_or_insert_with(|| {
                            verify(&program, &options, &mut |progress| progress.states < 300_000).expect("it starts")
                        });
                        fits(&program, explicit, &solved, DEPTH as usize, &name);
                        inside += 1;
                    }
                    Err(NoStart::Outside(why)) => outside.push(format!("{name}: {}", why.what)),
                    Err(other) => panic!("{name}: {other:?}"),
                }
            }
        }
    }
    assert!(solvers(true).is_empty() || inside >= 5, "{inside} models are told to the solver; not: {outside:#?}");
}

/// The values that inputs over infinite domains are given.
fn bounds(program: &Program) -> Bounds {
    let infinite = |domain| matches!(program.domain(domain).kind, DomainKind::Basic(Basic::Integer | Basic::Natural));
    let inputs = program.functions.iter().zip(0..).filter(|(function, _)| {
        matches!(function.kind, FunctionKind::Monitored | FunctionKind::Shared) && infinite(function.codomain)
    });
    inputs.map(|(_, index)| (FunctionId(index), vec![Value::Integer(0), Value::Integer(1)])).collect()
}

/// `GROUNDSTATE_CASES` sets how many models, `GROUNDSTATE_SEED` the first seed.
#[test]
fn random_models() {
    const DEPTH: u64 = 4;
    let seeds = sample::seeds(50, 300);
    let cases = seeds.end - seeds.start;
    let (mut compared, mut found) = (0, 0);
    for seed in seeds {
        let text = oracle::generate::model(seed, 1).to_string();
        let checked = model::check(SourceFile::new("Model.asm", text.clone()), &mut Disk);
        if checked.diagnostics.iter().any(|found| found.severity == Severity::Error) {
            continue;
        }
        let Ok(program) = program::lower(&checked.model) else { continue };
        let program = Arc::new(program);
        let limits = Limits { iterations: 200, call_depth: 50, collection: 2000, ..Limits::default() };
        let bounds = bounds(&program);
        let few = Options { limits, bounds, engine: EngineKind::Explicit, max_states: 400, ..Options::default() };
        let Ok(explicit) = verify(&program, &few, &mut |progress| progress.transitions < 20_000) else { continue };
        if explicit.stop.is_some() {
            continue;
        }
        let mut solvers = solvers(false);
        let turn = seed as usize % solvers.len().max(1);
        let Some(solver) = solvers.get_mut(turn) else { return };
        let engine = EngineKind::Solver(Method::Induction);
        let options = Options { engine, max_states: u64::MAX, max_depth: DEPTH, ..few };
        let request = Request::of(&program, options).build().expect("nothing is in conflict");
        match request.verify(solver, &mut |_: &Progress| true) {
            Ok(solved) => {
                let context = format!("seed {seed}\n{text}");
                fits(&program, &explicit, &solved, DEPTH as usize, &context);
                compared += 1;
                found += usize::from(!violated(&program, &solved).is_empty());
            }
            Err(NoStart::Outside(_)) => {}
            Err(other) => panic!("seed {seed}: {other:?}\n{text}"),
        }
    }
    assert!(compared > cases / 10 && found > 0, "{compared} models, {found} with something violated");
}
