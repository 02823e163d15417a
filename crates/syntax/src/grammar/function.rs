//! Declarations and definitions of functions (spec/language.md, sections 4 and 5).

use super::{domain, list, name, term};
use crate::SyntaxKind::*;
use crate::parser::Parser;
use crate::token_set::TokenSet;

/// Words that a function's declaration starts with.
pub(super) const KINDS: TokenSet =
    TokenSet::new(&[STATIC_KW, DERIVED_KW, MONITORED_KW, CONTROLLED_KW, SHARED_KW, OUT_KW]);

/// `[dynamic] controlled f: D -> C`; `false` when the cursor is at none.
pub(super) fn declaration(p: &mut Parser<'_>) -> bool {
    let behind = if p.at(DYNAMIC_KW) { p.peek(1) } else { p.current() };
    if !KINDS.contains(behind) {
        return false;
    }
    p.start(FUNCTION_DECL);
    p.eat(DYNAMIC_KW);
    p.bump();
    name_and_domains(p);
    p.finish();
    true
}

/// `f: D -> C`
pub(super) fn name_and_domains(p: &mut Parser<'_>) {
    if name::name(p, FUNCTION_ID)
        && p.expect(COLON, "behind the name of a function")
        && domain::domain(p)
        && p.eat(ARROW)
    {
        domain::domain(p);
    }
}

/// `function f($x in D) = t`
pub(super) fn definition(p: &mut Parser<'_>) {
    p.start(FUNCTION_DEF);
    p.bump();
    if name::name(p, FUNCTION_ID) {
        parameters(p);
        if p.expect(EQ, "before the defining term") || p.at_any(term::STARTS) && !p.on_new_line() {
            term::term(p, "the defining term");
        }
    }
    p.finish();
}

/// `domain D = t`
pub(super) fn domain_definition(p: &mut Parser<'_>) {
    p.start(DOMAIN_DEF);
    p.bump();
    if name::domain_name(p) && p.expect(EQ, "before the elements of the domain") {
        term::term(p, "the elements of the domain");
    }
    p.finish();
}

/// `($x in D, $y in E)`, if it is there.
pub(super) fn parameters(p: &mut Parser<'_>) {
    if !p.at(L_PAREN) {
        return;
    }
    p.start(PARAMETER_LIST);
    list::list(p, R_PAREN, list::Empty::Allowed, |p| {
        p.start(PARAMETER);
        let named = name::name(p, VARIABLE);
        if named && p.expect(IN_KW, "behind the parameter") {
            domain::domain(p);
        }
        p.finish();
        named
    });
    p.finish();
}
