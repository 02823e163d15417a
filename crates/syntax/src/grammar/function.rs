//! Declarations and definitions of functions, and definitions of domains (spec/language.md, sections 4 and 5).
//!
//! In: the cursor at the word that starts one. Out: FUNCTION_DECL, FUNCTION_DEF, DOMAIN_DEF, PARAMETER_LIST. Initial
//! states use the same definitions.
//! CIRCLE(grammar)

use super::sets::{DOMAIN_STARTS, TERM_STARTS};
use super::{domain, list, name, recovery, term};
use crate::SyntaxKind::*;
use crate::fault;
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
        && (p.expect(COLON, "behind the name of a function") || p.at_any(DOMAIN_STARTS))
        && domain::domain(p)
    {
        recovery::product_of_domains(p);
        if p.eat(ARROW) {
            domain::domain(p);
            recovery::product_of_domains(p);
        }
    }
}

/// `function f($x in D) = t`
pub(super) fn definition(p: &mut Parser<'_>) {
    p.start(FUNCTION_DEF);
    p.bump();
    if name::name(p, FUNCTION_ID) {
        parameters(p);
        if equals(p, "before the defining term") || p.at_any(TERM_STARTS) && !p.on_new_line() {
            term::term(p, "the defining term");
        }
    }
    p.finish();
}

/// `domain D = t`
pub(super) fn domain_definition(p: &mut Parser<'_>) {
    p.start(DOMAIN_DEF);
    p.bump();
    if name::domain_name(p) {
        if p.at(SUBSETOF_KW) {
            let found = p.found();
            p.fault(fault::declaration_of_domain(found));
            p.start(ERROR);
            p.bump();
            domain::domain(p);
            p.finish();
        } else if equals(p, "before the elements of the domain") {
            term::term(p, "the elements of the domain");
        }
    }
    p.finish();
}

/// The `=` of a definition.
fn equals(p: &mut Parser<'_>, context: &str) -> bool {
    if p.at(ASSIGN) {
        let found = p.found();
        p.fault(fault::assign_in_definition(found));
        p.bump();
        return true;
    }
    p.expect(EQ, context)
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

#[cfg(test)]
mod tests {
    use crate::grammar::brief::file;
    use expect_test::{Expect, expect};

    fn check(text: &str, expected: Expect) {
        expected.assert_eq(&file(text));
    }

    #[test]
    fn declarations() {
        check(
            "asm a signature: static f: A derived g: A -> B dynamic monitored h: Prod(A, B) -> C controlled k: A shared l: A out m: A definitions:",
            expect![[r#"
            MACHINE_NAME(asm a)
            SIGNATURE(
              signature
              :
              FUNCTION(static f : A)
              FUNCTION(derived g : A -> B)
              FUNCTION(dynamic monitored h : STRUCTURED(Prod ( A , B )) -> C)
              FUNCTION(controlled k : A)
              FUNCTION(shared l : A)
              FUNCTION(out m : A))
            DEFINITIONS(definitions :)"#]],
        );
    }

    #[test]
    fn definitions() {
        check(
            "asm a signature: definitions: function f = 1 function g($x in A, $y in Prod(B, C)) = $x domain D = {1, 2}",
            expect![[r#"
            MACHINE_NAME(asm a)
            SIGNATURE(signature :)
            DEFINITIONS(
              definitions
              :
              FUNCTION_DEF(function f = 1)
              FUNCTION_DEF(
                function
                g
                PARAMETER_LIST(
                  (
                  PARAMETER($x in A)
                  ,
                  PARAMETER($y in STRUCTURED(Prod ( B , C )))
                  ))
                =
                $x)
              DOMAIN_DEF(domain D = COLLECTION({ 1 , 2 })))"#]],
        );
    }

    #[test]
    fn faults() {
        check(
            "asm a signature: static F: A static r_a: A static out: A static g A static h: A -> static definitions:",
            expect![[r#"
                MACHINE_NAME(asm a)
                SIGNATURE(
                  signature
                  :
                  FUNCTION(static F : A)
                  FUNCTION(static r_a : A)
                  FUNCTION(static out : A)
                  FUNCTION(static g A)
                  FUNCTION(static h : A ->)
                  static)
                DEFINITIONS(definitions :)
                !name-class
                !name-class
                !keyword-as-name
                !expected-token
                !expected-domain
                !expected-name"#]],
        );
        check(
            "asm a signature: definitions: function f 1 function g = function h(x in A) = 1 function i = 1 function k = 1;",
            expect![[r#"
            MACHINE_NAME(asm a)
            SIGNATURE(signature :)
            DEFINITIONS(
              definitions
              :
              FUNCTION_DEF(function f 1)
              FUNCTION_DEF(function g =)
              FUNCTION_DEF(function h PARAMETER_LIST(( PARAMETER(x in A) )) = 1)
              FUNCTION_DEF(function i = 1)
              FUNCTION_DEF(function k = 1)
              ERROR(;))
            !expected-token
            !expected-term
            !name-class
            !name-class
            !unexpected-text"#]],
        );
    }
}
