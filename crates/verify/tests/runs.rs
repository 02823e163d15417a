//! Properties of runs of whole models, under several kinds of fairness.

#![allow(clippy::disallowed_methods, reason = "a test reads the repository's own models")]

use std::sync::Arc;

use machine::{Machine, Value};
use program::Program;
use syntax::SourceFile;
use testkit::{Random, repository, sample};
use verify::Trace;
use verify::runs::{OfRuns, RunPlan, Why, decide};
use verify::temporal::fairness::AgentFairness;

use crate::models::{Disk, lowered};

/// The swinging buffer, with more assumptions before its properties.
fn swing(assumptions: &str) -> Arc<Program> {
    let path = repository::root().join("bench/models/verify/SwingLive.asm");
    let file = Disk::read(&path).expect("the model is there");
    let text = file.text.replace("\tinvariant inv_whole", &format!("\t{assumptions}\n\tinvariant inv_whole"));
    lowered(SourceFile::new(file.name.clone(), text))
}

fn model(signature: &str, definitions: &str) -> Arc<Program> {
    let text = format!(
        "asm example\nimport StandardLibrary\nimport CTLLibrary\nimport LTLLibrary\nsignature:\n{signature}\n\
         definitions:\n{definitions}\n"
    );
    lowered(SourceFile::new("example.asm", text))
}

fn unlimited() -> RunPlan {
    RunPlan { max_states: u64::MAX, max_depth: u64::MAX, max_bytes: u64::MAX, ..RunPlan::default() }
}

fn ask(program: &Arc<Program>, question: &RunPlan) -> Vec<(String, OfRuns)> {
    let answers = decide(program, question, &mut |_| true).expect("there is an initial state");
    answers.into_iter().map(|(index, answer)| (program.properties[index].name.clone(), answer)).collect()
}

fn word(answer: &OfRuns) -> String {
    match answer {
        OfRuns::Holds => "holds".to_string(),
        OfRuns::Violated(trace) => match trace.turn {
            Some(turn) => format!("violated {} + {}", turn, trace.steps.len() - turn),
            None => format!("violated {}", trace.steps.len()),
        },
        OfRuns::Unknown(why) => format!("{why:?}"),
    }
}

fn words(program: &Arc<Program>, question: &RunPlan) -> Vec<String> {
    ask(program, question).iter().map(|(name, answer)| format!("{name} {}", word(answer))).collect()
}

#[test]
fn the_consumer_of_the_swinging_buffer_needs_strong_fairness() {
    let plain = swing("");
    let free = words(&plain, &unlimited());
    assert_eq!(free[..3], ["ctlSpec_canRead holds", "ctlSpec_excluded holds", "ctlSpec_reads violated 3 + 1"]);
    let weak = RunPlan { agents: Some(AgentFairness::Weak), ..unlimited() };
    let answers = words(&plain, &weak);
    for (answer, name) in answers[2..5].iter().zip(["ctlSpec_reads", "ltlSpec_writes", "ltlSpec_reads"]) {
        assert!(answer.starts_with(&format!("{name} violated")), "{answer}");
    }
    assert_eq!(answers[5..], ["ltlSpec_readsIfLetIn holds", "ltlSpec_readsWhatWasWritten holds"]);
    // Strong fairness: of the agents, or as an assumption about the consumer.
    let strong = RunPlan { agents: Some(AgentFairness::Strong), ..unlimited() };
    let let_in = swing("COMPASSION (lock = FREE, place(CONSUMER) = 1)");
    let answers = words(&plain, &strong);
    assert!(answers.iter().all(|answer| answer.ends_with(" holds")), "{answers:?}");
    // Fairness for the consumer promises nothing to the producer.
    for (index, answer) in words(&let_in, &weak).iter().enumerate() {
        assert_eq!(answer.ends_with(" holds"), index != 3, "{answer}");
    }
}

#[test]
fn who_asks_for_the_critical_section_gets_in_if_both_go_on() {
    let path = repository::root().join("examples/mutual_exclusion/Peterson.asm");
    let program = lowered(Disk::read(&path).expect("the model is there"));
    let free = words(&program, &unlimited());
    assert!(free[..5].iter().all(|answer| answer.ends_with(" holds")), "{free:?}");
    assert_eq!(free[5..], ["ltlSpec_served violated 5 + 1", "ltlSpec_overtakenOnce holds"]);
    let weak = words(&program, &RunPlan { agents: Some(AgentFairness::Weak), ..unlimited() });
    assert!(weak.iter().all(|answer| answer.ends_with(" holds")), "{weak:?}");
}

