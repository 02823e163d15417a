//! Whatever the model, a step ends within its limits, and one that meets a fault leaves the state as it was.
#![no_main]

use std::sync::Arc;

use fuzz::Models;
use libfuzzer_sys::fuzz_target;
use machine::Machine;
use syntax::{Severity, SourceFile};

fuzz_target!(|data: &[u8]| {
    let text = fuzz::text(data);
    let checked = model::check(SourceFile::new("Model.asm", text.as_str()), &mut Models::default());
    if checked.diagnostics.iter().any(|fault| fault.severity == Severity::Error) {
        return;
    }
    let Ok(program) = program::lower(&checked.model) else { return };
    let mut environment = fuzz::Seeded(text.len() as u64);
    let mut machine = Machine::new(Arc::new(program), fuzz::limits());
    if machine.start(&mut environment).is_err() {
        return;
    }
    for _ in 0..8 {
        machine.forget_inputs();
        let before = machine.locations();
        if machine.step(&mut environment).is_err() {
            machine.forget_inputs();
            assert_eq!(machine.locations(), before);
            return;
        }
    }
});
