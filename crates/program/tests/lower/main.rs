//! Golden tests of lowering: a small model in, the dump of its program out.
//!
//! Every program is verified. `UPDATE_EXPECT=1 cargo test -p program` brings the expectations up to date.

mod call;
mod domain;
mod fragment;
mod limit;
mod property;
mod rule;
mod term;
mod verify;

use expect_test::Expect;
use model::Model;
use program::Program;
use syntax::{Diagnostic, SourceFile};
use testkit::NoFiles;

/// A model of these sections, without faults.
fn model(signature: &str, definitions: &str) -> Model {
    let text = format!("asm x\nimport StandardLibrary\nsignature:\n{signature}\ndefinitions:\n{definitions}\n");
    checked(&text)
}

/// A model without faults.
fn checked(text: &str) -> Model {
    let checked = model::check(SourceFile::new("x.asm", text), &mut NoFiles);
    let faults: Vec<_> = checked.diagnostics.iter().filter(|fault| fault.severity == syntax::Severity::Error).collect();
    assert!(faults.is_empty(), "{faults:#?}\n{text}");
    checked.model
}

fn lowered(model: &Model) -> Program {
    let program = program::lower(model).expect("no limit is passed");
    program::verify(&program).expect("well formed");
    program
}

/// The dump of a model of these sections.
fn check(signature: &str, definitions: &str, expect: Expect) {
    expect.assert_eq(&program::dump(&lowered(&model(signature, definitions))));
}

/// The faults of a model of these sections.
fn faults(signature: &str, definitions: &str) -> Vec<Diagnostic> {
    program::lower(&model(signature, definitions)).expect_err("lowering reports a fault")
}
