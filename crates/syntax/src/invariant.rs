//! What holds for every parse, whatever the text: the entry of fuzz targets and property tests.
//!
//! In: any bytes. Out: nothing, or a panic that names the broken invariant.

use crate::{
    Diagnostic, FileId, MAX_FAULTS, Parse, SyntaxKind, format, parse_asmetal, parse_avalla, parse_chart, parse_term,
};

/// Parses any bytes as a model, a scenario, a chart and a term, and asserts what holds for every parse.
///
/// # Panics
///
/// When the parser breaks one of its promises.
pub fn assert_invariants(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    for grammar in [parse_asmetal, parse_avalla, parse_chart, parse_term] {
        let parse = grammar(FileId(0), &text);
        assert_formats(&parse, grammar);
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

/// Formatting keeps the tokens, comments and nodes of a text without errors; formatting twice is formatting once.
fn assert_formats(parse: &Parse, grammar: fn(FileId, &str) -> Parse) {
    let formatted = format(parse);
    let again = grammar(FileId(0), &formatted);
    assert!(words(parse) == words(&again), "formatting changes more than white space: {formatted}");
    assert!(format(&again) == formatted, "formatting again changes the text: {formatted}");
}

/// Whether two parses hold the same tokens and comments in the same tree: whether white space is all they differ in.
pub fn differ_in_layout_only(one: &Parse, other: &Parse) -> bool {
    words(one) == words(other)
}

/// All of a tree but its white space; a comment's blanks at its end do not count.
fn words(parse: &Parse) -> Vec<(SyntaxKind, String)> {
    let root = parse.syntax();
    let elements = root.descendants_with_tokens().filter(|element| element.kind() != SyntaxKind::WHITESPACE);
    let text = |element: &crate::SyntaxElement| element.as_token().map(|token| token.text().trim_end().to_string());
    elements.map(|element| (element.kind(), text(&element).unwrap_or_default())).collect()
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
