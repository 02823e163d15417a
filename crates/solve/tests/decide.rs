//! Conditions over a small model: which can hold, in which state, and what a solver is asked.

use std::sync::Arc;

use expect_test::{Expect, expect};
use model::{Checked, check as check_model};
use solve::{Decision, Question, Solver};
use syntax::ast::{AstNode, TermFile};
use syntax::{FileId, SourceFile};
use testkit::NoFiles;

const MODEL: &str = "asm Plant
import StandardLibrary
signature:
	enum domain Mode = {AUTO | HAND | STOPPED}
	abstract domain Valve
	dynamic abstract domain Part
	domain Level subsetof Integer
	static inlet: Valve
	static outlet: Valve
	monitored mode: Mode
	monitored level: Level
	monitored temperature: Integer
	monitored pressure: Real
	monitored count: Natural
	controlled open: Valve -> Boolean
	controlled next: Valve -> Valve
	controlled held: Part
	controlled wanted: Part
	controlled due: Integer
	monitored name: String
	derived hot: Boolean
	derived busy: Valve -> Boolean
	controlled queue: Seq(Integer)
definitions:
	domain Level = {0 : 4}
	function hot = temperature > 80
	function busy($v in Valve) = open($v) and mode != STOPPED
	main rule r_Main = skip
";

fn model(text: &str) -> Checked {
    let checked = check_model(SourceFile::new("Plant.asm", text), &mut NoFiles);
    // A static function without a definition counts as unknown.
    let told = checked.diagnostics.iter().filter(|found| found.id != "undefined-function");
    assert_eq!(told.count(), 0, "{:?}", checked.diagnostics);
    checked
}

fn question(condition: &str) -> Result<Question, String> {
    question_of(MODEL, condition)
}

fn question_of(text: &str, condition: &str) -> Result<Question, String> {
    let mut checked = model(text);
    let parse = syntax::parse_term(FileId(9), condition);
    let term = TermFile::cast(parse.syntax()).and_then(|file| file.term()).expect("a term");
    let fragment = checked.model.check_condition(FileId(9), &term, "the condition");
    assert_eq!(fragment.diagnostics, [], "{condition}");
    let mut program = program::lower(&checked.model).expect("it is lowered");
    let lowered = program::lower_term(&mut program, &checked.model, &fragment.item, &fragment.variables);
    solve::question(&Arc::new(program), &lowered.expect("it is lowered")).map_err(|outside| outside.what)
}

/// Returns a recorded answer, and keeps the script.
struct Recorded(Result<&'static str, &'static str>, Option<String>);

impl Solver for Recorded {
    fn solve(&mut self, script: &str) -> Result<String, String> {
        self.1 = Some(script.to_string());
        self.0.map(str::to_string).map_err(str::to_string)
    }
}

/// Checks a condition that needs no solver.
fn check(condition: &str, expected: Expect) {
    expected.assert_eq(&decided(MODEL, condition));
}

fn decided(text: &str, condition: &str) -> String {
    let mut solver = Recorded(Err("there is no solver"), None);
    let decision = match question_of(text, condition) {
        Ok(question) => question.decide(&mut solver),
        Err(what) => Decision::Unknown(what),
    };
    match decision {
        Decision::Possible(state) => state.join(", "),
        Decision::Impossible => "never".to_string(),
        Decision::Unknown(reason) => format!("unknown: {reason}"),
    }
}

#[test]
fn finite_domains_are_gone_through() {
    check("mode = AUTO and mode = HAND", expect!["never"]);
    check("mode = AUTO or mode = HAND", expect!["mode = AUTO"]);
    check("mode != AUTO and mode != HAND", expect!["mode = STOPPED"]);
    check("mode != AUTO and mode != HAND and mode != STOPPED", expect!["never"]);
    check("level > 4", expect!["never"]);
    check("level * level = 9 and level mod 2 = 1", expect!["level = 3"]);
    check("idiv(level, 0) = 1", expect!["never"]);
    check(
        "(exist $v in Valve with busy($v) and not busy(next($v)))",
        expect!["$v = inlet, open(inlet), mode = AUTO, next(inlet) = outlet, not open(outlet)"],
    );
    check("(forall $v in Valve with busy($v)) and not open(inlet)", expect!["never"]);
    check("(exist $l in Level with $l > 2 and $l != level and level > 3)", expect!["$l = 3, level = 4"]);
    check("open(next(inlet)) and not open(inlet) and next(inlet) = inlet", expect!["never"]);
    check("open(next(inlet)) and not open(inlet)", expect!["next(inlet) = outlet, open(outlet), not open(inlet)"]);
    check("level in {1, 3} and level notin {0 : 2}", expect!["level = 3"]);
    check(
        "if mode = AUTO then level = 1 else level = 2 endif and mode != HAND and level = 2",
        expect!["mode = STOPPED, level = 2"],
    );
    check("(switch mode case AUTO: 1 case HAND: 2 otherwise 3 endswitch) = 3", expect!["mode = STOPPED"]);
    check("let ($x = level) in $x > 3 endlet", expect!["level = 4"]);
}

