//! Each kind of fault has a page in spec/faults/ whose example shows it.

use std::sync::Arc;

use machine::{Closed, Limits, Machine};
use syntax::SourceFile;
use testkit::{NoFiles, Page};

/// Every kind of fault; [`machine::FaultKind::id`] gives no other.
const IDS: [&str; 15] = [
    "inconsistent-update",
    "value-outside-domain",
    "undefined-guard",
    "undefined-operand",
    "bad-operand",
    "division-by-zero",
    "integer-overflow",
    "not-a-number",
    "domain-not-enumerable",
    "not-runnable",
    "wrong-arguments",
    "temporal-operator",
    "limit-reached",
    "no-input",
    "no-main-rule",
];

/// The fault that the first ten steps of a model meet.
fn fault_of(text: &str) -> Option<&'static str> {
    let checked = model::check(SourceFile::new("example.asm", text), &mut NoFiles);
    let errors = checked.diagnostics.iter().filter(|d| d.severity == syntax::Severity::Error);
    assert_eq!(errors.map(|d| d.message.as_str()).collect::<Vec<_>>(), Vec::<&str>::new());
    let program = program::lower(&checked.model).expect("small enough");
    let mut machine = Machine::new(Arc::new(program), Limits::default());
    machine.start(&mut Closed).ok()?;
    (0..10).find_map(|_| machine.step(&mut Closed).err()).map(|fault| fault.kind.id())
}

#[test]
fn every_fault_has_a_page_that_shows_it() {
    for id in IDS {
        let page = Page::fault(id);
        assert_eq!(fault_of(page.example("asmetal run")), Some(id), "the example of {id}");
    }
}
