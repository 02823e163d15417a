//! Inputs that initial values have read are kept in the first step by every engine.
//!
//! They are compared with a machine without exploration: it is started, and makes each step with every answer to every
//! question. An input that it has forgotten is asked for again, as in a run.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::sync::Arc;

use machine::{Choice, EngineChoice, Environment, FaultClass, Limits, Location, LocationRef, Machine, TimeUnit, Value};
use program::{DomainId, FunctionId, FunctionKind, Program, PropertyKind};
use syntax::SourceFile;
use verify::{EngineKind, Options, Outcome, Reason, Storage, Subject, verify};

use crate::models::lowered;

fn model(text: &str) -> Arc<Program> {
    let header = "asm example\nimport StandardLibrary\nimport CTLLibrary\nimport LTLLibrary\nsignature:\n";
    lowered(SourceFile::new("example.asm", format!("{header}{text}\n")))
}

/// Enumerates answers, the last one varying fastest.
#[derive(Default)]
struct Odometer {
    /// Inputs may be undef, too.
    undefined: bool,
    answers: Vec<(usize, usize)>,
    at: usize,
}

impl Odometer {
    fn ask(&mut self, of: usize) -> usize {
        if self.at == self.answers.len() {
            self.answers.push((0, of));
        }
        self.answers[self.at].1 = of;
        self.at += 1;
        self.answers[self.at - 1].0
    }

    fn next(&mut self) -> bool {
        self.at = 0;
        while let Some((taken, of)) = self.answers.pop() {
            if taken + 1 < of {
                self.answers.push((taken + 1, of));
                return true;
            }
        }
        false
    }
}

impl Environment for Odometer {
    fn monitored(&mut self, _: &Program, _: LocationRef<'_>, _: DomainId) -> Result<Value, String> {
        Ok([Value::Boolean(false), Value::Boolean(true), Value::Undef][self.ask(2 + usize::from(self.undefined))]
            .clone())
    }

    fn choose(&mut self, _: &Program, choice: &Choice<'_>) -> Result<usize, String> {
        Ok(self.ask(choice.candidates()))
    }

    fn time(&mut self, _: TimeUnit) -> Result<i64, String> {
        Ok(0)
    }
}

type State = Vec<(Location, Value)>;
type Answers = Vec<(usize, usize)>;

/// The results of the machine by itself.
#[derive(Debug, Default)]
struct Judge {
    /// Inputs may be undef, too.
    undefined: bool,
    /// For each property, the number of steps to its first violation; if it reads inputs, it is evaluated in the step
    /// after them.
    violated: BTreeMap<usize, usize>,
    failed: BTreeMap<FaultClass, usize>,
    /// With the answers at the start, since initial values that are computed later depend on them.
    states: BTreeSet<(Answers, State)>,
}

/// LIMIT: the steps of a run; they suffice to reach all states of these models.
const DEPTH: usize = 40;

impl Judge {
    fn of(program: &Arc<Program>, undefined: bool) -> Judge {
        let mut judge = Judge { undefined, ..Judge::default() };
        let (mut level, mut start) = (Vec::new(), judge.odometer(&[]));
        loop {
            let mut machine = Machine::new(Arc::clone(program), Limits::default());
            machine.start(&mut start).expect("there is an initial state");
            if admits(program, &mut machine) {
                judge.look(program, &mut machine, 0);
                level.push(vec![start.answers.clone()]);
            }
            if !start.next() {
                break;
            }
        }
        for depth in 0..DEPTH {
            for path in std::mem::take(&mut level) {
                let mut step = judge.odometer(&[]);
                loop {
                    let mut machine = judge.again(program, &path);
                    if let Some(next) = judge.successor(program, &mut machine, &mut step, depth)
                        && judge.states.insert((path[0].clone(), next))
                    {
                        level.push(path.iter().cloned().chain([step.answers.clone()]).collect());
                    }
                    if !step.next() {
                        break;
                    }
                }
            }
        }
        assert!(level.is_empty(), "not all states were met");
        judge
    }

