//! Each kind of scenario fault has a page in spec/faults/, whose example shows it.

use groundstate::scenario::{FirstCandidate, Options};
use groundstate::{Suite, diagnose_failure};
use syntax::SourceFile;
use testkit::{Page, Texts};

/// The kinds of faults that only scenarios have.
const IDS: [&str; 14] = [
    "ambiguous-pick",
    "bound-reached",
    "check-failed",
    "duplicate-block",
    "expected-failure",
    "invariant-violated",
    "pick-no-candidate",
    "recursive-block",
    "too-many-commands",
    "unknown-block",
    "unknown-model",
    "unknown-pick",
    "unknown-scenario",
    "unused-pick",
];

fn faults_of(page: &Page) -> Vec<String> {
    let mut loader = Texts::of([("Lamp.asm", page.example("asmetal"))]);
    let scenario = SourceFile::new("example.avalla", page.example("avalla fault"));
    let tested = Suite::new().test(scenario, &mut loader, Options::default(), &mut FirstCandidate);
    let Some((verdict, program)) = tested.verdict.zip(tested.program) else {
        return tested.diagnostics.iter().map(|fault| format!("{}: {}", fault.id, fault.message)).collect();
    };
    let failures = verdict.failures().iter().flat_map(|failure| diagnose_failure(failure, &program));
    let failures = failures.map(|fault| format!("{}: {}", fault.id, fault.message));
    failures.chain(verdict.remarks.iter().map(|remark| format!("unused-pick: {}", remark.message))).collect()
}

#[test]
fn every_fault_has_a_page_that_shows_it() {
    for id in IDS {
        let faults = faults_of(&Page::fault(id));
        let ids: Vec<&str> = faults.iter().filter_map(|fault| fault.split(':').next()).collect();
        assert_eq!(ids, [id], "{faults:#?}");
    }
}

/// Their examples are tested where the faults are made: here, in `review` and in `verification`; faults of a step in
/// the tests of the machine.
#[test]
fn every_kind_of_fault_has_a_page() {
    assert!(groundstate::FAULT_IDS.is_sorted());
    for id in groundstate::FAULT_IDS.iter().chain(groundstate::REVIEW_IDS) {
        Page::fault(id);
    }
}
