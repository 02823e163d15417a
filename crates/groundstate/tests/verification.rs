//! The examples of spec/verification.md have the verdicts shown below them. Faults that only verification finds have
//! pages whose examples show them. Counterexamples fail as scenarios where they end.

use std::sync::Arc;

use groundstate::scenario::{FirstCandidate, Options as Scenario};
use groundstate::verify::solver::Method;
use groundstate::verify::vacuity::Question;
use groundstate::verify::{EngineKind, NoStart, Options, Outcome, Reason, Report, Subject, verify};
use groundstate::{Suite, counterexample_scenario};
use program::{FunctionId, FunctionKind, Program};
use syntax::SourceFile;
use testkit::{Page, Texts};

/// The name of a model's file.
fn file(model: &str) -> String {
    format!("{}.asm", model.split_whitespace().nth(1).expect("it begins with `asm` and its name"))
}

/// The one model of an example.
fn one_model(text: &str) -> Texts {
    Texts::of([(file(text).as_str(), text)])
}

fn check(text: &str, workers: usize) -> (Arc<Program>, Report) {
    checked(text, workers, false)
}

/// Inputs may be undef if `undefined`.
fn checked(text: &str, workers: usize, undefined: bool) -> (Arc<Program>, Report) {
    let mut loader = one_model(text);
    let loaded = groundstate::load(SourceFile::new(file(text), text), &mut loader);
    let program = loaded.unwrap_or_else(|faulty| panic!("{:#?}", faulty.diagnostics)).program;
    let inputs = (0..).map(FunctionId).zip(&program.functions).filter(|(_, one)| one.kind == FunctionKind::Monitored);
    let undefined = inputs.filter(|_| undefined).map(|(id, _)| id).collect();
    let report = verify(&program, &Options { workers, undefined, ..Options::default() }, &mut |_| true);
    (program, report.unwrap_or_else(|trouble| panic!("{trouble:?}")))
}

fn name(program: &Program, subject: Subject) -> String {
    match subject {
        Subject::Consistent => "consistent".to_string(),
        Subject::InDomain => "in-domain".to_string(),
        Subject::Defined => "defined".to_string(),
        Subject::NoDeadlock => "no-deadlock".to_string(),
        Subject::Property(index) => program.properties[index].name.clone(),
    }
}

fn verdicts(program: &Program, report: &Report) -> String {
    let lines = report.verdicts.iter().map(|verdict| {
        let name = name(program, verdict.subject);
        match &verdict.outcome {
            Outcome::Holds => format!("holds {name}\n"),
            Outcome::Violated(trace) => format!("violated {name} {}\n", trace.steps.len()),
            Outcome::Unknown(_) => format!("unknown {name}\n"),
        }
    });
    let states = format!("states {}\n", report.progress.states);
    let blocked = (report.progress.blocked > 0).then(|| format!("blocked {}\n", report.progress.blocked));
    lines.chain([states]).chain(blocked).collect()
}

#[test]
fn the_examples_have_the_verdicts_that_the_page_says() {
    let page = Page::spec("verification");
    for (model, expected, undefined) in
        [("asmetal verify", "verdicts", false), ("asmetal verify undefined", "verdicts undefined", true)]
    {
        let (models, expected) = (page.texts(model), page.texts(expected));
        assert_eq!(models.len(), expected.len());
        assert!(!models.is_empty());
        for (model, expected) in models.iter().zip(expected) {
            for workers in [1, 2] {
                let (program, report) = checked(model, workers, undefined);
                assert_eq!(verdicts(&program, &report), expected, "{model}");
            }
        }
    }
}

#[test]
fn counterexamples_fail_as_scenarios_where_they_end() {
    let page = Page::spec("verification");
    let mut failed = 0;
    for model in page.texts("asmetal verify") {
        let (program, report) = check(model, 1);
        for verdict in &report.verdicts {
            let Outcome::Violated(trace) = &verdict.outcome else { continue };
            // Only that nothing comes any more violates a formula then, which no scenario says.
            if trace.ends {
                continue;
            }
            let text = counterexample_scenario(&program, trace, verdict.subject, "example", &file(model));
            let mut loader = one_model(model);
            let source = SourceFile::new("example.avalla", text.clone());
            let tested = Suite::new().test(source, &mut loader, Scenario::default(), &mut FirstCandidate);
            let found = tested.verdict.unwrap_or_else(|| panic!("{:#?}\n{text}", tested.diagnostics));
            let made = trace.steps.iter().filter(|step| step.fault.is_none()).count() as u64;
            // A deadlock takes one more step to show, which changes nothing.
            let more = u64::from(verdict.subject == Subject::NoDeadlock);
            assert!(!found.failures().is_empty(), "{text}");
            assert_eq!(found.steps, made + more, "{text}");
            failed += 1;
        }
    }
    assert_eq!(failed, 2);
}

