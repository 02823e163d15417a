//! Domains, and their declarations in the signature (spec/language.md, section 3).
//!
//! In: the cursor at a domain or a declaration. Out: a NAMED_DOMAIN or STRUCTURED_DOMAIN, or one of the declarations.
//! To the lexer, a domain in capitals only is an enum literal. It is taken as a domain here, and a later stage reports
//! what is wrong with it. The number of domains in a structured one is checked here.
//! CIRCLE(grammar)

use super::{list, name, recovery, term};
use crate::SyntaxKind::{self, *};
use crate::fault;
use crate::parser::Parser;

/// A domain as it is written where one is expected.
pub(super) fn domain(p: &mut Parser<'_>) -> bool {
    match p.current() {
        DOMAIN_ID | ENUM_ID => {
            p.start(NAMED_DOMAIN);
            p.bump();
            p.finish();
        }
        PROD_KW | SEQ_DOMAIN_KW | POWERSET_KW | BAG_KW | MAP_KW | RULE_DOMAIN_KW => structured(p),
        FUNCTION_ID | RULE_ID | GENERIC_ID | COMPLEX if !p.on_new_line() => {
            p.start(NAMED_DOMAIN);
            name::name(p, DOMAIN_ID);
            p.finish();
        }
        _ => {
            let found = p.missing();
            p.fault(fault::expected_domain(found));
            return false;
        }
    }
    true
}

/// `Prod(D, E)`, `Seq(D)` …
fn structured(p: &mut Parser<'_>) {
    if !p.enter() {
        recovery::too_deep(p);
        return;
    }
    p.start(STRUCTURED_DOMAIN);
    let found = p.found();
    let constructor = p.current();
    p.bump();
    if p.at(L_PAREN) {
        let count = list::list(p, R_PAREN, list::Empty::Allowed, domain);
        let right = match constructor {
            PROD_KW => count >= 2,
            MAP_KW => count == 2,
            RULE_DOMAIN_KW => count >= 1,
            _ => count == 1,
        };
        if !right {
            p.fault_before(fault::domain_arity(found, count));
        }
    } else if constructor != RULE_DOMAIN_KW {
        p.expect(L_PAREN, "behind the constructor of a domain");
    }
    p.finish();
    p.leave();
}

/// A declaration of a domain; `false` if the cursor is not at one.
pub(super) fn declaration(p: &mut Parser<'_>) -> bool {
    let behind = if p.at(DYNAMIC_KW) { p.peek(1) } else { p.current() };
    match behind {
        ANYDOMAIN_KW => simple(p, ANY_DOMAIN_DECL),
        BASIC_KW => simple(p, BASIC_DOMAIN_DECL),
        ABSTRACT_KW => simple(p, ABSTRACT_DOMAIN_DECL),
        ENUM_KW => enumeration(p),
        DOMAIN_KW => concrete(p),
        PROD_KW | SEQ_DOMAIN_KW | POWERSET_KW | BAG_KW | MAP_KW | RULE_DOMAIN_KW if !p.at(DYNAMIC_KW) => {
            p.start(STRUCTURED_DOMAIN_DECL);
            domain(p);
            p.finish();
        }
        _ => return false,
    }
    true
}

/// `anydomain D`, `basic domain D`, `[dynamic] abstract domain D`
fn simple(p: &mut Parser<'_>, kind: SyntaxKind) {
    p.start(kind);
    p.eat(DYNAMIC_KW);
    let anydomain = p.at(ANYDOMAIN_KW);
    p.bump();
    if anydomain || p.expect(DOMAIN_KW, "in the declaration of a domain") || p.at(DOMAIN_ID) {
        name::domain_name(p);
    }
    p.finish();
}

/// `enum domain D = {AA | BB}`
fn enumeration(p: &mut Parser<'_>) {
    p.start(ENUM_DOMAIN_DECL);
    p.eat(DYNAMIC_KW);
    p.bump();
    if (p.expect(DOMAIN_KW, "behind `enum`") || p.at(DOMAIN_ID))
        && name::domain_name(p)
        && p.expect(EQ, "behind the name of an enum domain")
    {
        if p.at(L_BRACE) {
            p.bump_opener(R_BRACE);
            literals(p);
            recovery::end(p);
        } else {
            p.expect(L_BRACE, "before the literals of an enum domain");
        }
    }
    p.finish();
}

fn literals(p: &mut Parser<'_>) {
    loop {
        p.start(ENUM_LITERAL_DECL);
        let named = name::name(p, ENUM_ID);
        p.finish();
        if !p.eat(BAR) && !p.eat(COMMA) {
            let forgotten = named && p.at_any(name::NAMES);
            if !forgotten {
                return;
            }
            let found = p.found();
            p.fault(fault::expected_token(found, BAR, "between two enum literals"));
        }
    }
}

