//! Questions agree with the machine: a generated condition holds in a state, by the machine's evaluation, exactly if
//! the question "this state and the condition" is found possible, by cases and by the installed solvers.

use std::sync::Arc;

use machine::{Closed, Limits, Machine, Value};
use model::check;
use solve::session::{Session, Solvers, Verdict, verdict};
use solve::{Decision, Question, question};
use syntax::ast::{AstNode, TermFile};
use syntax::{FileId, SourceFile};
use testkit::{NoFiles, NoSolver, solver};

/// Pseudo-random numbers, the same in every run.
struct Dice(u64);

impl Dice {
    fn throw(&mut self, sides: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % sides
    }

    fn one<'a>(&mut self, of: &[&'a str]) -> &'a str {
        of[self.throw(of.len())]
    }

    fn truth(&mut self, depth: usize) -> String {
        if depth == 0 {
            return self
                .one(&["p", "not p", "m = HAND", "m != AUTO", "isDef(u)", "isUndef(u)", "q(m)", "true"])
                .to_string();
        }
        let (a, b) = (self.truth(depth - 1), self.truth(depth - 1));
        match self.throw(14) {
            0 => format!("(({a}) and ({b}))"),
            1 => format!("(({a}) or ({b}))"),
            2 => format!("(({a}) implies ({b}))"),
            3 => format!("(({a}) xor ({b}))"),
            4 => format!("(({a}) iff ({b}))"),
            5 => format!("(not ({a}))"),
            6 => format!("(if {a} then {b} else {} endif)", self.truth(depth - 1)),
            7 => {
                let bound = self.number(depth - 1);
                format!("({} $k in {{0 : 2}} with $k + a < {bound})", self.one(&["forall", "exist"]))
            }
            8 => format!("(u = undef or u > {})", self.number(depth - 1)),
            9 => format!("({} in {{1, b, 3}})", self.number(depth - 1)),
            10 => format!("({} {} {{-3 : b}})", self.number(depth - 1), self.one(&["in", "notin"])),
            11 => format!("(exist unique $k in {{0 : 2}} with $k > {})", self.number(depth - 1)),
            _ => {
                let (x, y) = (self.number(depth - 1), self.number(depth - 1));
                format!("({x} {} {y})", self.one(&["<", "<=", ">", ">=", "=", "!="]))
            }
        }
    }

    fn number(&mut self, depth: usize) -> String {
        if depth == 0 {
            return self
                .one(&["a", "b", "u", "h", "0", "1", "3", "-2", "f(m)", "twice(a)", "4611686018427387904"])
                .to_string();
        }
        let (x, y) = (self.number(depth - 1), self.number(depth - 1));
        match self.throw(11) {
            0 => format!("({x} + {y})"),
            1 => format!("({x} - {y})"),
            2 => format!("({x} * {y})"),
            3 => format!("({x} mod {y})"),
            4 => format!("idiv({x}, {y})"),
            5 => format!("max({x}, {y})"),
            6 => format!("min({x}, {y})"),
            7 => format!("abs({x})"),
            8 => format!("(let ($y = {x}) in b - 1 endlet)"),
            9 => format!("(if {} then {x} else {y} endif)", self.truth(depth - 1)),
            _ => format!("(switch m case HAND: {x} otherwise {y} endswitch)"),
        }
    }
}

/// Values of `a`, `b`, `u`, `m`, `p`, `f(m)`, `q(m)`.
const STATES: [[&str; 7]; 5] = [
    ["0", "0", "undef", "AUTO", "true", "1", "false"],
    ["3", "-2", "5", "HAND", "false", "-3", "true"],
    ["-7", "2", "0", "HAND", "true", "2", "false"],
    ["9223372036854775807", "1", "undef", "AUTO", "false", "0", "true"],
    ["-9223372036854775807", "-1", "-4", "AUTO", "true", "7", "true"],
];