    /// The state after a step; `None` if the step fails, or an assumption excludes it.
    fn successor(
        &mut self,
        program: &Arc<Program>,
        machine: &mut Machine,
        step: &mut Odometer,
        depth: usize,
    ) -> Option<State> {
        let prepared = machine.prepare(step);
        let read = |kind| program.properties.iter().enumerate().filter(move |(_, one)| one.kind == kind);
        for (_, property) in read(PropertyKind::Invar).filter(|(_, property)| property.reads_monitored) {
            if machine.evaluate(&property.formula, step) != Ok(Value::Boolean(true)) {
                return None;
            }
        }
        if let Err(fault) = prepared {
            self.failed.entry(FaultClass::of(&fault)).or_insert(depth + 1);
            return None;
        }
        for (index, property) in read(PropertyKind::Invariant).filter(|(_, property)| property.reads_monitored) {
            if machine.evaluate(&property.formula, step) != Ok(Value::Boolean(true)) {
                self.violated.entry(index).or_insert(depth + 1);
            }
        }
        machine.commit();
        machine.forget_inputs();
        self.look(program, machine, depth + 1);
        Some(state(machine))
    }

    /// A machine that was started and has made these steps. It never steps back, so it keeps the inputs as in a run.
    fn again(&self, program: &Arc<Program>, path: &[Answers]) -> Machine {
        let mut machine = Machine::new(Arc::clone(program), Limits::default());
        machine.use_engine(EngineChoice::Interpreted);
        machine.start(&mut self.odometer(&path[0])).expect("it was started before");
        for answers in &path[1..] {
            machine.prepare(&mut self.odometer(answers)).expect("the step was made before");
            machine.commit();
        }
        machine
    }

    fn odometer(&self, answers: &[(usize, usize)]) -> Odometer {
        Odometer { undefined: self.undefined, answers: answers.to_vec(), at: 0 }
    }

    fn look(&mut self, program: &Arc<Program>, machine: &mut Machine, depth: usize) {
        for (index, property) in program.properties.iter().enumerate() {
            let wanted = property.kind == PropertyKind::Invariant && !property.reads_monitored;
            if wanted && machine.evaluate(&property.formula, &mut Odometer::default()) != Ok(Value::Boolean(true)) {
                self.violated.entry(index).or_insert(depth);
            }
        }
    }
}

/// Whether the inputs read at the start violate no assumption.
fn admits(program: &Arc<Program>, machine: &mut Machine) -> bool {
    program.properties.iter().filter(|one| one.kind == PropertyKind::Invar).all(|property| {
        let mut more = Odometer::default();
        machine.evaluate(&property.formula, &mut more) == Ok(Value::Boolean(true)) || more.at > 0
    })
}

fn state(machine: &Machine) -> State {
    let kind = |location: &Location| machine.program().function(location.function).kind;
    machine.locations().into_iter().filter(|(location, _)| kind(location) != FunctionKind::Monitored).collect()
}

/// The ways of exploring states.
fn ways() -> Vec<(&'static str, Options)> {
    let plain = Options { engine: EngineKind::Explicit, ..Options::default() };
    vec![
        ("explicit", plain.clone()),
        ("forgetful", Options { forgetful: true, ..plain.clone() }),
        ("compiled", Options { forgetful: true, steps: EngineChoice::Compiled, ..plain.clone() }),
        ("two workers", Options { workers: 2, alone: Some(0), ..plain.clone() }),
        ("partial order", Options { partial_order: true, ..plain.clone() }),
        ("symmetry", Options { symmetry: true, ..plain.clone() }),
        ("sets", Options { engine: EngineKind::Symbolic, ..plain.clone() }),
        ("automatic", Options { engine: EngineKind::Automatic, ..plain.clone() }),
        ("compact", Options { storage: Storage::Compact, ..plain }),
    ]
}

#[track_caller]
fn agrees(text: &str) {
    is_judged(text, false);
}