#[test]
fn numbers_compared_with_constants_are_decided() {
    check("temperature > 3 and temperature < 5", expect!["temperature = 4"]);
    check("temperature > 3 and temperature < 4", expect!["never"]);
    check("pressure > 3.0 and pressure < 4.0", expect!["pressure = 3.5"]);
    check("hot and temperature < 80", expect!["never"]);
    check("count < 0", expect!["never"]);
    check("count < 1", expect!["count = 0"]);
    check("not hot and mode = AUTO", expect!["temperature = 0, mode = AUTO"]);
}

#[test]
fn open_carriers_have_enough_elements() {
    check("held != wanted", expect!["held = Part!1, wanted = Part!2"]);
    check("held != held", expect!["never"]);
    check("name = \"a\" and name = \"b\"", expect!["never"]);
    check("name != \"a\"", expect!["name = String!1"]);
}

#[test]
fn what_is_bound_is_evaluated() {
    check("let ($x = idiv(1, level)) in mode = AUTO endlet", expect!["level = 1, mode = AUTO"]);
    check("let ($x = idiv(1, 0)) in mode = AUTO endlet", expect!["never"]);
}

#[test]
fn ranges_are_compared_with_their_ends() {
    check(
        "temperature in {3 : 1000000000000} and temperature notin {0 : 2000000000}",
        expect!["temperature = 2000000001"],
    );
    check("level in {3 : count}", expect!["level = 3, count = 3"]);
    check(
        "count in {3 : level} and level < 3",
        expect!["unknown: the numbers have too many values to go through, and there is no solver"],
    );
    check("(exist unique $l in Level with $l > level)", expect!["level = 3"]);
}

#[test]
fn elements_of_a_module_may_have_others_beside_them_and_lists_have_not() {
    let text = "module Plant
import StandardLibrary
export *
signature:
	abstract domain Valve
	domain Inner subsetof Valve
	domain Robot subsetof Agent
	static inlet: Valve
	static outlet: Inner
	static arm: Robot
	controlled current: Valve
	controlled next: Inner
	controlled busy: Robot
	monitored name: String
	monitored letter: Char
	static limit: Integer
	domain Fraction subsetof Real
	monitored fraction: Fraction
definitions:
	domain Fraction = {0.5, 1.5}
";
    let check = |condition: &str, expected: Expect| expected.assert_eq(&decided(text, condition));
    check("current != inlet and current != outlet", expect!["current = Valve!1"]);
    check("next != outlet and next = current", expect!["next = inlet, current = inlet"]);
    check("busy != arm", expect!["busy = Agent!1"]);
    check("(exist $v in Valve with $v != inlet)", expect!["$v = outlet"]);
    check("(forall $v in Valve with $v = inlet) and isDef(name)", expect!["unknown: a range over all of Valve"]);
    check("name != \"a\" and letter != 'b' and letter != 'c'", expect!["name = String!1, letter = Char!1"]);
    check("limit > 3", expect!["limit = 4"]);
    check("fraction > 1.0", expect!["fraction = 1.5"]);
    check("fraction > 1.5", expect!["never"]);
}

#[test]
fn undef_counts_where_it_is_asked_for() {
    check("isDef(due) and due > 3", expect!["due = 4"]);
    check("isUndef(due) and due > 3", expect!["never"]);
    check("isUndef(due)", expect!["isUndef(due)"]);
    check("due = undef or due < 0", expect!["due = -1"]);
    check("not (due < 0) and not (due >= 0)", expect!["never"]);
}

#[test]
fn a_solver_is_asked_where_cases_do_not_tell() {
    check(
        "temperature + due = 7 and temperature - due = 100",
        expect!["unknown: the numbers have too many values to go through, and there is no solver"],
    );
    check(
        "temperature > due and due > temperature",
        expect!["unknown: the numbers have too many values to go through, and there is no solver"],
    );
    check("length(queue) > 3", expect!["unknown: a term of the domain Seq(Integer)"]);
}

