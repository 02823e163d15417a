//! Properties of reading: parsing and checking, whatever the text.

use syntax::{FileId, Severity, parse_asmetal, parse_avalla, parse_term};

use crate::world::{self, Models};

/// Parsing ends, gives a tree with every byte of the text, and faults inside it.
pub(crate) fn parse_is_total_and_lossless(bytes: &[u8]) -> bool {
    let text = world::text(bytes);
    for parse in [parse_asmetal, parse_avalla, parse_term] {
        let parsed = parse(FileId(0), &text);
        assert_eq!(parsed.syntax().text(), text.as_str(), "the tree holds the whole text");
        for fault in &parsed.diagnostics {
            let range = fault.primary.span.range();
            assert!(text.get(range).is_some(), "{} lies in the text", fault.id);
        }
    }
    true
}

/// Checking ends, its faults lie in the texts read, and a model without errors lowers to a program that the verifier
/// accepts.
pub(crate) fn check_never_panics(bytes: &[u8]) -> bool {
    let checked = model::check(world::source(&world::text(bytes)), &mut Models::default());
    for fault in &checked.diagnostics {
        checked.sources.position(fault.primary.span);
        checked.sources.text(fault.primary.span);
    }
    if checked.diagnostics.iter().any(|fault| fault.severity == Severity::Error) {
        return false;
    }
    let Ok(program) = program::lower(&checked.model) else { return false };
    program::verify(&program).expect("lowering makes a program that verifies");
    true
}