/// What every way says of a model is what the judge says; inputs may be undef if `undefined`.
#[track_caller]
fn is_judged(text: &str, undefined: bool) {
    let program = model(text);
    let judge = Judge::of(&program, undefined);
    let inputs = (0..).map(FunctionId).zip(&program.functions).filter(|(_, one)| one.kind == FunctionKind::Monitored);
    let open: BTreeSet<FunctionId> = inputs.filter(|_| undefined).map(|(id, _)| id).collect();
    for (way, options) in ways() {
        let options = Options { undefined: open.clone(), ..options };
        let report = verify(&program, &options, &mut |_| true).expect("there is an initial state");
        for verdict in &report.verdicts {
            let expected = match verdict.subject {
                Subject::Consistent => judge.failed.get(&FaultClass::Inconsistent).copied(),
                Subject::InDomain => judge.failed.get(&FaultClass::OutOfDomain).copied(),
                Subject::Defined => judge.failed.get(&FaultClass::Undefined).copied(),
                Subject::Property(index) => judge.violated.get(&index).copied(),
                _ => continue,
            };
            let said = match &verdict.outcome {
                Outcome::Holds => None,
                Outcome::Unknown(reasons) if reasons[..] == [Reason::Compacted] => None,
                Outcome::Violated(trace) => Some(trace.steps.len()),
                Outcome::Unknown(reasons) => panic!("{way}: {:?} {reasons:?}\n{text}", verdict.subject),
            };
            assert_eq!(said, expected, "{way}: {:?}\n{text}", verdict.subject);
        }
    }
}

const FLAGS: &str =
    "monitored mon: Boolean\ncontrolled foo: Boolean\ncontrolled first: Boolean\ncontrolled bad: Boolean\n";
const FIRST_KEEPS: &str = "main rule r_Main = par first := false if first and mon != foo then bad := true endif endpar\n\
    default init s0: function foo = mon function first = true function bad = false";

#[test]
fn the_first_step_keeps_the_input_of_the_initial_state() {
    agrees(&format!("{FLAGS}definitions:\ninvariant inv_a over bad: not bad\n{FIRST_KEEPS}"));
}

#[test]
fn an_invariant_over_inputs_sees_the_input_of_the_initial_state() {
    agrees(&format!("{FLAGS}definitions:\ninvariant inv_a over foo: first implies foo = mon\n{FIRST_KEEPS}"));
    agrees(&format!("{FLAGS}definitions:\ninvariant inv_a over foo: foo = mon\n{FIRST_KEEPS}"));
}

#[test]
fn an_assumption_about_inputs_binds_the_initial_one() {
    agrees(&format!("{FLAGS}definitions:\ninvariant inv_a over bad: not bad\nINVAR mon = false\n{FIRST_KEEPS}"));
}

#[test]
fn an_assumption_about_inputs_rules_out_faults() {
    let faulty =
        "monitored mon: Boolean\nmonitored other: Boolean\ncontrolled none: Boolean\ncontrolled foo: Boolean\n";
    let main = "main rule r_Main = if mon then if none then skip endif else foo := not foo endif\n\
                default init s0: function foo = false";
    for assumed in ["mon = false", "other implies not mon", "other implies mon", "mon implies none", "true"] {
        agrees(&format!("{faulty}definitions:\ninvariant inv_a over foo: not foo\nINVAR {assumed}\n{main}"));
    }
}

#[test]
fn steps_that_are_ruled_out_say_nothing_of_formulas() {
    let text = "INVAR mon = false\nLTLSPEC g(not mon)\nCTLSPEC ag(not mon)\nLTLSPEC f(mon)\n";
    let program = model(&format!("{FLAGS}definitions:\n{text}{FIRST_KEEPS}"));
    let report = verify(&program, &Options::default(), &mut |_| true).expect("there is an initial state");
    let decided = |one: &verify::Verdict| match one.outcome {
        Outcome::Holds => Some(true),
        Outcome::Violated(_) => Some(false),
        Outcome::Unknown(_) => None,
    };
    let all: Vec<Option<bool>> = report.verdicts.iter().skip(4).map(decided).collect();
    assert_eq!(all, [Some(true), Some(true), Some(false)]);
}