#[test]
fn answers_of_a_solver() {
    let check = |condition: &str, output: Result<&'static str, &'static str>, expected: Expect| {
        let question = question(condition).expect("it is inside");
        expected.assert_eq(&format!("{:?}", question.decide(&mut Recorded(output, None))));
    };
    let sum = "temperature + due = 7 and temperature - due = 101";
    check(sum, Ok("unsat\n(error \"line 9 column 11: model is not available\")\n"), expect!["Impossible"]);
    check(
        sum,
        Ok("sat\n((|temperature 0| 54)\n (|due 1| (- 47)))\n"),
        expect![[r#"Possible(["temperature = 54", "due = -47"])"#]],
    );
    check(
        sum,
        Ok("sat\n((|temperature 0| 54)\n (|due 1| 47))\n"),
        expect![[r#"Unknown("the state that the solver gave does not hold")"#]],
    );
    check(
        sum,
        Ok("unknown\n"),
        expect![[r#"Unknown("the numbers have too many values to go through, and the solver says `unknown`")"#]],
    );
    check(
        sum,
        Ok("(error \"line 1: no\")\n"),
        expect![[
            r#"Unknown("the numbers have too many values to go through, and the solver says `(error \"line 1: no\")`")"#
        ]],
    );
    check(
        sum,
        Ok(""),
        expect![[r#"Unknown("the numbers have too many values to go through, and the solver says `nothing`")"#]],
    );
    check(sum, Ok("sat"), expect![[r#"Unknown("the state that the solver gave does not hold")"#]]);
}

#[test]
fn scripts() {
    let check =
        |condition: &str, expected: Expect| expected.assert_eq(&question(condition).expect("it is inside").script());
    check(
        "temperature + due > 7 and temperature mod due = -1",
        expect![[r#"
            (set-option :produce-models true)
            (set-logic ALL)
            (declare-fun |temperature.0| () Int)
            (declare-fun |due.1| () Int)
            (assert (<= (- 9223372036854775808) |temperature.0| 9223372036854775807))
            (assert (<= (- 9223372036854775808) |due.1| 9223372036854775807))
            (assert (let ((n5 (+ |temperature.0| |due.1|)))
            (let ((n15 (< 7 n5)))
            (and (not (< n5 (- 9223372036854775808))) (not (< 9223372036854775807 n5)) n15 (not (and n15 (= |due.1| 0))) (= (ite (<= 0 |temperature.0|) (mod |temperature.0| |due.1|) (- (mod (- |temperature.0|) (+ 0 |due.1|)))) (- 1))))))
            (check-sat)
            (get-value (|temperature.0| |due.1|))
        "#]],
    );
    check(
        "(exist $v in Valve with open(next($v)) and mode = AUTO and held != wanted and pressure / 2 > -0.5)",
        expect![[r#"
            (set-option :produce-models true)
            (set-logic ALL)
            (declare-fun |$v.0| () Int)
            (declare-fun |next.1| (Int) Int)
            (declare-fun |open.2| (Int) Bool)
            (declare-fun |mode.3| () Int)
            (declare-fun |held.4| () Int)
            (declare-fun |wanted.5| () Int)
            (declare-fun |pressure.6| () Real)
            (assert (<= 0 |$v.0| 1))
            (assert (<= 0 (|next.1| |$v.0|) 1))
            (assert (<= 0 |mode.3| 2))
            (assert (<= 0 |held.4| 4294967296))
            (assert (<= 0 |wanted.5| 4294967296))
            (assert (and (|open.2| (|next.1| |$v.0|)) (= 0 |mode.3|) (not (= |held.4| |wanted.5|)) (< (- (/ 1.0 2.0)) (/ |pressure.6| 2.0))))
            (check-sat)
            (get-value (|$v.0| (|next.1| |$v.0|) (|open.2| (|next.1| |$v.0|)) |mode.3| |held.4| |wanted.5| |pressure.6|))
        "#]],
    );
    check(
        "isUndef(due) or name = \"a|b\" or level > 1",
        expect![[r#"
            (set-option :produce-models true)
            (set-logic ALL)
            (declare-fun |isDef due.1| () Bool)
            (declare-fun |name.2| () Int)
            (declare-fun |level.3| () Int)
            (assert (<= 0 |name.2| 4294967296))
            (assert (<= 0 |level.3| 4))
            (assert (or (not |isDef due.1|) (= |name.2| 0) (< 1 |level.3|)))
            (check-sat)
            (get-value (|isDef due.1| |name.2| |level.3|))
        "#]],
    );
}
