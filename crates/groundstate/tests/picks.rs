//! Picks, and the clock of a scenario (spec/avalla.md).

use groundstate::scenario::{FirstCandidate, Judgement, Options};
use groundstate::{Suite, diagnose_failure};
use syntax::SourceFile;
use testkit::Texts;

const MODEL: &str = "
asm Draw
import StandardLibrary
import TimeLibrary
signature:
    controlled whole: Integer
    controlled text: String
    controlled from: Integer
    controlled seconds: Integer
    controlled clock: Integer
    monitored low: Integer
definitions:
    rule r_draw($n in Integer) = choose $x in {1 : 9} with $x >= $n do whole := $x
    rule r_draw($s in String) = choose $x in [\"a\", \"b\", \"c\"] with $x != $s do text := $x
    rule r_none = choose $y in {1 : 3} with $y > low do from := $y ifnone from := 0
    main rule r_Main =
        par
            r_draw[3]
            r_draw[\"a\"]
            r_none[]
            seconds := currTimeSecs
            clock := mCurrTimeSecs
        endpar
";

/// Runs commands and describes the result.
fn check(commands: &str, expected: &str) {
    let source = SourceFile::new("test.avalla", format!("scenario test load Draw.asm set low := 1; {commands}"));
    let tested =
        Suite::new().test(source, &mut Texts::of([("Draw.asm", MODEL)]), Options::default(), &mut FirstCandidate);
    let outcome = match tested.verdict.zip(tested.program) {
        None => tested.diagnostics.iter().map(|fault| fault.message.clone()).collect::<Vec<_>>().join("; "),
        Some((verdict, program)) => match &verdict.judgement {
            Judgement::Passed => format!("passed, {} remarks", verdict.remarks.len()),
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
fn a_pick_names_its_overload_by_the_domains() {
    check("pick $x in r_draw(Integer) := 7; step check whole = 7 and text = \"b\";", "passed, 0 remarks");
    check("pick $x in r_draw(String) := \"c\"; step check whole = 3 and text = \"c\";", "passed, 0 remarks");
}

#[test]
fn a_pick_holds_for_one_step() {
    check("pick $y := 3; step check from = 3; step check from = 2;", "passed, 0 remarks");
}

#[test]
fn of_several_picks_the_last_counts() {
    check("pick $y := 2; pick $y := 3; step check from = 3;", "passed, 0 remarks");
}

#[test]
fn a_pick_that_the_guard_refuses_fails() {
    check(
        "pick $x in r_draw(Integer) := 2; step",
        "after 0 steps: $x = 2 is not among the candidates: 3, 4, 5, 6, 7, 8, 9",
    );
}

#[test]
fn a_pick_where_there_is_no_candidate_fails() {
    check("set low := 3; pick $y := 3; step", "after 0 steps: $y = 3 is not among the candidates: there are none");
    check("set low := 3; step check from = 0;", "passed, 0 remarks");
}

#[test]
fn the_clock_shows_a_second_more_in_each_state() {
    check("step check seconds = 1 and clock = 1; step step check seconds = 3 and clock = 3;", "passed, 0 remarks");
    check("check currTimeMillisecs = 1000 and mCurrTimeMins = 0; step check currTimeSecs = 2;", "passed, 0 remarks");
}

#[test]
fn a_clock_that_is_set_stands_still() {
    check("set mCurrTimeSecs := 40; step step check clock = 40 and seconds = 2;", "passed, 0 remarks");
}
