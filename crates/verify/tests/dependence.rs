//! What properties depend on: by example, and that what lies outside of a cone makes no difference.

use std::sync::Arc;

use program::{FunctionId, Program, PropertyKind, Rule};
use syntax::SourceFile;
use testkit::Random;
use testkit::sample::seeds;
use verify::dependence::{Dependence, dependence};
use verify::{Options, Outcome, Subject, verify};

use crate::models::lowered;

fn program(text: &str) -> Arc<Program> {
    lowered(SourceFile::new("example.asm", text))
}

fn names(program: &Program, functions: impl IntoIterator<Item = FunctionId>) -> String {
    functions.into_iter().map(|id| program.function(id).name.as_str()).collect::<Vec<_>>().join(" ")
}

/// The cone of the only property, and what lies outside of it.
fn check(definitions: &str, cone: &str, outside: &str) {
    let program = program(&format!(
        "asm example\nimport StandardLibrary\nsignature:\n\
         dynamic abstract domain Part\n\
         controlled a: Integer\ncontrolled b: Integer\ncontrolled c: Integer\ncontrolled d: Integer\n\
         monitored go: Boolean\nmonitored stop: Boolean\ncontrolled of: Part -> Integer\nderived twice: Integer\n\
         definitions:\n\
         function twice = 2 * b\n{definitions}\n\
         default init s0: function a = 0 function b = 0 function c = 0 function d = 0\n"
    ));
    let asked = program.properties.iter().position(|property| property.kind == PropertyKind::Invariant);
    let found = dependence(&program, &[asked.expect("there is an invariant")]);
    assert_eq!(names(&program, found.cones[0].functions.clone()), cone, "{definitions}");
    let left: Vec<FunctionId> = found.outside.iter().map(|written| written.function).collect();
    assert_eq!(names(&program, left), outside, "{definitions}");
}

/// Another value might be a rule that writes anything.
#[test]
fn what_decides_which_rule_runs_decides_all() {
    let program = program(
        "asm example\nimport StandardLibrary\nsignature:\ncontrolled plan: Rule\ncontrolled a: Boolean\n\
         controlled b: Boolean\nmonitored go: Boolean\nmonitored stop: Boolean\ndefinitions:\n\
         rule r_none = skip\ninvariant inv_a over a: not a\n\
         main rule r_Main = par plan if go then plan := <<r_none>> endif b := stop endpar\n\
         default init s0: function a = false function b = false function plan = <<r_none>>\n",
    );
    let found = dependence(&program, &[0]);
    assert_eq!(names(&program, found.cones[0].functions.clone()), "plan a go");
}

#[test]
fn cones_by_example() {
    // Values, guards, what a definition reads.
    check(
        "invariant inv_a over a: a >= 0\n\
         main rule r_Main = par if go then a := twice endif c := c + 1 if stop then d := a endif endpar",
        "a b go",
        "c d stop of",
    );
    // A choice, and the arguments of a call; what a turbo rule gives back.
    check(
        "invariant inv_a over a: a >= 0\n\
         rule r_set($x in Integer) = a := $x\n\
         turbo rule r_sum in Integer = result := d\n\
         main rule r_Main = par choose $x in {0 : 2} with $x > c do r_set[$x] b <- r_sum() endpar",
        "a c",
        "b d go stop of",
    );
    check(
        "invariant inv_b over b: b >= 0\n\
         turbo rule r_sum in Integer = result := d\n\
         main rule r_Main = par a := c b <- r_sum() endpar",
        "b d",
        "a c go stop of",
    );
    // Whether a loop goes on rests on all that it writes.
    check(
        "invariant inv_a over a: a >= 0\n\
         main rule r_Main = par c := 1 iterate par if b < 2 then b := b + 1 endif a := 2 endpar enditerate endpar",
        "a b",
        "c d go stop of",
    );
    // A domain that grows, and an assumption.
    check(
        "INVAR c < 2\ninvariant inv_parts over of: (forall $p in Part with of($p) >= 0)\n\
         main rule r_Main = par if d = 0 then extend Part with $p do of($p) := 1 endif a := 1 c := b endpar",
        "b c d of",
        "a go stop",
    );
}

