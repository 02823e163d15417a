//! `properties`: a failed step leaves the state.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    properties::check("a_failed_step_leaves_the_state", data);
});
