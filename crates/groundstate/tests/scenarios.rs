//! The meaning of scenarios, command by command (spec/avalla.md).

use groundstate::scenario::{FirstCandidate, Judgement, Options};
use groundstate::{Suite, diagnose_failure};
use syntax::SourceFile;
use testkit::Texts;

const MODEL: &str = "
asm Meter
import StandardLibrary
signature:
    domain Level subsetof Integer
    monitored input: Integer
    monitored level: Level
    monitored at: Integer -> Integer
    shared mode: Integer
    controlled sum: Integer
    controlled last: Integer
    derived double: Integer
definitions:
    domain Level = {0 : 9}
    function double = 2 * sum
    rule r_add = par sum := sum + input last := input endpar
    rule r_clash = if mode = 9 then par last := 1 last := 2 endpar endif
    rule r_fail = if mode = 8 then last := idiv(1, 0) endif
    rule r_own = if mode = 7 then mode := 1 endif
    invariant inv_input over input: input < 100
    invariant inv_sum over sum: sum < 1000
    main rule r_Main = par if isDef(input) then r_add[] endif r_clash[] r_fail[] r_own[] endpar
default init s0:
    function sum = 0
    function mode = 0
";

const SHARED: &str = "scenario shared load Meter.asm begin twice set input := 2; step 2 end";

/// The model, and a scenario to include.
fn files() -> Texts {
    Texts::of([("Meter.asm", MODEL), ("shared.avalla", SHARED)])
}

/// Runs commands and describes the result: `passed N steps`, `expected`, or the messages of the failures.
fn check(commands: &str, expected: &str) {
    let source = SourceFile::new("test.avalla", format!("scenario test load Meter.asm {commands}"));
    let tested = Suite::new().test(source, &mut files(), Options::default(), &mut FirstCandidate);
    let outcome = match tested.verdict.zip(tested.program) {
        None => tested.diagnostics.iter().map(|fault| fault.message.clone()).collect::<Vec<_>>().join("; "),
        Some((verdict, program)) => match &verdict.judgement {
            Judgement::Passed => format!("passed, {} steps", verdict.steps),
            Judgement::FailedAsExpected(_) => "failed as expected".to_string(),
            Judgement::Failed(failures) => {
                let messages = failures.iter().flat_map(|failure| diagnose_failure(failure, &program));
                messages.map(|fault| fault.message).collect::<Vec<_>>().join("; ")
            }
        },
    };
    assert_eq!(outcome, expected, "{commands}");
}

#[test]
fn inputs_stay_until_set_again() {
    check("set input := 5; step step step check sum = 15; set input := 1; step check sum = 16;", "passed, 4 steps");
}

#[test]
fn an_input_never_set_is_undef() {
    check("check isUndef(input); step check sum = 0 and isUndef(last);", "passed, 1 steps");
}

#[test]
fn a_check_sees_the_coming_inputs() {
    check("set input := 5; step check input = 6; set input := 6; step", "passed, 2 steps");
}

#[test]
fn a_strict_check_sees_the_inputs_used() {
    check("set input := 5; step set input := 6; strict check input = 5; check input = 6;", "passed, 1 steps");
    check("set input := 5; strict check input = 5; step", "passed, 1 steps");
}

#[test]
fn sets_see_those_before_and_the_state() {
    check(
        "set input := 5; set level := input + 1; check level = 6; step set input := sum * 2; check input = 10;",
        "passed, 1 steps",
    );
}

#[test]
fn arguments_of_a_set_are_terms() {
    check("set at(sum + 1) := 4; check at(1) = 4 and isUndef(at(0));", "passed, 0 steps");
}

#[test]
fn a_set_before_the_first_step_overrides_a_shared_initial_value() {
    check("set mode := 3; check mode = 3; step check mode = 3;", "passed, 1 steps");
}

#[test]
fn the_machine_may_change_a_shared_function() {
    check("set mode := 7; step check mode = 1; step check mode = 1;", "passed, 2 steps");
}

