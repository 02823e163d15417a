//! The initial states that an explorer makes one from the other are those that a machine makes, each from nothing.
//!
//! A naive enumeration starts a machine anew for each sequence of answers. States, their order, and what is told of each are compared,
//! and where a start is at fault, the fault.

use std::collections::BTreeMap;
use std::sync::Arc;

use explore::{Explorer, Interner, Settings, Trouble, Widening};
use machine::{Choice, Environment, Fault, FaultKind, Location, LocationRef, Machine, TimeUnit, Value};
use program::{DomainId, FunctionId, FunctionKind, Program};
use syntax::SourceFile;
use testkit::{NoFiles, sample};

use crate::exploration::{Key, bounds, inputs, key, limits, same};

/// Answers in their order, and what was chosen.
#[derive(Default)]
struct Answers {
    picks: Vec<(usize, usize)>,
    at: usize,
    inputs: BTreeMap<FunctionId, Vec<Value>>,
    chosen: Vec<Vec<Value>>,
}

impl Answers {
    fn ask(&mut self, of: usize) -> usize {
        if self.at == self.picks.len() {
            self.picks.push((0, of));
        }
        self.at += 1;
        self.picks[self.at - 1].0
    }

    fn next(&mut self) -> bool {
        (self.at, self.chosen) = (0, Vec::new());
        while let Some((taken, of)) = self.picks.pop() {
            if taken + 1 < of {
                self.picks.push((taken + 1, of));
                return true;
            }
        }
        false
    }
}

impl Environment for Answers {
    fn monitored(&mut self, _: &Program, location: LocationRef<'_>, _: DomainId) -> Result<Value, String> {
        let values = self.inputs[&location.function].clone();
        Ok(values[self.ask(values.len())].clone())
    }

    fn choose(&mut self, _: &Program, choice: &Choice<'_>) -> Result<usize, String> {
        let taken = self.ask(choice.candidates());
        self.chosen.push(choice.candidate(taken).to_vec());
        Ok(taken)
    }

    fn time(&mut self, _: TimeUnit) -> Result<i64, String> {
        unreachable!("no model reads the clock")
    }
}

/// An initial state: its values, its inputs, its choices.
type Begun = (Key, Vec<(Location, Value)>, Vec<Vec<Value>>);

/// LIMIT: models with more initial states are not compared.
const MOST: usize = 3_000;

/// The initial states by starting a machine for each; those that there are until they are too many.
fn naive(program: &Arc<Program>) -> Result<Vec<Begun>, Fault> {
    let mut machine = Machine::new(Arc::clone(program), limits());
    let inputs = inputs(program, &mut machine, &bounds(program));
    let mut answers = Answers { inputs, ..Answers::default() };
    let mut all = Vec::new();
    loop {
        machine.start(&mut answers)?;
        let asked = machine.inputs();
        machine.forget_inputs();
        all.push((key(program, machine.locations(), None), asked, std::mem::take(&mut answers.chosen)));
        if !answers.next() || all.len() > MOST {
            return Ok(all);
        }
    }
}

/// An explorer, with as much room as it needs.
fn explorer(program: &Arc<Program>) -> Result<Explorer, Trouble> {
    let mut widening = Widening::default();
    loop {
        let settings = Settings { limits: limits(), bounds: Arc::new(bounds(program)), ..Settings::default() };
        match Explorer::new(program, settings, &widening, &Arc::new(Interner::default())) {
            Err(Trouble::TooNarrow(more)) => widening.merge(&more),
            outcome => return outcome,
        }
    }
}