/// Of a machine with several initial states the scenario begins in the one that was found, whatever is chosen.
#[test]
fn a_counterexample_begins_in_its_initial_state() {
    let begins = |signature: &str, rest: &str, steps: u64| {
        let model = format!(
            "asm Start\nimport StandardLibrary\nsignature:\n\tcontrolled n: Integer\n{signature}definitions:\n{rest}"
        );
        let (program, report) = check(&model, 1);
        let invariant = report.verdicts.iter().find(|verdict| matches!(verdict.subject, Subject::Property(_)));
        let Some(Outcome::Violated(trace)) = invariant.map(|verdict| &verdict.outcome) else { panic!("{report:#?}") };
        let subject = Subject::Property(0);
        let text = counterexample_scenario(&program, trace, subject, "example", &file(&model));
        let source = SourceFile::new("example.avalla", text.clone());
        let tested = Suite::new().test(source, &mut one_model(&model), Scenario::default(), &mut FirstCandidate);
        let found = tested.verdict.unwrap_or_else(|| panic!("{:#?}\n{text}", tested.diagnostics));
        assert!(!found.failures().is_empty() && found.steps == steps, "{text}");
    };
    begins(
        "\tcontrolled by: Integer\n",
        "\tinvariant inv_even over n: n != 6\n\tmain rule r_Main = if n < 6 then n := n + by endif\n\
         default init s0:\n\tfunction by = chooseone({5, 4, 3})\n\tfunction n = 0\n",
        2,
    );
    // What was found may have no value where another choice gives one.
    begins(
        "\tcontrolled by: Integer\n",
        "\tinvariant inv_by over n: n < 2 or isDef(by)\n\tmain rule r_Main = if n < 3 then n := n + 1 endif\n\
         default init s0:\n\tfunction by = if chooseone({1, 2, 3}) < 3 then 1 else undef endif\n\tfunction n = 0\n",
        2,
    );
    begins(
        "\tenum domain Side = {LEFT | RIGHT}\n\tcontrolled by: Side -> Integer\n\tcontrolled on: Side\n",
        "\tinvariant inv_by over n: n < 2 or isDef(by(LEFT)) or isUndef(by(RIGHT))\n\tmain rule r_Main = if n < 3 then n := n + 1 endif\n\
         default init s0:\n\tfunction on = chooseone({LEFT, RIGHT})\n\
         \tfunction by($s in Side) = if $s = on then 1 else undef endif\n\tfunction n = 0\n",
        2,
    );
}

/// A run of a formula may meet a step that cannot be made: it stays in its state, and goes on with other inputs. The run is made again, and
/// its scenario expects the fault.
#[test]
fn a_run_of_a_formula_goes_on_after_a_step_that_cannot_be_made() {
    let model = "asm Fork\nimport StandardLibrary\nimport LTLLibrary\nsignature:\n\tenum domain Place = {HERE | THERE | AWAY}\n\
                 \tcontrolled at: Place\n\tcontrolled done: Boolean\n\tmonitored go: Boolean\ndefinitions:\n\
                 \tLTLSPEC ltlSpec_done: o(f(done))\n\tmain rule r_Main =\n\
                 \t\tif at = HERE then if go then at := THERE else par at := THERE at := AWAY endpar endif\n\
                 \t\telse if go then at := HERE else at := AWAY endif endif\n\
                 default init s0:\n\tfunction at = HERE\n\tfunction done = false\n";
    let (program, report) = check(model, 1);
    let formula = report.verdicts.iter().find(|verdict| matches!(verdict.subject, Subject::Property(_)));
    let Some(Outcome::Violated(trace)) = formula.map(|verdict| &verdict.outcome) else { panic!("{report:#?}") };
    let faults = trace.steps.iter().filter(|step| step.fault.is_some()).count();
    assert!(faults > 0 && trace.steps.last().is_some_and(|step| step.fault.is_none()), "it goes on: {trace:#?}");
    let text = counterexample_scenario(&program, trace, Subject::Property(0), "example", &file(model));
    assert_eq!(text.matches("expect inconsistent update;").count(), faults, "{text}");
    let source = SourceFile::new("example.avalla", text.clone());
    let tested = Suite::new().test(source, &mut one_model(model), Scenario::default(), &mut FirstCandidate);
    let found = tested.verdict.unwrap_or_else(|| panic!("{:#?}\n{text}", tested.diagnostics));
    assert!(found.failures().is_empty(), "{:#?}\n{text}", found.failures());
}

