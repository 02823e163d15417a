//! `properties`: scenario never panics.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    properties::check("scenario_never_panics", data);
});