#[test]
fn conditions_mean_what_the_machine_does() {
    let mut counts = [0; 3];
    let started = solver::solvers(false).into_iter().map(|mut solver| solver.start().expect("it starts"));
    let mut sessions: Vec<Box<dyn Session>> = started.collect();
    for (number, [a, b, u, m, p, f, q]) in STATES.iter().enumerate() {
        let text = format!(
            "asm Small import StandardLibrary signature: enum domain Mode = {{AUTO | HAND}} domain Half subsetof Integer \
             controlled a: Integer controlled b: Integer controlled u: Integer controlled m: Mode controlled p: Boolean \
             controlled f: Mode -> Integer controlled q: Mode -> Boolean controlled h: Half static twice: Integer -> Integer \
             definitions: domain Half = {{0 : 6, 2}} function twice($x in Integer) = $x + $x main rule r_Main = skip \
             default init s0: function a = {a} function b = {b} function u = {u} function m = {m} function p = {p} \
             function f($m in Mode) = {f} function q($m in Mode) = {q} function h = 4"
        );
        let mut checked = check(SourceFile::new("Small.asm", text), &mut NoFiles);
        assert_eq!(checked.diagnostics, []);
        let defined = if *u == "undef" { "isUndef(u)".to_string() } else { format!("isDef(u) and u = {u}") };
        let given = format!(
            "a = {a} and b = {b} and {defined} and m = {m} and p = {p} and f({m}) = {f} and q({m}) = {q} and h = 4"
        );
        let mut dice = Dice(number as u64 + 1);
        for round in 0..160 {
            let depth = 1 + dice.throw(3);
            let condition = dice.truth(depth);
            let expected = evaluated(&mut checked, &condition);
            let question = asked(&mut checked, &format!("{given} and ({condition})"));
            let decided = question.decide(&mut NoSolver);
            for session in sessions.iter_mut().filter(|_| round % 4 == 0) {
                let agree = match (told(&mut **session, &question), expected) {
                    (Verdict::Possible, expected) => expected == Some(true),
                    (Verdict::Impossible, expected) => expected != Some(true),
                    (Verdict::Unknown, _) => true,
                };
                assert!(agree, "{given}\n{condition}\nthe machine says {expected:?}\n{}", question.script());
            }
            let agree = match (&decided, expected) {
                (Decision::Possible(_), Some(true)) | (Decision::Impossible, Some(false) | None) => true,
                // Cases alone cannot exclude numbers that they do not try.
                (Decision::Unknown(_), Some(false) | None) => true,
                _ => false,
            };
            assert!(agree, "{given}\n{condition}\n{decided:?}, the machine says {expected:?}");
            counts[expected.map_or(2, usize::from)] += 1;
        }
    }
    assert!(counts.iter().all(|count| *count > 50), "{counts:?}");
}

/// A solver's verdict.
fn told(session: &mut dyn Session, question: &Question) -> Verdict {
    let script = question.script();
    let (before, _) = script.split_once("(check-sat)").expect("it asks");
    let answer = session.ask(&format!("(reset)\n{before}(check-sat)\n"), 20, &mut || true).expect("it answers");
    verdict(&answer).expect("a verdict")
}

fn asked(checked: &mut model::Checked, condition: &str) -> Question {
    let parse = syntax::parse_term(FileId(9), condition);
    let term = TermFile::cast(parse.syntax()).and_then(|file| file.term()).expect("a term");
    let fragment = checked.model.check_condition(FileId(9), &term, "the condition");
    assert!(fragment.diagnostics.iter().all(|found| found.severity != syntax::Severity::Error), "{condition}");
    let mut program = program::lower(&checked.model).expect("it is lowered");
    let lowered = program::lower_term(&mut program, &checked.model, &fragment.item, &fragment.variables);
    question(&Arc::new(program), &lowered.expect("it is lowered")).expect("it is inside")
}

/// The truth of a condition in the initial state; `None` if its evaluation faults.
fn evaluated(checked: &mut model::Checked, condition: &str) -> Option<bool> {
    let parse = syntax::parse_term(FileId(9), condition);
    let term = TermFile::cast(parse.syntax()).and_then(|file| file.term()).expect("a term");
    let fragment = checked.model.check_condition(FileId(9), &term, "the condition");
    let mut program = program::lower(&checked.model).expect("it is lowered");
    let lowered = program::lower_term(&mut program, &checked.model, &fragment.item, &fragment.variables);
    let mut machine = Machine::new(Arc::new(program), Limits::default());
    machine.start(&mut Closed).expect("it starts");
    match machine.evaluate(&lowered.expect("it is lowered"), &mut Closed) {
        Ok(Value::Boolean(truth)) => Some(truth),
        _ => None,
    }
}