/// `[dynamic] domain D subsetof E`
fn concrete(p: &mut Parser<'_>) {
    p.start(CONCRETE_DOMAIN_DECL);
    p.eat(DYNAMIC_KW);
    p.bump();
    if name::domain_name(p) {
        if p.at(EQ) {
            let found = p.found();
            p.fault(fault::contents_in_signature(found));
            p.start(ERROR);
            p.bump();
            term::term(p, "the elements of the domain");
            p.finish();
        } else if p.expect(SUBSETOF_KW, "behind the name of a concrete domain") {
            domain(p);
        }
    }
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
            "asm a signature: anydomain D basic domain Integer abstract domain A dynamic abstract domain B enum domain C = {AA | BB, CC} domain E subsetof Prod(A, Seq(B)) dynamic domain F subsetof Integer Map(A, B) definitions:",
            expect![[r#"
            MACHINE_NAME(asm a)
            SIGNATURE(
              signature
              :
              ANY_DOMAIN(anydomain D)
              BASIC_DOMAIN(basic domain Integer)
              ABSTRACT_DOMAIN(abstract domain A)
              ABSTRACT_DOMAIN(dynamic abstract domain B)
              ENUM_DOMAIN(
                enum
                domain
                C
                =
                {
                ENUM_LITERAL(AA)
                |
                ENUM_LITERAL(BB)
                ,
                ENUM_LITERAL(CC)
                })
              CONCRETE_DOMAIN(
                domain
                E
                subsetof
                STRUCTURED(Prod ( A , STRUCTURED(Seq ( B )) )))
              CONCRETE_DOMAIN(dynamic domain F subsetof Integer)
              STRUCTURED_DOMAIN(STRUCTURED(Map ( A , B ))))
            DEFINITIONS(definitions :)"#]],
        );
    }

    #[test]
    fn all_capitals() {
        check(
            "asm a signature: abstract domain CPU controlled f: CPU -> Seq(CPU) definitions: domain CPU = {1}",
            expect![[r#"
            MACHINE_NAME(asm a)
            SIGNATURE(
              signature
              :
              ABSTRACT_DOMAIN(abstract domain CPU)
              FUNCTION(controlled f : CPU -> STRUCTURED(Seq ( CPU ))))
            DEFINITIONS(definitions : DOMAIN_DEF(domain CPU = COLLECTION({ 1 })))"#]],
        );
    }

    #[test]
    fn faults() {
        check(
            "asm a signature: enum domain C = {A1 | Red_x | RED x YY} definitions:",
            expect![[r#"
            MACHINE_NAME(asm a)
            SIGNATURE(
              signature
              :
              ENUM_DOMAIN(
                enum
                domain
                C
                =
                {
                ENUM_LITERAL(A1)
                |
                ENUM_LITERAL(Red_x)
                |
                ENUM_LITERAL(RED)
                ENUM_LITERAL(x)
                ENUM_LITERAL(YY)
                }))
            DEFINITIONS(definitions :)
            !name-class
            !name-class
            !expected-token
            !expected-token"#]],
        );
        check(
            "asm a signature: domain d subsetof definitions:",
            expect![[r#"
            MACHINE_NAME(asm a)
            SIGNATURE(signature : CONCRETE_DOMAIN(domain d subsetof))
            DEFINITIONS(definitions :)
            !name-class
            !expected-domain"#]],
        );
        check(
            "asm a signature: controlled f: Prod(A) controlled g: Map(A) controlled h: Seq(A, B) controlled k: Bag definitions:",
            expect![[r#"
            MACHINE_NAME(asm a)
            SIGNATURE(
              signature
              :
              FUNCTION(controlled f : STRUCTURED(Prod ( A )))
              FUNCTION(controlled g : STRUCTURED(Map ( A )))
              FUNCTION(controlled h : STRUCTURED(Seq ( A , B )))
              FUNCTION(controlled k : STRUCTURED(Bag)))
            DEFINITIONS(definitions :)
            !domain-arity
            !domain-arity
            !domain-arity
            !expected-token"#]],
        );
        check(
            "asm a signature: domain D = {1} definitions:",
            expect![[r#"
                MACHINE_NAME(asm a)
                SIGNATURE(
                  signature
                  :
                  CONCRETE_DOMAIN(domain D ERROR(= COLLECTION({ 1 }))))
                DEFINITIONS(definitions :)
                !expected-token"#]],
        );
        check(
            "asm a signature: enum C = {AA} enum domain D = AA definitions:",
            expect![[r#"
            MACHINE_NAME(asm a)
            SIGNATURE(
              signature
              :
              ENUM_DOMAIN(enum C = { ENUM_LITERAL(AA) })
              ENUM_DOMAIN(enum domain D =)
              ERROR(AA))
            DEFINITIONS(definitions :)
            !expected-token
            !expected-token"#]],
        );
        check(
            "asm a signature: dynamic Seq(A) definitions:",
            expect![[r#"
            MACHINE_NAME(asm a)
            SIGNATURE(signature : ERROR(dynamic Seq ( A )))
            DEFINITIONS(definitions :)
            !expected-definition"#]],
        );
    }
}