#[test]
fn a_temporal_property_sees_the_input_of_the_initial_state() {
    let formulas = "CTLSPEC foo = mon\nLTLSPEC foo = mon\nCTLSPEC ax(foo = mon)\nLTLSPEC x(foo = mon)\n";
    let program = model(&format!("{FLAGS}definitions:\n{formulas}{FIRST_KEEPS}"));
    let report = verify(&program, &Options::default(), &mut |_| true).expect("there is an initial state");
    let holds: Vec<bool> = report.verdicts.iter().skip(4).map(|one| one.outcome == Outcome::Holds).collect();
    assert_eq!(holds, [true, true, false, false]);
}

#[test]
fn an_initial_state_whose_inputs_are_ruled_out_is_none() {
    agrees(&format!("{FLAGS}definitions:\ninvariant inv_a over foo: not foo\nINVAR mon = false\n{FIRST_KEEPS}"));
    let program = model(&format!("{FLAGS}definitions:\nCTLSPEC not foo\nINVAR mon = false\n{FIRST_KEEPS}"));
    let report = verify(&program, &Options::default(), &mut |_| true).expect("there is an initial state");
    assert_eq!(report.verdicts.last().map(|one| &one.outcome), Some(&Outcome::Holds));
}

#[test]
fn what_only_initial_values_read_is_no_part_of_the_states() {
    let program = model(
        "monitored mon: Boolean\ncontrolled foo: Boolean\ndefinitions:\nmain rule r_Main = foo := not foo\n\
         default init s0: function foo = mon",
    );
    let report = verify(&program, &Options::default(), &mut |_| true).expect("there is an initial state");
    assert_eq!((report.progress.states, report.width.1), (2, 1));
}

#[test]
fn initial_values_that_come_up_later_belong_to_the_run() {
    agrees(
        "monitored mon: Boolean\ncontrolled c: Boolean\ncontrolled d: Boolean\ncontrolled again: Boolean\n\
         controlled late: Integer -> Boolean\ndefinitions:\n\
         invariant inv_a over d: again implies (d = late(7))\ninvariant inv_b over d: not again or d = c\n\
         main rule r_Main = par again := true d := late(7) endpar\n\
         default init s0: function c = mon function d = false function again = false function late($x in Integer) = c",
    );
}

#[test]
fn a_shared_location_that_the_start_has_asked_for_stays() {
    agrees(
        "shared seen: Integer -> Boolean\ncontrolled c: Boolean\ncontrolled bad: Boolean\ndefinitions:\n\
         invariant inv_a over bad: not bad\n\
         main rule r_Main = if seen(3) != c then bad := true endif\n\
         default init s0: function c = seen(3) function bad = false",
    );
}

#[test]
fn a_domain_that_the_start_fills_from_inputs_is_part_of_the_states() {
    let domains = "dynamic domain Few subsetof Integer\ndynamic domain Same subsetof Integer\nmonitored mon: Boolean\n\
                   controlled x: Integer\n";
    for over in ["Few", "Same"] {
        agrees(&format!(
            "{domains}definitions:\ninvariant inv_a over x: x != 2\ninvariant inv_b over x: x != 1\n\
             main rule r_Main = if (exist $s in {over} with $s = 2) then x := 2 else x := 1 endif\n\
             default init s0: domain Few = if mon then {{1}} else {{2, 3}} endif domain Same = {{$n in Few | $n > 0 : $n}}\n\
             function x = 0"
        ));
    }
}

