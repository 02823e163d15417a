//! Whatever the text: a model that checks lowers to a program that the verifier accepts, and runs ten steps with random
//! inputs and choices, or stops for a reason.
#![no_main]

use std::sync::Arc;

use fuzz::Models;
use libfuzzer_sys::fuzz_target;
use simulate::{Bounds, Choices, Inputs, Options, RandomSource, Run};
use syntax::SourceFile;

fuzz_target!(|data: &[u8]| {
    let Ok(loaded) = groundstate::load(SourceFile::new("Model.asm", fuzz::text(data)), &mut Models::default()) else { return };
    assert_eq!(program::verify(&loaded.program), Ok(()));
    if loaded.program.main.is_none() {
        return;
    }
    let seed = data.len() as u64;
    let inputs = Inputs::new().with(RandomSource::new(seed, Bounds::default())).choosing(Choices::random(seed));
    let options = Options { steps: Some(10), ..Options::default() };
    let mut run = Run::new(Arc::new(loaded.program), fuzz::limits(), inputs, options);
    while run.advance().is_some() {}
});