/// The states that a machine reaches by the steps of a trace.
fn replay(program: &Arc<Program>, trace: &Trace) -> Vec<Vec<(machine::Location, Value)>> {
    /// Inputs and choices of a step.
    type Given = (Vec<(machine::Location, Value)>, Vec<Vec<Value>>);
    struct Picks(Vec<Given>, usize, usize);
    impl machine::Environment for Picks {
        fn monitored(
            &mut self,
            program: &Program,
            location: machine::LocationRef<'_>,
            _: program::DomainId,
        ) -> Result<Value, String> {
            let shown = location.show(program).to_string();
            let given = self.0[self.1].0.iter().find(|(given, _)| given.show(program).to_string() == shown);
            given.map(|(_, value)| value.clone()).ok_or(shown)
        }
        fn choose(&mut self, _: &Program, choice: &machine::Choice<'_>) -> Result<usize, String> {
            let wanted = &self.0[self.1].1[self.2];
            self.2 += 1;
            (0..choice.candidates()).find(|index| choice.candidate(*index) == wanted).ok_or("no candidate".to_string())
        }
        fn time(&mut self, _: machine::TimeUnit) -> Result<i64, String> {
            Err("no clock".to_string())
        }
    }
    let told = |told: &explore::Told| -> Given {
        (told.inputs.clone(), told.choices.iter().map(|choice| choice.values.clone()).collect())
    };
    let mut picks = Picks(std::iter::once(&trace.start).chain(&trace.steps).map(told).collect(), 0, 0);
    let mut machine = Machine::new(Arc::clone(program), machine::Limits::default());
    machine.start(&mut picks).expect("it starts");
    let controlled = |machine: &mut Machine| {
        machine.forget_inputs();
        machine.locations()
    };
    let mut states = vec![controlled(&mut machine)];
    for step in 1..=trace.steps.len() {
        (picks.1, picks.2) = (step, 0);
        machine.step(&mut picks).expect("the step can be made");
        states.push(controlled(&mut machine));
    }
    states
}

#[test]
fn a_lasso_goes_round_when_it_is_run() {
    let plain = swing("");
    for agents in [None, Some(AgentFairness::Weak)] {
        let answers = ask(&plain, &RunPlan { agents, ..unlimited() });
        let (_, OfRuns::Violated(trace)) = &answers[4] else { panic!("{answers:?}") };
        let states = replay(&plain, trace);
        let turn = trace.turn.expect("a lasso");
        assert_eq!(states[turn], states[states.len() - 1]);
        let consumer = plain.find_function("place", 1).unwrap();
        let reads = |state: &Vec<(machine::Location, Value)>| {
            state.iter().any(|(location, value)| {
                let consumer = location.function == consumer && location.show(&plain).to_string() == "place(CONSUMER)";
                consumer && *value == Value::Integer(3)
            })
        };
        assert!(!states[turn..].iter().any(reads));
        // Without fairness the producer may rest; with it, the lock is taken and released again and again.
        let changes = trace.steps[turn..].iter().filter(|step| !step.changes.is_empty()).count();
        assert_eq!(changes > 0, agents.is_some(), "{trace:?}");
    }
}

const LAMP: &str = "monitored button: Boolean
    controlled lamp: Boolean
    controlled count: Integer";

#[test]
fn inputs_belong_to_the_state_as_far_as_a_formula_reads_them() {
    let program = model(
        LAMP,
        "CTLSPEC ctlSpec_follows: ag(button implies ax(lamp))
         CTLSPEC ctlSpec_can: ag(ef(lamp) and ef(not(lamp)))
         LTLSPEC ltlSpec_before: g(lamp implies y(button))
         LTLSPEC ltlSpec_on: f(lamp)
         LTLSPEC ltlSpec_pressed: g(f(button)) implies g(f(lamp))
         LTLSPEC ltlSpec_never: g(not(button))
         main rule r_Main = lamp := button
         default init s0: function lamp = false",
    );
    let expected = [
        "ctlSpec_follows holds",
        "ctlSpec_can holds",
        "ltlSpec_before holds",
        "ltlSpec_on violated 0 + 1",
        "ltlSpec_pressed holds",
        "ltlSpec_never violated 0",
    ];
    assert_eq!(words(&program, &unlimited()), expected);
}