/// A random model: initial values, guards and properties over inputs, the state, a definition and each other.
fn random(seed: u64) -> String {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut draw = |below: usize| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 33) as usize % below
    };
    let atoms = ["m0", "m1", "at(AA)", "at(BB)", "c0", "c1", "of(AA)", "of(BB)", "both", "late(5)", "true", "false"];
    fn term(draw: &mut dyn FnMut(usize) -> usize, atoms: &[&str], depth: usize) -> String {
        match draw(if depth == 0 { 1 } else { 5 }) {
            0 => atoms[draw(atoms.len())].to_string(),
            1 => format!("not({})", term(draw, atoms, depth - 1)),
            2 => format!("({} and {})", term(draw, atoms, depth - 1), term(draw, atoms, depth - 1)),
            3 => format!("({} or {})", term(draw, atoms, depth - 1), term(draw, atoms, depth - 1)),
            _ => format!("({} = {})", term(draw, atoms, depth - 1), term(draw, atoms, depth - 1)),
        }
    }
    let mut text = "enum domain Place = {AA | BB}\nmonitored m0: Boolean\nmonitored m1: Boolean\n\
        monitored at: Place -> Boolean\ncontrolled c0: Boolean\ncontrolled c1: Boolean\ncontrolled of: Place -> Boolean\n\
        controlled late: Integer -> Boolean\nderived both: Boolean\ndefinitions:\n"
        .to_string();
    let both = term(&mut draw, &["m0", "c0", "m1", "c1"], 1);
    let _ = writeln!(text, "function both = {both}");
    for (index, vars) in ["c0", "c1"].iter().enumerate() {
        let _ = writeln!(text, "invariant inv_{index} over {vars}: {}", term(&mut draw, &atoms, 2));
    }
    let of_state = ["c0", "c1", "of(AA)", "of(BB)"];
    let _ = writeln!(text, "invariant inv_s over c0: {}", term(&mut draw, &of_state, 2));
    if draw(3) == 0 {
        let _ = writeln!(text, "INVAR m1 or {}", term(&mut draw, &["m0", "m1", "true"], 1));
    }
    let rule = |draw: &mut dyn FnMut(usize) -> usize| {
        let place = ["c0", "c1", "of(AA)", "of(BB)", "late(5)"][draw(5)];
        let (guard, value) = (term(draw, &atoms, 1), term(draw, &atoms, 1));
        format!("if {guard} then {place} := {value} endif")
    };
    let (one, two, three) = (rule(&mut draw), rule(&mut draw), rule(&mut draw));
    let _ = match draw(3) {
        0 => writeln!(text, "main rule r_Main = par {one} {two} endpar"),
        1 => writeln!(
            text,
            "main rule r_Main = choose $p in Place with at($p) or of($p) do par of($p) := m0 {one} endpar ifnone {two}"
        ),
        _ => writeln!(text, "main rule r_Main = seq {one} {two} {three} endseq"),
    };
    let late = term(&mut draw, &["m0", "c0", "at(AA)"], 1);
    let (c0, c1) = (term(&mut draw, &["m0", "at(AA)", "true"], 1), term(&mut draw, &["c0", "m1", "m0"], 1));
    let of = ["at($p)", "m0", "false", "($p = AA) = m1"][draw(4)];
    let _ = writeln!(
        text,
        "default init s0:\nfunction c0 = {c0}\nfunction c1 = {c1}\nfunction of($p in Place) = {of}\n\
         function late($x in Integer) = {late}"
    );
    text
}

#[test]
fn every_engine_goes_where_the_machine_goes() {
    for seed in 1..=12 {
        agrees(&random(seed));
    }
}

#[test]
fn inputs_may_be_undef() {
    agrees_undefined(&format!("{FLAGS}definitions:\ninvariant inv_a over foo: isDef(foo)\n{FIRST_KEEPS}"));
    agrees_undefined(&format!("{FLAGS}definitions:\ninvariant inv_a over foo: isDef(mon)\n{FIRST_KEEPS}"));
    agrees_undefined(&format!(
        "{FLAGS}definitions:\ninvariant inv_a over foo: isDef(foo)\nINVAR isDef(mon)\n{FIRST_KEEPS}"
    ));
    for seed in 1..=12 {
        agrees_undefined(&random(seed));
    }
}

#[track_caller]
fn agrees_undefined(text: &str) {
    is_judged(text, true);
}
