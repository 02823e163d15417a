//! Whatever the text, checking ends with a model and faults; a model without errors lowers to an IR that verifies.
#![no_main]

use libfuzzer_sys::fuzz_target;
use syntax::{Severity, SourceFile};

fuzz_target!(|text: &str| {
    let checked = model::check(SourceFile::new("fuzz.asm", text), &mut fuzz::NoFiles);
    if checked.diagnostics.iter().all(|fault| fault.severity != Severity::Error) {
        if let Ok(program) = program::lower(&checked.model) {
            program::verify(&program).expect("lowering makes a program that verifies");
        }
    }
});