#[test]
fn the_pages_of_faults_show_them() {
    let unreachable = Page::fault("unreachable-rule");
    let (_, report) = check(unreachable.example("asmetal verify"), 1);
    assert_eq!(report.unreachable.len(), 1);
    assert_eq!(groundstate::diagnose_unreachable(report.unreachable[0]).id, "unreachable-rule");
    let idle = Page::fault("idle-part");
    let (program, report) = check(idle.example("asmetal verify"), 1);
    assert_eq!(report.verdicts.last().map(|verdict| &verdict.outcome), Some(&Outcome::Holds));
    let question = Question::new(&program, &[0]);
    let asked = verify(&Arc::new(question.program.clone()), &Options::default(), &mut |_| true);
    let found = question.idle(&asked.expect("it starts")).parts;
    assert_eq!(found.len(), 1);
    assert_eq!(groundstate::diagnose_idle(&found[0], &program).id, "idle-part");
    let no_bound = Page::fault("no-bound");
    let text = no_bound.example("asmetal verify");
    let (program, report) = check(text, 1);
    let Outcome::Unknown(reasons) = &report.verdicts[0].outcome else { panic!("{:?}", report.verdicts[0]) };
    let [Reason::Unbounded(unbounded)] = &reasons[..] else { panic!("{reasons:?}") };
    let loaded = groundstate::load(SourceFile::new(file(text), text), &mut one_model(text)).expect("it has no faults");
    let fault = groundstate::diagnose_unbounded(unbounded, &program, &loaded.sources);
    let message = "the values of inflow cannot be enumerated (example.asm:4:15)";
    assert_eq!((fault.id, fault.message.as_str()), ("no-bound", message));
    let unclear = Page::fault("assumption-without-value");
    let text = unclear.example("asmetal verify");
    let (program, report) = check(text, 1);
    for verdict in &report.verdicts {
        let Outcome::Unknown(reasons) = &verdict.outcome else { panic!("{verdict:?}") };
        let [Reason::Unbounded(unbounded)] = &reasons[..] else { panic!("{reasons:?}") };
        let loaded =
            groundstate::load(SourceFile::new(file(text), text), &mut one_model(text)).expect("it has no faults");
        let fault = groundstate::diagnose_unbounded(unbounded, &program, &loaded.sources);
        let message = "an assumption has no value for some inputs (example.asm:9:11)";
        assert_eq!((fault.id, fault.message.as_str()), ("assumption-without-value", message));
    }
    let outside = Page::fault("outside-solver");
    let text = outside.example("asmetal solver");
    let loaded = groundstate::load(SourceFile::new(file(text), text), &mut one_model(text));
    let program = loaded.unwrap_or_else(|faulty| panic!("{:#?}", faulty.diagnostics)).program;
    let options = Options { engine: EngineKind::Solver(Method::Bounded), ..Options::default() };
    let trouble = verify(&program, &options, &mut |_| true);
    let Err(NoStart::Outside(outside)) = trouble else { panic!("{trouble:?}") };
    assert_eq!(groundstate::diagnose_outside(&outside).id, "outside-solver");
    assert_eq!(outside.what, "a function with values in Seq(Integer)");
    let violated = Page::fault("property-violated");
    let (program, report) = check(violated.example("asmetal verify"), 1);
    let Outcome::Violated(trace) = &report.verdicts[4].outcome else { panic!("{:?}", report.verdicts[4]) };
    assert_eq!(groundstate::diagnose_property(&program.properties[0], trace).id, "property-violated");
    assert_eq!((trace.steps.len(), trace.turn), (2, Some(0)));
}
