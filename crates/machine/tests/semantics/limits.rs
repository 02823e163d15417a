//! No step is without end: what it works, how large its values get, and who asks it to stop.

use std::sync::Arc;

use expect_test::{Expect, expect};
use machine::{Cause, EngineChoice, FaultKind, Interrupt, Limits, Machine};

use crate::{Counting, check, machine_of};

const SIGNATURE: &str = "signature:
    enum domain Letter = {AA|BB}
    dynamic abstract domain N
    domain D subsetof Integer
    domain Few subsetof Integer
    controlled k: Integer
    controlled b: Boolean
    controlled s: Any
    controlled q: Seq(Integer)
    controlled t: Powerset(Integer)
    controlled text: String
    controlled u: Any
    derived deep: Prod(Integer, Integer) -> Integer
definitions:
    domain D = {1:500}
    domain Few = {1:40}
    function deep($x in Integer, $y in Integer) =
        if $x < 1 then k + $y else deep($x - 1, 2 * $y) + deep($x - 1, 2 * $y + 1) endif
";
const INIT: &str =
    "default init s: function k = 0 function q = [] function t = {} function text = \"\" function b = false";

fn model(rule: &str) -> String {
    format!("{SIGNATURE} main rule r_Main = {rule} {INIT}")
}

/// What the first steps of a rule come to, as both engines make them.
#[track_caller]
fn steps(rule: &str, steps: usize, expect: Expect) {
    check(&model(rule), steps, expect);
    let mut compiled = machine_of(&model(rule));
    let mut interpreted = machine_of(&model(rule));
    compiled.use_engine(EngineChoice::Compiled);
    interpreted.use_engine(EngineChoice::Interpreted);
    compiled.start(&mut Counting::default()).unwrap();
    interpreted.start(&mut Counting::default()).unwrap();
    for _ in 0..steps {
        let (one, other) = (compiled.step(&mut Counting::default()), interpreted.step(&mut Counting::default()));
        // Where in the work the limit is reached the two need not agree.
        assert_eq!(one.map_err(|fault| fault.kind), other.map_err(|fault| fault.kind));
        assert_eq!(compiled.locations(), interpreted.locations());
    }
}

#[test]
fn bindings_of_variables() {
    let limit = || {
        expect![[r#"
            1: the limit of 300000 bindings and calls in one step is reached
        "#]]
    };
    steps("b := (forall $x in D, $y in D, $z in D with $x + $y + $z > 0)", 1, limit());
    steps("forall $x in D, $y in D, $z in D with $x + $y + $z < 0 do k := 1", 1, limit());
    steps("choose $x in D, $y in D, $z in D with $x + $y + $z < 0 do k := 1", 1, limit());
    steps("t := {$x in D, $y in D, $z in D | $x + $y + $z < k: $x}", 1, limit());
    // Each loop is short; together they are not.
    steps(
        "forall $x in Few, $y in Few do forall $z in Few, $w in Few with $x + $y + $z + $w < 0 do k := 1",
        1,
        limit(),
    );
    // Quantifiers end where they are decided.
    steps(
        "b := (exist $x in D, $y in D, $z in D with $x + $y + $z > 0)",
        1,
        expect![[r#"
            1: b=true
        "#]],
    );
}

#[test]
fn calls_of_functions() {
    steps(
        "k := deep(40, 0)",
        1,
        expect![[r#"
            1: the limit of 300000 bindings and calls in one step is reached
        "#]],
    );
}

#[test]
fn sharing_does_not_make_values_small() {
    let mut machine = machine_of(&model("s := [s, s]"));
    let mut environment = Counting::default();
    machine.start(&mut environment).unwrap();
    for _ in 0..13 {
        machine.step(&mut environment).unwrap();
    }
    let fault = machine.step(&mut environment).unwrap_err();
    assert!(matches!(fault.kind, FaultKind::Limit { value: 10_000, .. }), "{fault:?}");
    for rule in ["s := (s, s)", "s := {s, {s}}", "s := {[s, s] -> s}", "s := <s, s>", "s := {$x in Letter: (s, $x)}"] {
        let mut machine = machine_of(&model(rule));
        machine.start(&mut environment).unwrap();
        let ended = (0..2000).find_map(|_| machine.step(&mut environment).err());
        assert!(matches!(ended.expect(rule).kind, FaultKind::Limit { .. }), "{rule}");
    }
}

#[test]
fn depth_of_values() {
    let mut machine = machine_of(&model("s := [s]"));
    let mut environment = Counting::default();
    machine.start(&mut environment).unwrap();
    let fault = (0..2000).find_map(|_| machine.step(&mut environment).err()).expect("it ends");
    assert_eq!(fault.show(machine.program()).to_string(), "the limit of 1000 values inside each other is reached");
}

#[test]
fn loops_keep_one_version_of_what_they_write() {
    let limit = || {
        expect![[r#"
            1: the limit of 1000 iterations in one step is reached
        "#]]
    };
    steps("while true do par q := append(q, k) k := k + 1 endpar", 1, limit());
    steps("while true do par t := including(t, k) k := k + 1 endpar", 1, limit());
    steps("while true do text := text + \"a\"", 1, limit());
    steps("while true do extend N with $n do k := k + 1", 1, limit());
    steps(
        "while k < 4 do par q := append(q, k) k := k + 1 endpar",
        1,
        expect![[r#"
            1: k=4 q=[0,1,2,3]
        "#]],
    );
    // A loop in a loop, and a location that only the outer one has written before.
    steps(
        "seq q := [9] while k < 2 do seq k := k + 1 q := append(q, k) s := 0 while size(t) < 3 * k do
            par t := including(t, size(t)) q := append(q, size(t)) endpar endseq k := k + 10 endseq",
        1,
        expect![[r#"
            1: k=12 s=0 q=[9,1,0,1,2,2,3,4,5] t={0,1,2,3,4,5}
        "#]],
    );
}

/// A machine that works without end in its step, within all other limits.
fn busy(engine: EngineChoice, interrupt: &Interrupt) -> Machine {
    let program =
        Arc::clone(machine_of(&model("b := (forall $x in D, $y in D, $z in D, $w in D with $x > 0)")).program());
    let limits = Limits { interrupt: interrupt.clone(), work: u64::MAX, ..Limits::default() };
    let mut machine = Machine::new(program, limits);
    machine.use_engine(engine);
    machine.start(&mut Counting::default()).unwrap();
    machine
}

#[test]
fn a_step_can_be_stopped() {
    for engine in [EngineChoice::Interpreted, EngineChoice::Compiled] {
        for cause in [Cause::Asked, Cause::Memory] {
            let interrupt = Interrupt::new();
            let mut machine = busy(engine, &interrupt);
            let before = machine.locations();
            let asks = std::thread::spawn(move || interrupt.raise(cause));
            let fault = machine.step(&mut Counting::default()).unwrap_err();
            asks.join().unwrap();
            assert_eq!(fault.kind, FaultKind::Interrupted(cause));
            assert_eq!(machine.locations(), before);
        }
    }
}
