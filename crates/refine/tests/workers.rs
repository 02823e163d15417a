//! However many threads make the steps, a refinement comes to the same.
//!
//! Random machines get counters beside them, so that many states wait to be looked at; workers begin with the first pair.

#![allow(clippy::disallowed_methods, reason = "a test reads the environment")]

use std::sync::Arc;

use machine::{Cause, Interrupt, Limits};
use program::Program;
use refine::{CONCRETE, Coupling, Options, Report, Verdict, Why, refine};
use syntax::SourceFile;
use testkit::Random;

use crate::naive::{changed, machine_with, rule};
use crate::small::program;

/// The rule with counters beside it, which go their own ways.
pub fn counted(rule: &str) -> Arc<Program> {
    let text = format!(
        "asm M\nimport StandardLibrary\nsignature:\ndomain N subsetof Integer\ndomain C subsetof Integer\n\
         monitored go: Boolean\ncontrolled n: N\ncontrolled h: Boolean\ncontrolled c1: C\ncontrolled c2: C\ncontrolled total: Integer\n\
         definitions:\ndomain N = {{0:2}}\ndomain C = {{0:8}}\n\
         main rule r_Main = par\n{rule}\n\
         choose $up in Boolean with true do if $up then c1 := (c1 + 1) mod 9 endif\n\
         if go then c2 := (c2 + 1) mod 9 endif\n\
         total := (c1 + 1) * 1000003\nendpar\n\
         default init s0: function n = 0 function h = false function c1 = 0 function c2 = 0 function total = 0\n"
    );
    program("M", &text)
}

fn told(programs: [&Arc<Program>; 2], text: &str, options: &Options) -> Report {
    let text = SourceFile::new("test.refine", text);
    let coupling = Coupling::new(programs, Some(text), &Limits::default()).expect("it is a coupling");
    refine(&coupling, options, &mut |_| true).expect("it begins")
}

#[test]
fn threads_change_nothing() {
    let cases = if testkit::sample::is_full() { 200 } else { 20 };
    let mut random = Random(7);
    let couplings = [
        "same n;",
        "same n;\nallow waiting;",
        "same n;\ninput abstract.go = not concrete.go;",
        "same n;\nsame h;\ninput abstract.go = concrete.c2 = 0;",
        "couple abstract.n = concrete.n;\nfree abstract.go;\nsegment concrete.c1 != 1;\ndiagrams 0..2:1..3;",
    ];
    let (mut refines, mut pairs) = (0, 0);
    for case in 0..cases {
        let rule = rule(&mut random);
        let other = if random.below(3) == 0 { changed(&mut random, &rule) } else { rule.clone() };
        let programs = [&machine_with(&rule, ""), &counted(&other)];
        let text = couplings[case % couplings.len()];
        let alone = told(programs, text, &Options::default());
        for workers in [2, 4] {
            let together = told(programs, text, &Options { workers, alone: 0, ..Options::default() });
            assert_eq!(format!("{alone:?}"), format!("{together:?}"), "{text}\n{rule}\n{other}");
        }
        refines += usize::from(alone.verdict == Verdict::Refines);
        pairs += alone.progress.pairs;
    }
    assert!(refines > cases / 10 && pairs > 100 * cases as u64, "{refines} of {cases} refine, {pairs} pairs");
}

#[test]
fn a_search_that_is_interrupted_ends_its_workers() {
    let programs = [&machine_with("skip", ""), &counted("skip")];
    let mut options = Options { workers: 3, alone: 0, ..Options::default() };
    let interrupt = Interrupt::new();
    options.extents[CONCRETE].interrupt = interrupt.clone();
    let coupling = Coupling::new(programs, None, &Limits::default()).expect("it is a coupling");
    let mut asked = 0;
    let report = refine(&coupling, &options, &mut |_| {
        asked += 1;
        if asked == 2 {
            interrupt.raise(Cause::Asked);
        }
        true
    });
    let report = report.expect("it begins");
    assert_eq!(report.verdict, Verdict::Unknown(vec![Why::Stopped(Cause::Asked)]));
}
