//! `properties`: check never panics.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    properties::check("check_never_panics", data);
});
