//! A search ends when asked, wherever it is: among the alternatives of one state, between states, at a given number of
//! them; its findings so far are reported.

#![allow(clippy::disallowed_methods, reason = "a test reads the repository's own models")]

use std::collections::BTreeMap;
use std::sync::Arc;

use explore::{Explorer, Interner, Settings, Trouble, Widening};
use machine::{Cause, Interrupt};
use program::Program;
use syntax::SourceFile;
use verify::{
    EngineKind, Listener, NoSolvers, NoStart, Options, Outcome, Progress, Reason, Report, Request, Stop, Storage,
    Subject, Trace, verify,
};

use crate::models::lowered;

/// A model with these texts between its name and its rules.
fn model(name: &str, declared: &str, defined: &str, initial: &str) -> Arc<Program> {
    let text = format!(
        "asm {name}\nimport StandardLibrary\nimport CTLLibrary\nsignature:\n{declared}\ndefinitions:\n{defined}\n\
         default init s0:\n{initial}\n"
    );
    lowered(SourceFile::new(format!("{name}.asm"), text))
}

/// Each state has a million alternatives of inputs.
fn sensors() -> Arc<Program> {
    model(
        "Sensors",
        " domain Level subsetof Integer\n monitored a: Level\n monitored b: Level\n monitored c: Level\n controlled x: Level",
        " domain Level = {0 : 99}\n main rule r_Main = x := max(a, min(b, c))",
        " function x = 0",
    )
}

/// Never ends; violates an invariant after some steps.
fn endless() -> Arc<Program> {
    model(
        "Endless",
        " controlled n: Integer\n controlled s: Seq(Integer)",
        " invariant inv_small over n: n < 5\n CTLSPEC ag(n >= 0)\n main rule r_Main = choose $k in {1, 2} with true do \
         if $k = 1 then n := n + 1 else s := append(s, n) endif",
        " function n = 0\n function s = []",
    )
}

/// Each step has this many choices, and each leads to another state.
fn wide(most: u32) -> Arc<Program> {
    model(
        "Wide",
        " domain N subsetof Integer\n controlled x: N\n controlled y: N",
        &format!(
            " domain N = {{1 : {most}}}\n main rule r_Main = choose $a in N, $b in N with true do par x := $a y := $b endpar"
        ),
        " function x = 1\n function y = 1",
    )
}

fn outcome(report: &Report, name: &str, program: &Program) -> Outcome {
    let named =
        |subject: Subject| matches!(subject, Subject::Property(index) if program.properties[index].name == name);
    report.verdicts.iter().find(|verdict| named(verdict.subject)).expect("it is checked").outcome.clone()
}

#[test]
fn the_alternatives_of_one_state_are_not_gone_through_to_their_end() {
    let program = sensors();
    let interrupt = Interrupt::new();
    let settings = Settings { interrupt: interrupt.clone(), ..Settings::default() };
    let mut explorer = Explorer::new(&program, settings.clone(), &Widening::default(), &Arc::new(Interner::default()))
        .expect("there is an initial state");
    let state: Box<[u64]> = explorer.initial().first().expect("an initial state").into();
    interrupt.raise(Cause::Memory);
    let expansion = explorer.expand(&state, &mut Vec::new()).expect("it fits");
    assert!(expansion.interrupted && expansion.moved == 0, "made by the machine");
    assert_eq!(explorer.paths(&state, &mut |_| panic!("nobody waits")), Ok(false));
    assert_eq!(
        Explorer::new(&program, settings, &Widening::default(), &Arc::new(Interner::default())).err(),
        Some(Trouble::Interrupted(Cause::Memory)),
    );
}

#[test]
fn remembered_steps_are_not_walked_to_their_end() {
    let program = wide(30);
    let interrupt = Interrupt::new();
    let settings = Settings { interrupt: interrupt.clone(), ..Settings::default() };
    let mut explorer = Explorer::new(&program, settings, &Widening::default(), &Arc::new(Interner::default()))
        .expect("there is an initial state");
    let state: Box<[u64]> = explorer.initial().first().expect("an initial state").into();
    let mut out = Vec::new();
    let expansion = explorer.expand(&state, &mut out).expect("it fits");
    assert_eq!((expansion.moved, expansion.stayed, expansion.interrupted), (30 * 30 - 1, 1, false));
    assert_eq!(out.len(), 30 * 30 - 1, "each pair once, but for the state itself");
    interrupt.raise(Cause::Asked);
    assert!(explorer.expand(&state, &mut out).expect("it fits").interrupted, "walked");
    explorer.ignore_interrupts();
    assert!(!explorer.expand(&state, &mut out).expect("it fits").interrupted, "wanted all the same");
}

