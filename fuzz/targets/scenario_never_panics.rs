//! Whatever the texts: a scenario against a model comes to a verdict or to faults.
#![no_main]

use fuzz::{DIVIDER, Models};
use groundstate::scenario::{FirstCandidate, Options};
use libfuzzer_sys::fuzz_target;
use syntax::SourceFile;

fuzz_target!(|data: &[u8]| {
    let text = fuzz::text(data);
    let (model, scenario) = text.split_once(DIVIDER).unwrap_or(("", &text));
    let mut models = Models { root: model.to_string() };
    let options = Options { limits: fuzz::limits(), bound: 20, coverage: true };
    let source = SourceFile::new("Scenario.avalla", scenario);
    let tested = groundstate::Suite::new().test(source, &mut models, options, &mut FirstCandidate);
    for fault in &tested.diagnostics {
        tested.sources.position(fault.primary.span);
    }
});
