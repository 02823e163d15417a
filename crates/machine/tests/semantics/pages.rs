//! Each kind of fault has a page in spec/faults/ whose example shows it.

use std::sync::Arc;

use machine::{Closed, Limits, Machine};
use syntax::SourceFile;

use crate::NoFiles;

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
#[allow(clippy::disallowed_methods, reason = "the pages are files")]
fn every_fault_has_a_page_that_shows_it() {
    for id in IDS {
        let path = format!("{}/../../spec/faults/{id}.md", env!("CARGO_MANIFEST_DIR"));
        let page = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
        let (_, rest) = page.split_once("```asmetal run\n").expect("an example");
        let (example, _) = rest.split_once("```").expect("the example ends");
        assert_eq!(fault_of(example), Some(id), "the example of {id}");
    }
}
