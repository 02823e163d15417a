//! `properties`: step never panics.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    properties::check("step_never_panics", data);
});
