//! Whatever the text: parsing ends, gives a tree with every byte of it, and faults inside it.
#![no_main]

use libfuzzer_sys::fuzz_target;
use syntax::{FileId, parse_asmetal, parse_avalla, parse_term};

fuzz_target!(|data: &[u8]| {
    let text = fuzz::text(data);
    for parse in [parse_asmetal, parse_avalla, parse_term] {
        let parsed = parse(FileId(0), &text);
        assert_eq!(parsed.syntax().text(), text.as_str(), "the tree holds the whole text");
        for fault in &parsed.diagnostics {
            let range = fault.primary.span.range();
            assert!(text.get(range).is_some(), "{} lies in the text", fault.id);
        }
    }
});