/// What one formula reads is not in the states of another.
#[test]
fn no_formula_changes_the_verdict_of_another() {
    let one = "CTLSPEC ctlSpec_can: not(lamp) implies ex(lamp)";
    let others = [
        "CTLSPEC ctlSpec_follows: ag(button implies ax(lamp))",
        "LTLSPEC ltlSpec_before: g(lamp implies y(button))",
        "CTLSPEC ctlSpec_on: af(lamp)",
    ];
    let asked = |formulas: &[&str]| {
        let text = formulas.join("\n");
        let program =
            model(LAMP, &format!("{text}\nmain rule r_Main = lamp := button\ndefault init s0: function lamp = false"));
        words(&program, &unlimited())
    };
    let alone: Vec<String> = [one].iter().chain(&others).flat_map(|formula| asked(&[formula])).collect();
    assert_eq!(alone[0], "ctlSpec_can holds");
    assert_eq!(asked(&[one, others[0], others[1], others[2]]), alone);
    let mut turned = asked(&[others[2], others[1], others[0], one]);
    turned.reverse();
    assert_eq!(turned, alone);
}

/// Inputs that make the same true and lead to different states are different states.
#[test]
fn branches_belong_to_values_of_inputs() {
    let button = "enum domain Button = {NONE | GO | HALT}\nmonitored button: Button\ncontrolled up: Boolean";
    let lift = |formula: &str| {
        let program = model(
            button,
            &format!(
                "CTLSPEC ctlSpec_p: {formula}\nmain rule r_Main = up := button = GO\ndefault init s0: function up = false"
            ),
        );
        words(&program, &unlimited()).remove(0)
    };
    assert_eq!(lift("ag(button != HALT implies ex(up))"), "ctlSpec_p violated 0");
    assert_eq!(lift("ag(button = GO implies ax(up))"), "ctlSpec_p holds");
    assert_eq!(lift("eg(not(up) and (button = GO or button != GO))"), "ctlSpec_p violated 0");
    assert_eq!(lift("ag(button != HALT implies ax(ex(up)))"), "ctlSpec_p violated 1");
}

/// Formulas over inputs have the verdict that they have where the model draws the next input itself and keeps it in its state.
#[test]
fn an_input_is_as_good_as_a_part_of_the_state() {
    fn formula(random: &mut Random, depth: u64) -> String {
        let atoms = ["m = AA", "m != BB", "n = 0", "n != 2", "(m = AA or m != AA)", "(m = BB or n = 1)"];
        if depth == 0 {
            return random.pick(&atoms).to_string();
        }
        let mut part = || formula(random, depth - 1);
        let (p, q) = (part(), part());
        match random.below(9) {
            0 => format!("not({p})"),
            1 => format!("({p} and {q})"),
            2 => format!("({p} implies {q})"),
            3 => format!("ex({p})"),
            4 => format!("ax({p})"),
            5 => format!("ef({p})"),
            6 => format!("ag({p})"),
            7 => format!("eg({p})"),
            _ => format!("eu({p}, {q})"),
        }
    }
    let mut random = Random(7);
    let (mut held, mut violated) = (0, 0);
    for case in 0..sample::setting("GROUNDSTATE_CASES", 150) {
        let mut next = String::new();
        for m in ["AA", "BB", "CC"] {
            let of = |n: u64, random: &mut Random| format!("if $n = {n} then {} else", random.below(3));
            let (zero, one) = (of(0, &mut random), of(1, &mut random));
            next += &format!("case {m}: {zero} {one} {} endif endif\n", random.below(3));
        }
        // A formula that reads no input has none in its states.
        let mut reading = |depth| format!("CTLSPEC (m = AA or m != AA) and ({})", formula(&mut random, depth));
        let formulas: Vec<String> = (0..4).map(&mut reading).collect();
        let signature =
            "enum domain Letter = {AA | BB | CC}\ncontrolled n: Integer\nstatic next: Prod(Integer, Letter) -> Integer";
        let next =
            format!("function next($n in Integer, $m in Letter) = switch $m {next} endswitch\n{}", formulas.join("\n"));
        let given = model(
            &format!("{signature}\nmonitored m: Letter"),
            &format!("{next}\nmain rule r_Main = n := next(n, m)\ndefault init s0: function n = 0"),
        );
        let drawn = model(
            &format!("{signature}\ncontrolled m: Letter"),
            &format!(
                "{next}\nmain rule r_Main = choose $v in Letter with true do par n := next(n, m) m := $v endpar\n\
                 default init s0: function n = 0 function m = chooseone({{AA, BB, CC}})"
            ),
        );
        let verdicts = |program: &Arc<Program>| -> Vec<&str> {
            let verdict = |(_, answer): (String, OfRuns)| match answer {
                OfRuns::Holds => "holds",
                OfRuns::Violated(_) => "violated",
                OfRuns::Unknown(why) => panic!("{case}: {why:?}"),
            };
            ask(program, &unlimited()).into_iter().map(verdict).collect()
        };
        let found = verdicts(&given);
        assert_eq!(found, verdicts(&drawn), "{case}: {next}");
        held += found.iter().filter(|word| **word == "holds").count();
        violated += found.iter().filter(|word| **word == "violated").count();
    }
    assert!(held > 50 && violated > 50, "{held} hold, {violated} are violated");
}

