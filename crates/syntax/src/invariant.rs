//! What holds of every parse, whatever the text: the entry of fuzz targets and property tests.
//!
//! In: any bytes. Out: nothing, or a panic that names the broken invariant.

use crate::{Diagnostic, FileId, MAX_FAULTS, Parse, parse_asmetal, parse_avalla, parse_term};

/// Parses any bytes as a model, a scenario and a term, and asserts what holds of every parse.
///
/// # Panics
///
/// When the parser breaks one of its promises.
pub fn assert_invariants(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    let file = FileId(0);
    for parse in [parse_asmetal(file, &text), parse_avalla(file, &text), parse_term(file, &text)] {
        assert_lossless(&parse, &text);
        assert_trimmed(&parse);
        assert!(parse.diagnostics.len() <= MAX_FAULTS + 1, "too many faults are reported");
        assert!(parse.diagnostics.is_sorted_by_key(|fault| fault.primary.span.start), "the faults are not in order");
        for fault in &parse.diagnostics {
            assert_well_formed(fault, &text);
        }
    }
}

fn assert_lossless(parse: &Parse, text: &str) {
    assert!(parse.syntax().text() == text, "the tree does not hold the text");
}

/// No node but the root starts or ends with trivia.
fn assert_trimmed(parse: &Parse) {
    for node in parse.syntax().descendants().skip(1) {
        let trivia = |token: Option<crate::SyntaxToken>| token.is_some_and(|token| token.kind().is_trivia());
        assert!(!trivia(node.first_token()) && !trivia(node.last_token()), "{:?} has trivia at an end", node.kind());
    }
}

fn assert_well_formed(fault: &Diagnostic, text: &str) {
    assert!(crate::FAULT_IDS.contains(&fault.id), "the id `{}` is not in the list", fault.id);
    assert!(!fault.message.is_empty() && !fault.message.ends_with('.'), "message of `{}`: {}", fault.id, fault.message);
    for label in std::iter::once(&fault.primary).chain(&fault.secondary) {
        assert!(label.span.start <= label.span.end, "a span of `{}` ends before it starts", fault.id);
        assert!(text.get(label.span.range()).is_some(), "the span {:?} of `{}` cuts a character", label.span, fault.id);
    }
}
