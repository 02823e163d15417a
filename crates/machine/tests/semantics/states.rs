//! States: initial values, inputs, domains that grow.

use expect_test::expect;
use machine::{Closed, EngineChoice, Location, Machine, Passed, Value};

use crate::{Counting, check, machine_of};

#[test]
fn initial_values_are_eager_and_may_use_each_other() {
    check(
        "signature:
            controlled x: Integer
            controlled y: Integer
            controlled z: Integer
        definitions:
            main rule r_Main = par x := x + 1 if x = 3 then z := y endif endpar
        default init s: function y = x + 100 function x = 2",
        2,
        expect![[r#"
            1: x=3
            2: x=4 z=102
        "#]],
    );
}

#[test]
fn initial_values_read_late_read_the_initial_state() {
    check(
        "signature:
            dynamic abstract domain Job
            controlled x: Integer
            controlled seen: Integer
            controlled far: Integer -> Integer
            controlled first: Job -> Integer
            controlled late: Integer
        definitions:
            main rule r_Main = par
                seq x := x + 1 seen := far(x) endseq
                extend Job with $j do late := first($j)
            endpar
        default init s: function x = 5 function far($i in Integer) = x * 100 + $i function first($j in Job) = x",
        2,
        expect![[r#"
            1: x=6 seen=506 late=5
            2: x=7 seen=507
        "#]],
    );
}

#[test]
fn an_input_is_asked_for_once_a_step() {
    check(
        "signature:
            monitored m: Integer
            controlled a: Integer
            controlled b: Integer
            controlled c: Integer
        definitions:
            main rule r_Main = par seq a := m a := a + m endseq seq b := m skip endseq c := m endpar",
        2,
        expect![[r#"
            1: a=2 b=1 c=1
            2: a=4 b=2 c=2
        "#]],
    );
}

#[test]
fn derived_and_static_functions() {
    check(
        "signature:
            domain Small subsetof Integer
            static twice: Integer -> Integer
            derived total: Integer
            controlled f: Small -> Integer
            controlled x: Integer
        definitions:
            domain Small = {1:3}
            function twice($n in Integer) = $n * 2
            function total = sum({$i in Small: f($i)})
            main rule r_Main = par x := twice(total) forall $i in Small do f($i) := f($i) + $i endpar
        default init s: function f($i in Small) = $i * 10",
        2,
        expect![[r#"
            1: f(1)=11 f(2)=22 f(3)=33 x=120
            2: f(1)=12 f(2)=24 f(3)=36 x=132
        "#]],
    );
}

#[test]
fn locations_outside_the_declared_arguments_are_locations() {
    check(
        "signature:
            domain Small subsetof Integer
            controlled f: Small -> Integer
            controlled g: Prod(Integer, String) -> Integer
        definitions:
            domain Small = {1:3}
            main rule r_Main = par f(100) := 1 g(7, \"a\") := 2 f(undef) := 3 endpar",
        1,
        expect![[r#"
            1: f(undef)=3 f(100)=1 g(7,"a")=2
        "#]],
    );
}

#[test]
fn kleene_logic() {
    check(
        "signature:
            controlled u: Boolean
            controlled a: Boolean
            controlled b: Boolean
            controlled c: Boolean
            controlled d: Boolean
            controlled e: Boolean
        definitions:
            main rule r_Main = par
                a := u and false
                b := u or true
                c := u and true
                d := implies(u, true)
                e := (u = undef)
            endpar",
        1,
        expect![[r#"
            1: a=false b=true d=true e=true
        "#]],
    );
}

#[test]
fn pre_reads_the_state_before_the_step() {
    check(
        "signature:
            controlled x: Integer
            controlled y: Integer
        definitions:
            main rule r_Main = seq x := x + 1 y := pre(x) endseq
        default init s: function x = 5",
        2,
        expect![[r#"
            1: x=6 y=5
            2: x=7 y=6
        "#]],
    );
}

#[test]
fn an_initial_value_is_not_held_against_the_codomain() {
    check(
        "signature:
            domain Level subsetof Integer
            controlled level: Level
            controlled seen: Integer
        definitions:
            domain Level = {0:10}
            main rule r_Main = if level = 15 then level := 3 else level := level + 8 endif
        default init s0: function level = 15",
        3,
        expect![[r#"
            1: level=3
            2: 11 is not in Level, the domain of level
        "#]],
    );
}

#[test]
fn an_initial_value_holds_for_all_arguments() {
    check(
        "signature:
            domain Card subsetof Integer
            dynamic abstract domain Node
            controlled current: Card
            controlled valid: Card -> Boolean
            controlled marks: Node -> Integer
            controlled seen: Boolean
            controlled total: Integer
        definitions:
            domain Card = {1:3}
            main rule r_Main = par
                seen := valid(current) and valid(7)
                seq valid(9) := false skip endseq
                extend Node with $n do seq marks($n) := marks($n) + 1 total := marks($n) endseq
            endpar
        default init s0: function valid($c in Card) = true function marks($n in Node) = 5",
        2,
        expect![[r#"
            1: valid(9)=false marks(node!1)=6 seen=true total=6
            2: marks(node!2)=6
        "#]],
    );
}

#[test]
fn an_input_is_asked_for_whatever_its_initial_value() {
    check(
        "signature:
            monitored m: Integer
            controlled a: Integer
            controlled b: Integer
        definitions:
            main rule r_Main = a := m
        default init s0: function m = 70 function b = 5",
        2,
        expect![[r#"
            1: a=1
            2: a=2
        "#]],
    );
}

#[test]
fn what_is_inside_of_tuples_is_not_held_against_the_codomain() {
    check(
        "signature:
            domain Small subsetof Integer
            controlled pair: Prod(Small, Small)
            controlled some: Powerset(Small)
        definitions:
            domain Small = {0:3}
            main rule r_Main = par pair := (9, 1) some := {7} endpar",
        1,
        expect![[r#"
            1: pair=(9,1) some={7}
        "#]],
    );
}

#[test]
fn of_equal_overloads_of_a_rule_the_first_is_called() {
    check(
        "signature:
            abstract domain Thing
            domain Red subsetof Thing
            domain Blue subsetof Thing
            static one: Thing
            controlled called: Integer
        definitions:
            rule r_Call($t in Red) = called := 1
            rule r_Call($t in Blue) = called := 2
            main rule r_Main = r_Call[one]",
        1,
        expect![[r#"
            1: called=1
        "#]],
    );
}

#[test]
fn an_element_defined_as_itself_is_an_element() {
    check(
        "signature:
            abstract domain Thing
            static one: Thing
            static two: Thing
            controlled which: Thing
            controlled same: Boolean
        definitions:
            function one = one
            main rule r_Main = par which := one same := one = two endpar",
        1,
        expect![[r#"
            1: which=one same=false
        "#]],
    );
}

/// Locations come and go, so that they are numbered anew in between; a domain grows; inputs are asked for.
#[test]
fn going_back_is_as_if_nothing_had_been_done() {
    let mut machine = machine_of(
        "signature:
            dynamic abstract domain Job
            monitored m: Integer
            controlled x: Integer
            controlled set: Integer
            controlled far: Integer -> Integer
            controlled owner: Job -> Integer
        definitions:
            main rule r_Main = par
                x := x + 1
                far(1000000 + x) := m
                far(1000000 + x - 3) := undef
                if x mod 500 = 0 then extend Job with $j do owner($j) := x endif
            endpar
        default init s: function x = 0",
    );
    let set = Location { function: machine.find_function("set", 0).expect("it is declared"), arguments: Vec::new() };
    let run = |machine: &mut Machine, steps: u64, environment: &mut Counting| {
        let mut seen = Vec::new();
        for _ in 0..steps {
            machine.set(&set, Value::Integer(machine.steps() as i64)).expect("an Integer");
            machine.step(environment).expect("a step");
            let changes = machine.changes();
            machine.forget_inputs();
            seen.push((machine.steps(), changes, machine.locations()));
        }
        seen
    };
    let mut environment = Counting::default();
    machine.start(&mut environment).expect("it starts");
    run(&mut machine, 10, &mut environment);
    let first = machine.mark();
    run(&mut machine, 600, &mut environment);
    let (second, asked) = (machine.mark(), environment.asked);
    let before = (machine.steps(), machine.locations());
    let seen = run(&mut machine, 6000, &mut environment);
    machine.go_back(&second);
    assert_eq!((machine.steps(), machine.locations()), before);
    assert!(run(&mut machine, 6000, &mut Counting { asked, ..Counting::default() }) == seen, "the same run again");
    machine.go_back(&first);
    assert_eq!(machine.steps(), 10);
    run(&mut machine, 600, &mut Counting { asked: asked - 600, ..Counting::default() });
    assert_eq!((machine.steps(), machine.locations()), before);
    let third = machine.mark();
    machine.forget_before(&third);
    machine.step(&mut environment).expect("a step");
    machine.go_back(&third);
    assert_eq!((machine.steps(), machine.locations()), before);
}

/// Compiled code takes functions that no rule updates for constants: not so once somebody has set one, or has gone back to a
/// state in which it was something else.
#[test]
fn what_no_rule_updates_may_be_set_from_outside() {
    let text = "signature:
            enum domain Colour = {RED | GREEN | BLUE}
            controlled rate: Colour -> Integer
            controlled base: Integer
            controlled parts: Colour -> Seq(Integer)
            controlled todo: Rule
            controlled c: Colour
            controlled sum: Integer
        definitions:
            rule r_Add = sum := sum + rate(c) * base + length(parts(c))
            rule r_Take = sum := sum - rate(c)
            main rule r_Main = par
                todo[]
                c := if c = RED then GREEN else if c = GREEN then BLUE else RED endif endif
            endpar
        default init s:
            function rate($c in Colour) = if $c = RED then 1 else if $c = GREEN then 2 else 3 endif endif
            function base = 5
            function parts($c in Colour) = if $c = RED then [1] else [1, 2] endif
            function todo = <<r_Add>>
            function c = RED
            function sum = 0";
    let run = |engine: EngineChoice| {
        let mut machine = machine_of(text);
        machine.use_engine(engine);
        let mut environment = Counting::default();
        machine.start(&mut environment).expect("it starts");
        let location = |machine: &Machine, name: &str, arguments: &[Value]| {
            let function = machine.find_function(name, arguments.len()).expect("it is declared");
            Location { function, arguments: arguments.to_vec() }
        };
        let colour = machine.value(&location(&machine, "c", &[]));
        let mut seen = Vec::new();
        let mut go = |machine: &mut Machine| {
            let mut passed = Passed::default();
            machine.pass(7, &mut environment, &mut passed).expect("steps");
            machine.step(&mut environment).expect("a step");
            seen.push(machine.locations());
        };
        go(&mut machine);
        let (mark, snapshot) = (machine.mark(), machine.snapshot());
        machine
            .set(&location(&machine, "rate", std::slice::from_ref(&colour)), Value::Integer(100))
            .expect("an Integer");
        go(&mut machine);
        machine.set(&location(&machine, "base", &[]), Value::Integer(7)).expect("an Integer");
        go(&mut machine);
        machine.go_back(&mark);
        go(&mut machine);
        machine.set(&location(&machine, "parts", &[colour]), Value::seq(Vec::new())).expect("a Seq");
        go(&mut machine);
        machine.restore(&snapshot);
        go(&mut machine);
        seen
    };
    let interpreted = run(EngineChoice::Interpreted);
    assert_eq!(interpreted.len(), 6);
    assert!(interpreted == run(EngineChoice::Compiled), "both engines make the same steps");
}

/// Compiled code relies on what the program writes: not on elements that somebody set to undef, nor on `self` in a rule that somebody
/// runs who is no agent.
#[test]
fn what_is_certain_may_be_set_otherwise() {
    let text = "signature:
            domain Worker subsetof Agent
            static worker: Worker
            enum domain Colour = {RED | GREEN}
            controlled queue: Colour -> Seq(Integer)
            controlled last: Agent
            controlled first: Integer
            controlled n: Integer
            controlled all: Boolean
        definitions:
            rule r_Work = par
                last := self
                n := n + length(queue(GREEN))
                queue(GREEN) := if length(queue(GREEN)) > 3 then [n] else append(queue(GREEN), n) endif
            endpar
            main rule r_Main = par
                forall $w in Worker with true do program($w)
                all := (forall $x in asSet(queue(RED)) with isDef($x)) and isDef(last)
                first := length([$x in queue(RED) | isDef($x) : $x])
                queue(RED) := queue(GREEN)
            endpar
        default init s:
            function queue($c in Colour) = [1, 2]
            function n = 0
            function first = 0
            function last = worker
            function all = true
            agent Worker: r_Work[]";
    let run = |engine: EngineChoice| {
        let mut machine = machine_of(text);
        machine.use_engine(engine);
        machine.start(&mut Closed).expect("it starts");
        let procedures = &machine.program().procedures;
        let work = procedures.iter().position(|procedure| procedure.name == "r_Work").expect("it is declared");
        let queue = machine.find_function("queue", 1).expect("it is declared");
        let first = machine.locations().iter().find(|(location, _)| location.function == queue).cloned();
        let (red, _) = first.expect("it has a value");
        let mut seen = Vec::new();
        for _ in 0..3 {
            machine.step(&mut Closed).expect("a step");
            seen.push(machine.locations());
        }
        machine.set(&red, Value::seq(vec![Value::Integer(1), Value::Undef])).expect("undef is in each domain");
        for _ in 0..3 {
            machine.step(&mut Closed).expect("a step");
            seen.push(machine.locations());
        }
        machine.prepare_procedure(program::ProcedureId(work as u32), &mut Closed).expect("a step");
        machine.commit();
        for _ in 0..3 {
            machine.step(&mut Closed).expect("a step");
            seen.push(machine.locations());
        }
        seen
    };
    let interpreted = run(EngineChoice::Interpreted);
    assert_eq!(interpreted.len(), 9);
    assert!(interpreted == run(EngineChoice::Compiled), "both engines make the same steps");
}

/// A value of a definition that is looked at may be replaced where it is kept: by that of the state before the step, for one.
#[test]
fn a_kept_value_stays_what_it_was() {
    let text = "signature:
            enum domain Colour = {RED | GREEN}
            controlled line: Colour -> Seq(Integer)
            controlled n: Integer
            controlled same: Boolean
            controlled longer: Integer
            derived rest: Colour -> Seq(Integer)
        definitions:
            function rest($c in Colour) = [$x in line($c) | $x > 0 and $x < 90 and $x != 7 : $x]
            main rule r_Main = seq
                line(RED) := append(line(RED), n + 1)
                n := n + 1
                par
                    same := rest(RED) = pre(rest(RED))
                    longer := length(union(rest(RED), pre(rest(RED))))
                endpar
            endseq
        default init s:
            function line($c in Colour) = [1, 0, 7]
            function n = 0
            function same = true
            function longer = 0";
    let run = |engine: EngineChoice| {
        let mut machine = machine_of(text);
        machine.use_engine(engine);
        machine.start(&mut Closed).expect("it starts");
        let mut seen = Vec::new();
        for _ in 0..6 {
            machine.step(&mut Closed).expect("a step");
            seen.push(machine.locations());
        }
        seen
    };
    assert!(run(EngineChoice::Interpreted) == run(EngineChoice::Compiled), "both engines make the same steps");
}

#[test]
fn a_location_that_is_only_written_needs_no_initial_value() {
    let model = |main: &str| {
        format!(
            "signature:
                controlled g: Boolean -> Integer
                controlled h: Integer -> Integer
                controlled b: Boolean
                controlled x: Integer
            definitions:
                main rule r_Main = {main}
            default init s:
                function g($y in Boolean) = if $y then 1 else 2 endif
                function h($i in Integer) = idiv(10, $i)"
        )
    };
    check(
        &model("par g(not b) := 3 h(0) := 4 x := x endpar"),
        1,
        expect![[r#"
            1: g(undef)=3 h(0)=4
        "#]],
    );
    // What is written is read after it, within the step and in the next one.
    check(
        &model("if x = undef then seq h(0) := 4 x := h(0) endseq else x := h(0) + x endif"),
        2,
        expect![[r#"
            1: h(0)=4 x=4
            2: x=8
        "#]],
    );
    // Whoever reads it before it is written does need it.
    check(
        &model("par h(0) := 4 x := h(0) endpar"),
        1,
        expect![[r#"
            1: division by zero
        "#]],
    );
    check(
        &model("seq h(0) := 4 h(0) := h(0) + 1 h(2) := h(2) + 1 x := h(2) endseq"),
        1,
        expect![[r#"
            1: h(0)=5 h(2)=6 x=6
        "#]],
    );
}

/// Code that takes a function for a constant, and another for one that is never undef, is asked no more once that is not so.
#[test]
fn conditions_follow_what_is_set_from_outside() {
    let mut machine = machine_of(
        "signature:
            controlled base: Integer
            controlled sum: Integer
        definitions:
            invariant over base: base = 5
            invariant over sum: sum >= 0
            invariant over sum: isDef(sum)
            main rule r_Main = sum := (sum + base) mod 7
        default init s:
            function base = 5
            function sum = 0",
    );
    machine.use_engine(EngineChoice::Compiled);
    let formulas: Vec<_> = machine.program().properties.iter().map(|property| property.formula.clone()).collect();
    machine.watch_conditions(formulas.iter().cloned().collect());
    machine.start(&mut Closed).expect("it starts");
    let base = Location { function: machine.find_function("base", 0).expect("declared"), arguments: Vec::new() };
    let sum = Location { function: machine.find_function("sum", 0).expect("declared"), arguments: Vec::new() };
    let judge = |machine: &mut Machine, expected: [bool; 3]| {
        for (number, formula) in formulas.iter().enumerate() {
            let value = machine.evaluate(formula, &mut Closed);
            assert_eq!(matches!(value, Ok(Value::Boolean(true))), expected[number], "{number}: {value:?}");
            assert_eq!(machine.surely_holds(number), expected[number], "{number}");
        }
    };
    judge(&mut machine, [true, true, true]);
    machine.step(&mut Closed).expect("a step");
    judge(&mut machine, [true, true, true]);
    let before = machine.snapshot();
    machine.set(&base, Value::Integer(6)).expect("an Integer");
    judge(&mut machine, [false, true, true]);
    machine.set(&sum, Value::Integer(-1)).expect("an Integer");
    judge(&mut machine, [false, false, true]);
    machine.restore(&before);
    judge(&mut machine, [true, true, true]);
    machine.set(&sum, Value::Undef).expect("undef is in each domain");
    judge(&mut machine, [true, false, false]);
}
