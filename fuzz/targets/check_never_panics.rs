//! Whatever the text: checking ends, its faults lie in the texts read, and a model without errors lowers to a program
//! that the verifier accepts.
#![no_main]

use fuzz::Models;
use libfuzzer_sys::fuzz_target;
use syntax::{Severity, SourceFile};

fuzz_target!(|data: &[u8]| {
    let checked = model::check(SourceFile::new("Model.asm", fuzz::text(data)), &mut Models::default());
    for fault in &checked.diagnostics {
        checked.sources.position(fault.primary.span);
        checked.sources.text(fault.primary.span);
    }
    if checked.diagnostics.iter().all(|fault| fault.severity != Severity::Error) {
        if let Ok(program) = program::lower(&checked.model) {
            program::verify(&program).expect("lowering makes a program that verifies");
        }
    }
});
