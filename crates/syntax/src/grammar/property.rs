//! Invariants, temporal properties and assumptions (spec/language.md, section 5).
//!
//! In: the cursor at the word that starts one. Out: INVARIANT, CTL_SPEC, LTL_SPEC, INVAR, JUSTICE or COMPASSION. The
//! operators of temporal logic are functions of a library, so nothing here knows them.
//! CIRCLE(grammar)

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

/// `COMPASSION (p, q)`; the peer accepts it only without the closing parenthesis.
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
    if p.at(INVARIANT_ID) || matches!(p.peek(1), OVER_KW | COLON) {
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

#[cfg(test)]
mod tests {
    use crate::grammar::brief::file;
    use expect_test::{Expect, expect};

    fn check(text: &str, expected: Expect) {
        expected.assert_eq(&file(text));
    }

    #[test]
    fn properties() {
        check(
            "asm a signature: definitions: INVAR a justice b JUSTICE c COMPASSION (p, q) compassion (p, q invariant over f: a invariant inv_a over f(D), g(), B, r_x, CPU: b CTLSPEC ag(a) ctlspec ctlSpec_x: ef(b) LTLSPEC ltlSpec_y: g(a)",
            expect![[r#"
            MACHINE_NAME(asm a)
            SIGNATURE(signature :)
            DEFINITIONS(
              definitions
              :
              INVAR(INVAR a)
              JUSTICE(justice b)
              JUSTICE(JUSTICE c)
              COMPASSION(COMPASSION ( p , q ))
              COMPASSION(compassion ( p , q)
              INVARIANT(invariant over OVER_LIST(OVER_ITEM(f)) : a)
              INVARIANT(
                invariant
                inv_a
                over
                OVER_LIST(
                  OVER_ITEM(f ( D ))
                  ,
                  OVER_ITEM(g ( ))
                  ,
                  OVER_ITEM(B)
                  ,
                  OVER_ITEM(r_x)
                  ,
                  OVER_ITEM(CPU))
                :
                b)
              CTL_SPEC(CTLSPEC FUNCTION(ag ARGUMENT_LIST(( a ))))
              CTL_SPEC(ctlspec ctlSpec_x : FUNCTION(ef ARGUMENT_LIST(( b ))))
              LTL_SPEC(LTLSPEC ltlSpec_y : FUNCTION(g ARGUMENT_LIST(( a )))))"#]],
        );
    }

    #[test]
    fn faults() {
        check(
            "asm a signature: definitions: invariant: a invariant a over b: c invariant over : a CTLSPEC foo: a invariant inv_x over a b COMPASSION p",
            expect![[r#"
                MACHINE_NAME(asm a)
                SIGNATURE(signature :)
                DEFINITIONS(
                  definitions
                  :
                  INVARIANT(invariant : a)
                  INVARIANT(invariant a over OVER_LIST(OVER_ITEM(b)) : c)
                  INVARIANT(invariant over : a)
                  CTL_SPEC(CTLSPEC foo : a)
                  INVARIANT(invariant inv_x over OVER_LIST(OVER_ITEM(a)))
                  ERROR(b)
                  COMPASSION(COMPASSION)
                  ERROR(p))
                !expected-token
                !name-class
                !keyword-as-name"#]],
        );
    }
}
