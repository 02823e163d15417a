//! Names of a class.
//!
//! In: the cursor where a name must stand. Out: the name taken, and whether there was one. A name of another class is
//! taken with a fault, so that the text after it is still read. So is a keyword that is clearly meant as a name.
//! CIRCLE(grammar)

use crate::fault;
use crate::parser::Parser;
use crate::token_set::TokenSet;
use crate::{SyntaxKind, SyntaxKind::*};

/// Names of any class: they may be meant as a name of another class.
pub(super) const NAMES: TokenSet = TokenSet::new(&[
    ENUM_ID,
    DOMAIN_ID,
    RULE_ID,
    INVARIANT_ID,
    CTL_ID,
    LTL_ID,
    FUNCTION_ID,
    GENERIC_ID,
    VARIABLE,
    COMPLEX,
]);

/// Takes a name of a class; one of another class is taken with a fault.
pub(super) fn name(p: &mut Parser<'_>, kind: SyntaxKind) -> bool {
    if p.eat(kind) {
        return true;
    }
    let found = p.found();
    if p.at_any(NAMES) && !(p.at(COMPLEX) && found.text.starts_with(|c: char| c.is_ascii_digit())) {
        p.fault(fault::name_class(found, kind));
        p.bump();
        return true;
    }
    let keyword = found.kind.text().is_some_and(|text| text.starts_with(|c: char| c.is_ascii_alphabetic()));
    let section = matches!(found.kind, SIGNATURE_KW | DEFINITIONS_KW);
    if keyword && !section && matches!(p.peek(1), COLON | EQ | L_PAREN) {
        p.keyword_as_name(fault::keyword_as_name(found, kind));
        p.bump_as(kind); // a keyword, meant as a name
        return true;
    }
    p.fault(fault::expected_name(found, kind));
    false
}

/// The name of a domain, which a fault-finding later stage may meet in capitals only.
pub(super) fn domain_name(p: &mut Parser<'_>) -> bool {
    if p.eat(ENUM_ID) { true } else { name(p, DOMAIN_ID) }
}

/// A name of any shape: a machine, an initial state, a scenario, a block.
pub(super) fn generic_name(p: &mut Parser<'_>) -> bool {
    let word = p.token_text().starts_with(|c: char| c.is_alphabetic() || c == '_');
    if word {
        p.bump_as(GENERIC_ID);
        return true;
    }
    let found = p.missing();
    p.fault(fault::expected_name(found, GENERIC_ID));
    false
}