#[test]
fn who_has_had_enough_gets_the_reason() {
    let program = sensors();
    for (cause, stop) in [(Cause::Asked, Stop::Asked), (Cause::Memory, Stop::Memory)] {
        for storage in [Storage::Exact, Storage::Compact] {
            let interrupt = Interrupt::new();
            let options = Options {
                engine: EngineKind::Explicit,
                workers: 2,
                alone: Some(0),
                storage,
                interrupt: interrupt.clone(),
                ..Options::default()
            };
            let report = verify(&program, &options, &mut |_| {
                interrupt.raise(cause);
                true
            });
            let report = report.expect("there is an initial state");
            assert_eq!((report.stop, report.progress.states, report.complete), (Some(stop), 1, false));
            let unknown =
                |outcome: &Outcome| matches!(outcome, Outcome::Unknown(why) if why.contains(&Reason::Stopped(stop)));
            assert!(report.verdicts.iter().all(|verdict| unknown(&verdict.outcome)), "{:?}", report.verdicts);
        }
    }
    let interrupt = Interrupt::new();
    interrupt.raise(Cause::Asked);
    let options = Options { interrupt, ..Options::default() };
    assert_eq!(verify(&program, &options, &mut |_| true), Err(NoStart::Stopped(Stop::Asked)));
}

#[test]
fn sets_of_states_are_not_waited_for() {
    let program = wide(20);
    let interrupt = Interrupt::new();
    let options = Options { engine: EngineKind::Symbolic, interrupt: interrupt.clone(), ..Options::default() };
    let mut asked = |_: &Progress| {
        interrupt.raise(Cause::Asked);
        true
    };
    match verify(&program, &options, &mut asked) {
        Ok(report) => {
            assert_eq!(report.stop, Some(Stop::Asked));
            assert!(report.verdicts.iter().all(|verdict| matches!(verdict.outcome, Outcome::Unknown(_))));
        }
        // It had not come as far.
        Err(trouble) => assert_eq!(trouble, NoStart::Stopped(Stop::Asked)),
    }
}

#[test]
fn a_limit_of_states_is_passed_by_the_steps_of_one_state_at_most() {
    let program = wide(40);
    for (workers, max_states) in [(1, 100), (2, 100), (1, 1599)] {
        let options =
            Options { engine: EngineKind::Explicit, workers, max_states, alone: Some(0), ..Options::default() };
        let report = verify(&program, &options, &mut |_| true).expect("there is an initial state");
        assert_eq!((report.stop, report.progress.states), (Some(Stop::States), 1600), "all by the first state");
    }
    // Two choices: the number of states doubles with each level.
    let program = endless();
    for max_states in [50, 3_000, 5_000] {
        let options = Options { engine: EngineKind::Explicit, workers: 1, max_states, ..Options::default() };
        let report = verify(&program, &options, &mut |_| true).expect("there is an initial state");
        let states = report.progress.states;
        assert!(report.stop == Some(Stop::States) && (max_states..max_states + 2).contains(&states), "{states}");
    }
}

#[test]
fn states_without_end_are_never_gone_through_as_sets() {
    let report = verify(&endless(), &Options { max_bytes: 1 << 20, ..Options::default() }, &mut |_| true);
    let report = report.expect("there is an initial state");
    assert_eq!((report.engine, report.stop), (EngineKind::Explicit, Some(Stop::Memory)));
    assert!(report.progress.transitions > 0);
}

#[test]
fn the_first_violation_is_enough() {
    let program = endless();
    let options = Options { first: true, ..Options::default() };
    let report = verify(&program, &options, &mut |_| true).expect("there is an initial state");
    assert!(matches!(outcome(&report, "inv_small", &program), Outcome::Violated(_)));
    let temporal = report.verdicts.last().expect("a verdict");
    assert_eq!(temporal.outcome, Outcome::Unknown(vec![Reason::Stopped(Stop::Found)]), "its graph has no end");
}

/// Asks to stop after the first report.
#[derive(Default)]
struct Ear(BTreeMap<Subject, Trace>);

impl Listener for Ear {
    fn at(&mut self, _: &Progress) -> bool {
        self.0.is_empty()
    }

    fn wants(&mut self) -> bool {
        true
    }

    fn violated(&mut self, subject: Subject, trace: &Trace) {
        assert!(self.0.insert(subject, trace.clone()).is_none(), "{subject:?} is told once");
    }
}

#[test]
fn what_is_violated_is_told_while_the_search_goes_on() {
    let program = endless();
    let expected = verify(&program, &Options { max_depth: 8, ..Options::default() }, &mut |_| true);
    let expected = outcome(&expected.expect("there is an initial state"), "inv_small", &program);
    for workers in [1, 2] {
        let (options, mut ear) = (Options { workers, alone: Some(0), ..Options::default() }, Ear::default());
        // It would not end.
        let request = Request::of(&program, options).build().expect("nothing is in conflict");
        let report = request.verify(&mut NoSolvers, &mut ear);
        let report = report.expect("there is an initial state");
        assert_eq!(report.stop, Some(Stop::Asked));
        let told: Vec<Outcome> = ear.0.into_values().map(|trace| Outcome::Violated(Box::new(trace))).collect();
        assert_eq!(told, std::slice::from_ref(&expected), "{workers} workers");
        assert_eq!(outcome(&report, "inv_small", &program), expected, "{workers} workers");
    }
}