#[test]
fn assumptions_on_inputs_are_kept() {
    let program = model(
        LAMP,
        "INVAR not(lamp) implies button
         JUSTICE not(lamp)
         LTLSPEC ltlSpec_on: f(lamp)
         LTLSPEC ltlSpec_both: g(f(lamp) and f(not(lamp)))
         main rule r_Main = lamp := button
         default init s0: function lamp = false",
    );
    let condition = |property: &program::Property| (property.formula.clone(), true);
    let assumed = program.properties.iter().filter(|p| p.kind == program::PropertyKind::Invar).map(condition);
    let settings = explore::Settings { step_conditions: assumed.collect(), ..Default::default() };
    assert_eq!(words(&program, &RunPlan { settings, ..unlimited() }), ["ltlSpec_on holds", "ltlSpec_both holds"]);
}

#[test]
fn nothing_is_said_to_hold_that_is_not_known() {
    let counter = model(
        LAMP,
        "LTLSPEC ltlSpec_small: g(count < 1000)
         LTLSPEC ltlSpec_tiny: g(count < 5)
         CTLSPEC ctlSpec_large: ef(count = 7)
         LTLSPEC ltlSpec_undefined: g(f(lamp))
         main rule r_Main = count := count + 1
         default init s0: function count = 0",
    );
    let few = RunPlan { max_states: 20, ..unlimited() };
    let answers = ask(&counter, &few);
    let unexplored = OfRuns::Unknown(Why::Unexplored(Some(verify::Stop::States)));
    assert_eq!(answers[0].1, unexplored);
    assert_eq!(word(&answers[1].1), "violated 5");
    assert_eq!(answers[2].1, unexplored);
    assert!(matches!(&answers[3].1, OfRuns::Unknown(Why::NoTruth(..))), "{:?}", answers[3]);
    let shallow = RunPlan { max_depth: 3, ..unlimited() };
    assert_eq!(ask(&counter, &shallow)[1].1, OfRuns::Unknown(Why::Unexplored(Some(verify::Stop::Depth))));
    let unfair = model(
        LAMP,
        "JUSTICE count > 3
         LTLSPEC ltlSpec_any: g(count = 17)
         main rule r_Main = count := 1 - count
         default init s0: function count = 0",
    );
    assert_eq!(ask(&unfair, &unlimited())[0].1, OfRuns::Unknown(Why::NoFairRun));
    let weak = RunPlan { agents: Some(AgentFairness::Weak), ..unlimited() };
    assert_eq!(ask(&unfair, &weak)[0].1, OfRuns::Unknown(Why::NoScheduler));
}

#[test]
fn a_step_that_cannot_be_made_is_the_end_of_a_run() {
    let program = model(
        LAMP,
        "CTLSPEC ctlSpec_on: ag(ef(count = 3))
         LTLSPEC ltlSpec_on: f(count = 3)
         main rule r_Main = par count := count + 1 if count = 2 then count := 9 endif endpar
         default init s0: function count = 0",
    );
    assert_eq!(words(&program, &unlimited()), ["ctlSpec_on violated 0", "ltlSpec_on violated 2 + 1"]);
}