/// Compares all initial states; how many there are, none where one is at fault or there are too many.
fn compare(text: &str) -> Option<usize> {
    let checked = model::check(SourceFile::new("Model.asm", text.to_string()), &mut NoFiles);
    assert!(checked.diagnostics.is_empty(), "{text}\n{:?}", checked.diagnostics);
    let program = Arc::new(program::lower(&checked.model).expect("it can be lowered"));
    let expected = naive(&program);
    if expected.as_ref().is_ok_and(|expected| expected.len() > MOST) {
        return None;
    }
    let (mut explorer, expected) = match (explorer(&program), expected) {
        (Ok(explorer), Ok(expected)) => (explorer, expected),
        (Err(Trouble::Fault(found)), Err(fault)) => {
            assert_eq!((&found.kind, found.span, &found.calls), (&fault.kind, fault.span, &fault.calls), "{text}");
            return None;
        }
        // Where an explorer stops for a limit, it says so in its own way.
        (Err(Trouble::Unbounded(_)), Err(Fault { kind: FaultKind::Limit { .. }, .. })) => return None,
        (found, expected) => panic!("{text}\n{:?}\n{:?}", found.map(|found| found.initial().len()), expected.err()),
    };
    let starts: Vec<(Box<[u64]>, _)> = explorer.initial().iter().map(|(state, start)| (state.into(), start)).collect();
    assert_eq!(starts.len(), expected.len(), "initial states\n{text}");
    let is_input =
        |(location, _): &(Location, Value)| program.function(location.function).kind == FunctionKind::Monitored;
    for ((state, start), (values, asked, chosen)) in starts.iter().zip(&expected) {
        same(&program, &key(&program, explorer.values(state), None).0, &values.0);
        let told = explorer.told_of_start(*start);
        let choices: Vec<_> = told.choices.iter().map(|choice| choice.values.clone()).collect();
        assert_eq!((&told.inputs, &choices), (asked, chosen), "what is told of a start\n{text}");
        // Of the inputs, those that a step reads stay.
        let kept: Vec<_> = explorer.values_and_inputs(state).into_iter().filter(is_input).collect();
        let read = asked.iter().filter(|(location, _)| program.function(location.function).name == "m");
        let mut read: Vec<_> = read.filter(|(_, value)| !value.is_undef()).cloned().collect();
        read.sort();
        assert_eq!(kept, read, "inputs that the first step keeps\n{text}");
    }
    Some(starts.len())
}

fn model(initials: &str) -> String {
    format!(
        "asm Model import StandardLibrary signature: domain Small subsetof Integer enum domain Colour = {{RED | GREEN}}\n\
         dynamic abstract domain Thing\n\
         controlled a: Integer controlled b: Integer controlled c: Integer controlled d: Integer\n\
         controlled at: Small -> Integer controlled of: Colour -> Integer controlled by: Prod(Small, Colour) -> Integer\n\
         controlled far: Integer -> Integer controlled many: Powerset(Small) controlled thing: Thing -> Integer\n\
         monitored m: Boolean monitored n: Small monitored held: Small -> Boolean\n\
         derived sum: Integer derived twice: Integer -> Integer static next: Integer -> Integer\n\
         definitions: domain Small = {{0 : 2}}\n\
         function sum = if isDef(a) and isDef(b) then a + b else -1 endif\n\
         function twice($i in Integer) = at($i mod 3) + at($i mod 3)\n\
         function next($i in Integer) = ($i + 1) mod 3\n\
         main rule r_Main = par if m then c := 1 endif a := a b := b d := d at(0) := at(0) of(RED) := of(RED)\n\
         by(0, RED) := by(0, RED) far(7) := far(7) many := many endpar\n\
         default init s0: {initials}"
    )
}

