//! `let`, and variables that range over a collection (spec/language.md, 6.2 and 7).
//!
//! In: the cursor at `let` or at the first variable. Out: a LET_TERM or LET_RULE with BINDINGs, or BINDERs. `in` after
//! a binding is the membership operator, unless the bindings lack their closing parenthesis.
//! CIRCLE(grammar)

use super::conditional::{self, Body};
use super::term::{inside, term};
use super::{list, name, recovery};
use crate::SyntaxKind::{self, *};
use crate::parser::{Parser, Within};

/// `$x in D, $y in E`
pub(super) fn binders(p: &mut Parser<'_>) {
    loop {
        p.start(BINDER);
        let named = name::name(p, VARIABLE);
        if named && p.expect(IN_KW, "behind the variable") {
            term(p, "the range of the variable");
        }
        p.finish();
        if !p.eat(COMMA) {
            return;
        }
    }
}

/// `let ($x = a, $y = b) in t endlet`
pub(super) fn let_term(p: &mut Parser<'_>) {
    let_construct(p, LET_TERM, conditional::TERM);
}

/// A `let` with a body that is a term or a rule.
pub(super) fn let_construct(p: &mut Parser<'_>, kind: SyntaxKind, body: Body) {
    p.start(kind);
    p.bump_opener(ENDLET_KW);
    if p.at(L_PAREN) {
        list::list(p, R_PAREN, list::Empty::Forbidden, binding);
    } else {
        p.expect(L_PAREN, "behind `let`");
        if p.at(VARIABLE) {
            binding(p);
        }
    }
    body.behind(p, IN_KW, "behind the bindings of `let`", "what to do or give behind `in`");
    recovery::end(p);
    p.finish();
}

fn binding(p: &mut Parser<'_>) -> bool {
    p.start(BINDING);
    let named = name::name(p, VARIABLE);
    if named && p.expect(EQ, "behind the variable of `let`") {
        inside(p, Within::Bindings, |p| term(p, "the value of the variable"));
    }
    p.finish();
    named
}

#[cfg(test)]
mod tests {
    use crate::grammar::brief::term;
    use expect_test::{Expect, expect};

    fn check(text: &str, expected: Expect) {
        expected.assert_eq(&term(text));
    }

    #[test]
    fn let_terms() {
        check("let ($x = 1) in $x endlet", expect!["LET(let ( BINDING($x = 1) ) in $x endlet)"]);
        check(
            "let ($x = 1, $y = $x in S) in $y in T endlet",
            expect![[r#"
            LET(
              let
              (
              BINDING($x = 1)
              ,
              BINDING($y = BINARY($x in DOMAIN(S)))
              )
              in
              BINARY($y in DOMAIN(T))
              endlet)"#]],
        );
    }

    #[test]
    fn faults() {
        check("let $x = 1 in $x endlet", expect!["LET(let BINDING($x = 1) in $x endlet) !expected-token"]);
        check("let ($x = 1 in\n$x endlet", expect!["LET(let ( BINDING($x = 1) in $x endlet) !missing-end"]);
        check("let (x = 1) in x endlet", expect!["LET(let ( BINDING(x = 1) ) in x endlet) !name-class"]);
        check("let ($x 1) in $x endlet", expect!["LET(let ( BINDING($x) ERROR(1) ) in $x endlet) !expected-token"]);
        check("let ($x = 1) in $x", expect!["LET(let ( BINDING($x = 1) ) in $x) !missing-end"]);
        check("(forall x in D with c)", expect!["QUANTIFIED(( forall BINDER(x in DOMAIN(D)) with c )) !name-class"]);
        check("(exists $x D)", expect!["QUANTIFIED(( exists BINDER($x) ERROR(D) )) !expected-token"]);
    }
}
