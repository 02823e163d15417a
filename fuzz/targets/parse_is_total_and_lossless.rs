//! `properties`: parse is total and lossless.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    properties::check("parse_is_total_and_lossless", data);
});