#[test]
fn starts_that_follow_each_other_are_those_from_nothing() {
    let cases = [
        // Several choices, one after the other.
        (
            "function a = chooseone({0 : 2}) function b = chooseone({5, 7}) function at($i in Small) = chooseone({0 : 1})",
            48,
        ),
        // Values that depend on a choice before, after, and on none.
        ("function b = a + 1 function a = chooseone({0 : 2}) function c = b * 10 function d = 4", 3),
        ("function a = chooseone({0 : 2}) function b = chooseone({0 : a}) function c = chooseone({0 : b})", 10),
        // Derived functions, whose values are remembered while the state stays.
        ("function a = chooseone({0 : 2}) function b = chooseone({0 : 2}) function c = sum function d = sum", 9),
        ("function at($i in Small) = chooseone({$i : 2}) function a = twice(1) function b = twice(a)", 6),
        (
            "function d = twice(2) function at($i in Small) = if $i = 0 then chooseone({1, 2}) else at($i - 1) + 1 endif",
            2,
        ),
        // A choice that yields nothing, and undef.
        ("function a = chooseone({$i in Small | $i > 4 : $i}) function b = chooseone({0 : 1}) function c = sum", 2),
        ("function a = chooseone({0 : 2}) function b = chooseone({$i in Small | $i < a : $i}) function c = sum", 4),
        (
            "function a = if b = 1 then undef else chooseone({3, 4}) endif function b = chooseone({0 : 2}) function c = sum",
            5,
        ),
        ("function a = chooseone({undef, 1}) function b = chooseone({undef, 2}) function c = sum", 4),
        // A choice of one, and one that is not the last question of its value.
        ("function a = chooseone({6}) function b = chooseone({0 : 1})", 2),
        ("function a = chooseone({0 : b}) function b = chooseone({0 : 1}) function c = chooseone({a, b})", 4),
        ("function a = chooseone({0 : 1}) + chooseone({0 : 1}) * 10 function b = a", 4),
        ("function a = chooseone({chooseone({1, 2}), chooseone({3, 4})})", 8),
        ("function many = chooseone(Powerset(Small)) function a = size(many) function b = chooseone(many)", 13),
        // More arguments, not all of which choose.
        ("function by($i in Small, $c in Colour) = if $c = RED then chooseone({0 : $i}) else by($i, RED) endif", 6),
        ("function of($c in Colour) = at(1) + chooseone({0 : 1}) function at($i in Small) = chooseone({0 : 1})", 32),
        // Inputs, alone and among choices; some stay for the first step, some do not.
        ("function a = if m then 1 else 0 endif function b = chooseone({0 : 1})", 4),
        (
            "function a = chooseone({0 : 1}) function b = if m then chooseone({0 : 2}) else a endif function c = n + b",
            24,
        ),
        (
            "function at($i in Small) = if held($i) then chooseone({1, 2}) else 0 endif function c = if m then n else 0 endif",
            108,
        ),
        (
            "function a = chooseone({0 : 1}) function b = if a = 1 then n else 0 endif function c = if n > 1 then 1 else 2 endif",
            6,
        ),
        // Locations that cannot be listed: their initial values come up late.
        ("function far($i in Integer) = chooseone({0 : 1}) function a = far(1) function b = far(2)", 4),
        ("function far($i in Integer) = a + $i function a = chooseone({0 : 1}) function b = far(1)", 2),
        (
            "function far($i in Integer) = chooseone({0 : 1}) function a = chooseone({0 : 1}) function b = far(1000 + a)",
            4,
        ),
        ("function far($i in Integer) = $i + 1 function a = chooseone({0 : 2}) function b = far(1000 + a)", 3),
        ("function thing($t in Thing) = a function a = chooseone({0 : 1})", 2),
    ];
    for (initials, count) in cases {
        assert_eq!(compare(&model(initials)), Some(count), "{initials}");
    }
    // Of faults the first is told, with what was called on the way to it.
    for initials in [
        "function a = chooseone({0 : 2}) function b = 6 mod (2 - a) function c = 1 mod 0",
        "function a = b + 1 function b = chooseone({0 : 1}) + next(a)",
        "function a = chooseone({0 : 2}) function b = chooseone({0 : 1}) function c = far(a * b)\n\
         function far($i in Integer) = 1 mod (2 - $i)",
    ] {
        assert_eq!(compare(&model(initials)), None, "{initials}");
    }
}

/// A number for each use.
fn draw(seed: &mut u64, of: u64) -> u64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 33) % of
}

fn term(seed: &mut u64, depth: u32) -> String {
    let part = |seed: &mut u64| term(seed, depth + 1);
    match draw(seed, if depth < 2 { 18 } else { 8 }) {
        0 => "1".to_string(),
        1 => "a".to_string(),
        2 => "b".to_string(),
        3 => "sum".to_string(),
        4 => "n".to_string(),
        5 => "at(1)".to_string(),
        6 => "of(GREEN)".to_string(),
        7 => "undef".to_string(),
        8..11 => format!("chooseone({{0, {}}})", part(seed)),
        11 => format!("chooseone({{$k in Small | $k < {} : $k}})", part(seed)),
        12 => format!("if m then {} else {} endif", part(seed), part(seed)),
        13 => format!("if isDef({}) then {} else 3 endif", part(seed), part(seed)),
        14 => format!("if {} = 1 then {} else {} endif", part(seed), part(seed), part(seed)),
        15 => format!("next({})", part(seed)),
        16 => format!("far({})", part(seed)),
        _ => format!("twice({})", part(seed)),
    }
}

#[test]
fn random_starts_that_follow_each_other_are_those_from_nothing() {
    let (mut compared, mut at_fault, mut states) = (0, 0, 0);
    for case in sample::seeds(600, 20_000) {
        let mut seed = case.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let mut initials = String::new();
        for head in [
            "a",
            "at($i in Small)",
            "b",
            "of($c in Colour)",
            "far($j in Integer)",
            "c",
            "by($i in Small, $c in Colour)",
        ] {
            if draw(&mut seed, 6) > 0 {
                initials.push_str(&format!("function {head} = {}\n", term(&mut seed, 0)));
            }
        }
        match std::panic::catch_unwind(|| compare(&model(&initials))) {
            Ok(Some(count)) => (compared, states) = (compared + 1, states + count),
            Ok(None) => at_fault += 1,
            Err(panic) => {
                panic!("seed {case}: {}\n{initials}", panic.downcast_ref::<String>().map_or("", String::as_str))
            }
        }
    }
    assert!(compared > 20 && at_fault > 20 && states > 10 * compared, "{compared} {at_fault} {states}");
}
