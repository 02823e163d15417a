//! Whatever the text: checking ends, and its faults lie in the texts read.
#![no_main]

use fuzz::Models;
use libfuzzer_sys::fuzz_target;
use syntax::SourceFile;

fuzz_target!(|data: &[u8]| {
    let checked = model::check(SourceFile::new("Model.asm", fuzz::text(data)), &mut Models::default());
    for fault in &checked.diagnostics {
        checked.sources.position(fault.primary.span);
        checked.sources.text(fault.primary.span);
    }
});