#[test]
fn only_the_environments_functions_are_set() {
    check("set sum := 3; step", "the controlled function `sum` cannot be updated");
}

#[test]
fn a_set_stays_in_the_domain() {
    check("set level := 12; step", "12 is not in Level, the domain of level");
}

#[test]
fn a_failed_check_lets_its_group_be_checked_and_stops() {
    check(
        "set input := 1; step check sum = 2; check sum = 1; check last = 3; step check sum = 9;",
        "check failed after 1 step: expected 2, found 1; check failed after 1 step: expected 3, found 1",
    );
}

#[test]
fn an_exec_works_on_the_current_state_in_order() {
    check("exec sum := 5; check sum = 5; exec sum := sum + 1; check sum = 6 and double = 12;", "passed, 0 steps");
    check("exec par last := 1 last := 2 endpar", "expected `;` at the end of the command, found the end of the file");
}

#[test]
fn an_exec_writes_inputs_that_stay() {
    check("exec input := sum + 4; check input = 4; step step check sum = 8;", "passed, 2 steps");
    check(
        "exec choose $i in {3 : 5} with $i > 3 do par input := $i mode := 3 endpar; step check last = 4;",
        "passed, 1 steps",
    );
    check("set input := 1; exec input := undef; step check sum = 0;", "passed, 1 steps");
}

#[test]
fn step_until_tests_first() {
    check("set input := 3; step until sum = 0; check sum = 0; step until sum > 7; check sum = 9;", "passed, 3 steps");
    check("set input := 1; step until sum = 3 within 3;", "passed, 3 steps");
    check("set input := 1; step until sum = 4 within 3;", "the condition did not hold within 3 steps");
}

#[test]
fn an_invariant_over_inputs_waits_for_them() {
    check("step 2", "passed, 2 steps");
    check("step set input := 100; step", "invariant inv_input does not hold after 1 step");
}

#[test]
fn an_invariant_over_inputs_holds_at_the_end_too() {
    check("step set input := 100;", "invariant inv_input does not hold after 1 step");
}

#[test]
fn an_invariant_of_the_scenario_holds_in_all_its_states() {
    check("invariant small: sum < 3; set input := 2; step 2", "invariant small does not hold after 2 steps");
    check("invariant small: sum < 3; exec sum := 4;", "invariant small does not hold after 0 steps");
}

#[test]
fn blocks_run_where_they_stand_and_where_they_are_called() {
    check("set input := 1; begin one step end execblock one; check sum = 2;", "passed, 2 steps");
    check("execblock shared:twice; check sum = 4;", "passed, 2 steps");
}

#[test]
fn an_expected_clash_is_one_step_that_is_not_made() {
    check("set mode := 9; expect inconsistent update; check isUndef(last); set mode := 0; step", "passed, 1 steps");
    check("expect inconsistent update;", "an inconsistent update was expected, but none came");
    check(
        "set mode := 8; expect inconsistent update;",
        "an inconsistent update was expected, but something else happened; division by zero",
    );
    check("set mode := 8; expect error; set mode := 0; step", "passed, 1 steps");
}

#[test]
fn an_unexpected_fault_is_a_failure() {
    check("set mode := 8; step", "division by zero");
}

#[test]
fn a_whole_scenario_may_be_expected_to_fail() {
    check("expect failure; check sum = 1;", "failed as expected");
    check("expect failure by check; check sum = 1;", "failed as expected");
    check("expect failure by invariant inv_sum; exec sum := 2000; step", "failed as expected");
    check("expect failure by inconsistent update; set mode := 9; step", "failed as expected");
    check("expect failure by error; set mode := 8; step", "failed as expected");
    check("expect failure by check; check sum = 0;", "a failed check was expected, but none came");
    check(
        "expect failure by error; check sum = 1;",
        "a run-time error was expected, but something else happened; check failed after 0 steps: expected 1, found 0",
    );
}