#[test]
fn temporal_properties_are_checked_with_all_others() {
    use verify::{NoSolvers, Outcome, Reason, Request, Subject, verify};
    let plain = swing("");
    let options = verify::Options::default();
    let request = Request::of(&plain, options.clone()).fair(Some(AgentFairness::Strong)).build().unwrap();
    let report = request.verify(&mut NoSolvers, &mut |_: &verify::Progress| true).unwrap();
    assert!(report.verdicts.iter().all(|verdict| verdict.outcome == Outcome::Holds), "{:#?}", report.verdicts);
    assert_eq!(report.verdicts.len(), 4 + plain.properties.len());
    let bounded = model(
        "monitored level: Integer
         controlled seen: Integer",
        "CTLSPEC ctlSpec_high: ef(seen = 7)
         CTLSPEC ctlSpec_low: ag(seen = 0)
         LTLSPEC ltlSpec_any: g(seen < 7)
         main rule r_Main = seen := level
         default init s0: function seen = 0",
    );
    let level = bounded.find_function("level", 0).unwrap();
    let bounds = [(level, vec![Value::Integer(0), Value::Integer(1)])].into();
    let report = verify(&bounded, &verify::Options { bounds, ..options }, &mut |_| true).unwrap();
    let outcome = |index| {
        let mut verdicts = report.verdicts.iter().filter(|verdict| verdict.subject == Subject::Property(index));
        verdicts.next().map(|verdict| verdict.outcome.clone()).expect("a verdict")
    };
    assert_eq!(outcome(0), Outcome::Unknown(vec![Reason::Bounded(level)]));
    assert!(matches!(outcome(1), Outcome::Violated(trace) if trace.steps.len() == 1));
    assert_eq!(outcome(2), Outcome::Unknown(vec![Reason::Bounded(level)]));
}

#[test]
fn a_subset_that_does_not_grow_is_gone_through() {
    let program = model(
        "domain P subsetof Agent\ncontrolled eating: P -> Boolean\nstatic p1: P\nstatic p2: P",
        "CTLSPEC (forall $p in P with ag(ef(eating($p))))\n\
         main rule r_Main = choose $p in P with true do eating($p) := not eating($p)\n\
         default init s0: function eating($p in P) = false",
    );
    assert!(
        words(&program, &unlimited()).iter().all(|word| word.ends_with("holds")),
        "{:?}",
        words(&program, &unlimited())
    );
}

#[test]
fn a_formula_at_fault_leaves_the_others_their_verdicts() {
    let program = model(
        "dynamic abstract domain Q\ncontrolled on: Q -> Boolean\ncontrolled c: Boolean",
        "CTLSPEC (forall $q in Q with ag(ef(on($q))))\nCTLSPEC ag(ef(c))\nLTLSPEC g(c)\n\
         main rule r_Main = par c := not c if false then extend Q with $q do on($q) := false endif endpar\n\
         default init s0: function c = false",
    );
    let answers = ask(&program, &unlimited());
    let said: Vec<&OfRuns> = answers.iter().map(|(_, answer)| answer).collect();
    assert!(matches!(said[0], OfRuns::Unknown(Why::Unread(what)) if what.contains("changes from state to state")));
    assert_eq!(*said[1], OfRuns::Holds);
    assert!(matches!(said[2], OfRuns::Violated(_)));
}

/// Who moves is chosen until nobody can; then a step that chooses nobody changes the state again and again. No run ends there.
#[test]
fn a_step_that_chooses_nobody_is_told() {
    let program = model(
        "enum domain Who = {LEFT | RIGHT} domain Small subsetof Integer controlled n: Small controlled rest: Boolean",
        "domain Small = {0 : 3} LTLSPEC ltlSpec_always: f(g(rest)) LTLSPEC ltlSpec_never: g(not rest) \
         main rule r_Main = choose $w in Who with n < 3 do n := n + 1 ifnone rest := not rest \
         default init s0: function n = 0 function rest = false",
    );
    let plan = RunPlan { agents: Some(AgentFairness::Weak), ..unlimited() };
    let decided = decide(&program, &plan, &mut |_| true).expect("there is an initial state");
    for (index, answer) in decided {
        let OfRuns::Violated(trace) = answer else { panic!("{index}: {answer:?}") };
        assert!(!trace.ends && trace.steps.iter().all(|step| !step.changes.is_empty()), "{index}: {trace:?}");
        assert!(trace.steps.len() > 3, "{index}: {trace:?}");
    }
}
