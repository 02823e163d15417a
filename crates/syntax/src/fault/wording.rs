//! How faults name what was found, what was expected, and the classes of names.
//!
//! In: kinds and texts of tokens. Out: pieces of sentences; [`renamed`] proposes the nearest name of a class.
//! INVARIANT: a found text is shown shortened and between backticks, so no message ends with a full stop.

use crate::SyntaxKind::{self, *};

/// A token as a message names it.
pub(super) fn found(kind: SyntaxKind, text: &str) -> String {
    let short: String =
        if text.chars().count() > 40 { text.chars().take(37).chain("…".chars()).collect() } else { text.into() };
    match kind {
        EOF => "the end of the file".to_string(),
        STRING => format!("the string `{short}`"),
        INTEGER | NATURAL | REAL | COMPLEX => format!("the number {short}"),
        _ => format!("`{short}`"),
    }
}

/// A token that was expected, as a message names it.
pub(super) fn expected(kind: SyntaxKind) -> String {
    match kind.text() {
        Some(text) => format!("`{text}`"),
        None => name_of(kind).to_string(),
    }
}

/// What a kind of name or literal is called.
pub(super) fn name_of(kind: SyntaxKind) -> &'static str {
    match kind {
        VARIABLE => "a variable",
        ENUM_ID => "an enum literal",
        DOMAIN_ID => "the name of a domain",
        RULE_ID => "the name of a rule",
        INVARIANT_ID => "the name of an invariant",
        CTL_ID => "the name of a CTL property",
        LTL_ID => "the name of an LTL property",
        FUNCTION_ID => "the name of a function",
        GENERIC_ID => "a name",
        MODULE_REF => "a path",
        INTEGER => "an integer",
        STRING => "a string",
        _ => "something else",
    }
}

/// The shape of a class of names (spec/language.md, 1.2).
pub(super) fn shape_of(kind: SyntaxKind) -> &'static str {
    match kind {
        VARIABLE => "a variable is `$` and then a name, as `$x`",
        ENUM_ID => {
            "an enum literal has at least two leading capitals and then only capitals, digits and `_`, as `RED` or `AB_1`"
        }
        DOMAIN_ID => "a domain's name starts with a capital and is not all in capitals, as `Colour` or `D1`",
        RULE_ID => "a rule's name starts with `r_`, as `r_move`",
        INVARIANT_ID => "an invariant's name starts with `inv_`, as `inv_safe`",
        CTL_ID => "a CTL property's name starts with `ctlSpec_`, as `ctlSpec_live`",
        LTL_ID => "an LTL property's name starts with `ltlSpec_`, as `ltlSpec_live`",
        FUNCTION_ID => "a function's name starts with a small letter and is no keyword, as `speed`",
        _ => "a name holds letters, digits and `_`, and does not start with a digit",
    }
}

/// The nearest name of a class.
pub(super) fn renamed(old: &str, kind: SyntaxKind) -> Option<String> {
    let bare = old.trim_start_matches(['$', '_']);
    let first = bare.chars().next().filter(|_| bare.is_ascii())?;
    let name = match kind {
        VARIABLE => format!("${bare}"),
        ENUM_ID => bare.to_ascii_uppercase(),
        DOMAIN_ID => first.to_ascii_uppercase().to_string() + &bare[1..].to_ascii_lowercase(),
        RULE_ID => format!("r_{bare}"),
        INVARIANT_ID => format!("inv_{bare}"),
        CTL_ID => format!("ctlSpec_{bare}"),
        LTL_ID => format!("ltlSpec_{bare}"),
        FUNCTION_ID => first.to_ascii_lowercase().to_string() + &bare[1..],
        _ => return None,
    };
    let fits = kind == VARIABLE || crate::lexer::classify(&name) == kind;
    (fits && name != old).then_some(name)
}