/// A rule, as text.
fn rule(random: &mut Random, depth: u64) -> String {
    const FUNCTIONS: [&str; 6] = ["a", "b", "c", "d", "e", "g"];
    let term = |random: &mut Random| match random.below(4) {
        0 => format!("({} + 1) mod 3", random.pick(&FUNCTIONS)),
        1 => format!("{} * {} mod 2", random.pick(&FUNCTIONS), random.pick(&FUNCTIONS)),
        2 => format!("if {} = 0 then 1 else {} endif", random.pick(&FUNCTIONS), random.pick(&FUNCTIONS)),
        _ => format!("both({})", random.pick(&FUNCTIONS)),
    };
    let guard = |random: &mut Random| match random.below(3) {
        0 => "go".to_string(),
        1 => format!("{} = {}", random.pick(&FUNCTIONS), random.below(2)),
        _ => format!("{} < {}", random.pick(&FUNCTIONS), random.pick(&FUNCTIONS)),
    };
    if depth == 0 {
        return format!("{} := {}", random.pick(&FUNCTIONS), term(random));
    }
    match random.below(8) {
        0 | 1 => format!("if {} then {} endif", guard(random), rule(random, depth - 1)),
        2 => format!("seq {} {} endseq", rule(random, depth - 1), rule(random, depth - 1)),
        3 => format!("let ($x = {}) in r_set[$x] endlet", term(random)),
        4 => format!("choose $x in {{0, 1}} with $x <= {} do r_set[$x]", random.pick(&FUNCTIONS)),
        5 => format!("{} <- r_next({})", random.pick(&FUNCTIONS), random.pick(&FUNCTIONS)),
        6 => format!("whilerec {} < 2 do par e := e + 1 {} endpar", "e", rule(random, 0)),
        _ => format!("par {} {} endpar", rule(random, depth - 1), rule(random, depth - 1)),
    }
}

fn model(seed: u64) -> String {
    let mut random = Random(seed);
    let read = random.pick(&["a", "b", "c", "d"]).to_string();
    let property = match random.below(6) {
        0 => format!("invariant inv_p over {read}: {read} < 2"),
        1 => format!("CTLSPEC ctlSpec_p: ag(ef({read} = 1))"),
        2 => format!("CTLSPEC ctlSpec_p: ef({read} = 2)"),
        3 => format!("CTLSPEC ctlSpec_p: ag({read} = 1 implies ax({read} != 1))"),
        4 => format!("LTLSPEC ltlSpec_p: f(g({read} = 0))"),
        _ => format!("LTLSPEC ltlSpec_p: g({read} = 0 implies f({read} = 1))"),
    };
    let main = rule(&mut random, 3);
    format!(
        "asm example\nimport StandardLibrary\nimport CTLLibrary\nimport LTLLibrary\nsignature:\n\
         domain Three subsetof Integer\n\
         controlled a: Three\ncontrolled b: Three\ncontrolled c: Three\ncontrolled d: Three\ncontrolled e: Three\ncontrolled g: Three\n\
         monitored go: Boolean\nderived both: Three -> Three\ndefinitions:\n\
         domain Three = {{0 : 2}}\n\
         function both($x in Three) = ($x + g) mod 3\n\
         rule r_set($x in Three) = d := $x\n\
         turbo rule r_next($x in Three) in Three = result := ($x + 1) mod 3\n\
         {property}\n\
         main rule r_Main = {main}\n\
         default init s0: function a = 0 function b = 1 function c = 0 function d = 0 function e = 0 function g = 1\n"
    )
}

/// Whether the property holds; none if some step cannot be made, or if that is not known.
fn verdict(program: &Arc<Program>) -> Option<bool> {
    let mut options = Options { max_states: 5_000, ..Options::default() };
    options.limits.iterations = 100;
    let report = verify(program, &options, &mut |_| true).expect("there is an initial state");
    let of =
        |subject| report.verdicts.iter().find(|verdict| verdict.subject == subject).map(|verdict| &verdict.outcome);
    for subject in [Subject::Consistent, Subject::InDomain, Subject::Defined] {
        of(subject).filter(|outcome| matches!(outcome, Outcome::Holds))?;
    }
    match of(Subject::Property(0))? {
        Outcome::Holds => Some(true),
        Outcome::Violated(_) => Some(false),
        Outcome::Unknown(_) => None,
    }
}

#[test]
fn what_is_outside_makes_no_difference() {
    let (mut compared, mut differed) = (0, 0);
    for seed in seeds(800, 8_000) {
        let program = program(&model(seed));
        let Dependence { outside, within, .. } = dependence(&program, &[0]);
        let Some(before) = verdict(&program) else { continue };
        let without = |function: FunctionId| {
            let mut changed = (*program).clone();
            for rule in &mut changed.rules {
                if matches!(rule, Rule::Update { function: updated, .. } if *updated == function) {
                    *rule = Rule::Skip;
                }
            }
            verdict(&Arc::new(changed))
        };
        for written in outside.iter().filter(|written| !written.updates.is_empty()) {
            if let Some(after) = without(written.function) {
                compared += 1;
                assert_eq!(before, after, "seed {seed}: {}\n{}", program.function(written.function).name, model(seed));
            }
        }
        for written in within.iter().filter(|written| !written.updates.is_empty()) {
            differed += usize::from(without(written.function).is_some_and(|after| after != before));
        }
    }
    assert!(compared > 100 && differed > 20, "{compared} compared, {differed} made a difference");
}
