//! Invariants, temporal properties and assumptions (spec/language.md, section 5).

use super::{domain, name, term};
use crate::SyntaxKind::{self, *};
use crate::fault;
use crate::parser::Parser;

/// `INVAR t`, `JUSTICE t`
pub(super) fn assumption(p: &mut Parser<'_>, kind: SyntaxKind) {
    p.start(kind);
    p.bump();
    term::term(p, "a formula");
    p.finish();
}

/// `COMPASSION (p, q)`; the peer knows it without the closing parenthesis only.
pub(super) fn compassion(p: &mut Parser<'_>) {
    p.start(COMPASSION);
    p.bump();
    if p.expect(L_PAREN, "behind `COMPASSION`") {
        term::term(p, "a formula");
        if p.expect(COMMA, "between the two formulas of `COMPASSION`") {
            term::term(p, "a formula");
        }
        p.eat(R_PAREN);
    }
    p.finish();
}

/// `invariant inv_x over a, B: t`
pub(super) fn invariant(p: &mut Parser<'_>) {
    p.start(INVARIANT);
    p.bump();
    if !p.at(OVER_KW) && !p.at(COLON) {
        name::name(p, INVARIANT_ID);
    }
    if p.expect(OVER_KW, "in an invariant") {
        over_list(p);
    }
    if p.expect(COLON, "before the formula of the invariant") {
        term::term(p, "a formula");
    }
    p.finish();
}

fn over_list(p: &mut Parser<'_>) {
    p.start(OVER_LIST);
    loop {
        p.start(OVER_ITEM);
        let named = over_item(p);
        p.finish();
        if !named || !p.eat(COMMA) {
            break;
        }
    }
    p.finish();
}

fn over_item(p: &mut Parser<'_>) -> bool {
    match p.current() {
        FUNCTION_ID => {
            p.bump();
            if p.eat(L_PAREN) {
                if !p.at(R_PAREN) {
                    domain::domain(p);
                }
                p.expect(R_PAREN, "behind the domain of the function");
            }
        }
        DOMAIN_ID | ENUM_ID | RULE_ID => p.bump(),
        _ => {
            let found = p.missing();
            p.fault(fault::expected_name(found, FUNCTION_ID));
            return false;
        }
    }
    true
}

/// `CTLSPEC [ctlSpec_x:] t`, `LTLSPEC [ltlSpec_x:] t`
pub(super) fn temporal(p: &mut Parser<'_>, kind: SyntaxKind, class: SyntaxKind) {
    p.start(kind);
    p.bump();
    if p.at(class) || p.peek(1) == COLON {
        name::name(p, class);
        p.expect(COLON, "behind the name of the property");
    }
    term::term(p, "a formula");
    p.finish();
}
