//! Whatever the text, parsing ends, and the tree holds every byte of it; so does formatting's input.
#![no_main]

use libfuzzer_sys::fuzz_target;
use syntax::FileId;

fuzz_target!(|text: &str| {
    for parse in [syntax::parse_asmetal, syntax::parse_avalla, syntax::parse_term] {
        assert_eq!(parse(FileId(0), text).syntax().text().to_string(), text);
    }
});
