//! Rules and their declarations (spec/language.md, sections 5 and 7).
//!
//! In: the cursor at a rule. Out: one of the rule nodes. A rule that starts with a function or a variable is first read
//! as a location. The token after it shows whether it is an update, a return or a rule value.
//! CIRCLE(grammar)

use super::conditional::Body;
use super::recovery;
use super::sets::RULE_STARTS;
use super::term::{delimited, location, term};
use super::{binding, conditional, domain, function, list, name, operator};
use crate::SyntaxKind::{self, *};
use crate::fault;
use crate::parser::Parser;

/// `[macro | turbo] rule r_x($p in D) [in C] = R`
pub(super) fn declaration(p: &mut Parser<'_>) {
    p.start(RULE_DECL);
    let opener = p.found();
    if !p.eat(MACRO_KW) {
        p.eat(TURBO_KW);
    }
    if p.expect(RULE_KW, "in the declaration of a rule") && name::name(p, RULE_ID) {
        function::parameters(p);
        if p.eat(IN_KW) {
            domain::domain(p);
        }
        behind(p, EQ, "before the body of the rule", "the body of the rule");
        recovery::several_bodies(p, opener);
    }
    p.finish();
}

/// A rule.
pub(super) fn rule(p: &mut Parser<'_>, wanted: &str) -> bool {
    if !p.enter() {
        return recovery::too_deep(p);
    }
    let found = rule_here(p, wanted);
    recovery::behind_rule(p);
    p.leave();
    found
}

fn rule_here(p: &mut Parser<'_>, wanted: &str) -> bool {
    match p.current() {
        SKIP_KW => {
            p.start(SKIP_RULE);
            p.bump();
            p.finish();
        }
        PAR_KW => block(p, PAR_RULE, ENDPAR_KW),
        SEQ_KW => block(p, SEQ_RULE, ENDSEQ_KW),
        ITERATE_KW => iterate(p),
        IF_KW => conditional::if_construct(p, IF_RULE, BRANCH),
        SWITCH_KW => conditional::switch_construct(p, SWITCH_RULE, BRANCH),
        LET_KW => binding::let_construct(p, LET_RULE, BRANCH),
        CHOOSE_KW => ranging(p, CHOOSE_RULE),
        FORALL_KW => ranging(p, FORALL_RULE),
        EXTEND_KW => extend(p),
        WHILE_KW => repeat(p, WHILE_RULE),
        WHILEREC_KW => repeat(p, RECURSIVE_WHILE_RULE),
        LOCAL_KW => local(p),
        DYNAMIC_KW if p.peek(1) == LOCAL_KW => local(p),
        RULE_ID => call(p),
        FUNCTION_ID | VARIABLE => update(p),
        L_PAREN | L_BRACE => recovery::bracketed_rule(p),
        ENUM_ID | DOMAIN_ID | GENERIC_ID if p.peek(1) == ASSIGN => update(p),
        _ => return recovery::no_rule(p, wanted),
    }
    true
}

/// The rule of a branch; an end mark follows it.
const BRANCH: Body = Body {
    parse: |p, wanted| {
        rule(p, wanted);
        recovery::several_rules(p);
    },
    starts: |p| starts(p) || p.at(L_BRACE),
};

/// The rule after a keyword or mark. If that is missing, a rule that stands there is read all the same.
fn behind(p: &mut Parser<'_>, keyword: SyntaxKind, context: &str, wanted: &str) {
    if p.expect(keyword, context) || starts(p) {
        rule(p, wanted);
    }
}

/// `iterate R enditerate`
fn iterate(p: &mut Parser<'_>) {
    p.start(ITERATE_RULE);
    p.bump_opener(ENDITERATE_KW);
    (BRANCH.parse)(p, "the rule that is iterated");
    recovery::end(p);
    p.finish();
}

/// `par R S endpar`, `seq R S endseq`
fn block(p: &mut Parser<'_>, kind: SyntaxKind, end: SyntaxKind) {
    p.start(kind);
    p.bump_opener(end);
    if p.at(end) {
        let found = p.missing();
        p.fault(fault::expected_rule(found, "a rule"));
    }
    while recovery::more_rules(p, end) {
        rule(p, "a rule");
    }
    recovery::end(p);
    p.finish();
}

/// `choose $x in D with c do R ifnone S`, `forall $x in D with c do R`
fn ranging(p: &mut Parser<'_>, kind: SyntaxKind) {
    p.start(kind);
    p.bump();
    binding::binders(p);
    if p.eat(WITH_KW) {
        delimited(p, "a condition");
    }
    behind(p, DO_KW, "before the rule", "the rule behind `do`");
    if kind == CHOOSE_RULE && p.eat(IFNONE_KW) {
        rule(p, "the rule behind `ifnone`");
    }
    p.finish();
}

/// `extend D with $x, $y do R`
fn extend(p: &mut Parser<'_>) {
    p.start(EXTEND_RULE);
    p.bump();
    let named = name::domain_name(p);
    if (named || p.at(WITH_KW)) && p.expect(WITH_KW, "behind the domain that is extended") {
        while name::name(p, VARIABLE) && p.eat(COMMA) {}
        behind(p, DO_KW, "before the rule", "the rule behind `do`");
    }
    p.finish();
}

/// `while c do R`, `whilerec c do R`
fn repeat(p: &mut Parser<'_>, kind: SyntaxKind) {
    p.start(kind);
    p.bump();
    delimited(p, "a condition");
    behind(p, DO_KW, "behind the condition", "the rule behind `do`");
    p.finish();
}

/// `local f: D -> C [R] … S`
fn local(p: &mut Parser<'_>) {
    p.start(LOCAL_RULE);
    while p.at(LOCAL_KW) || p.at(DYNAMIC_KW) && p.peek(1) == LOCAL_KW {
        p.start(LOCAL_DECL);
        p.eat(DYNAMIC_KW);
        p.bump();
        function::name_and_domains(p);
        if p.at(L_BRACKET) {
            p.bump_opener(R_BRACKET);
            rule(p, "the rule that initialises the local function");
            recovery::end(p);
        } else {
            p.expect(L_BRACKET, "before the rule that initialises the local function");
        }
        p.finish();
    }
    rule(p, "the rule that the functions are local to");
    p.finish();
}

/// `r_x[a, b]`, `r_x(a, b)`
pub(super) fn call(p: &mut Parser<'_>) {
    let kind = if p.peek(1) == L_PAREN { TURBO_CALL_RULE } else { MACRO_CALL_RULE };
    p.start(kind);
    let found = p.found();
    p.bump();
    match p.current() {
        L_PAREN => arguments(p, R_PAREN),
        L_BRACKET => arguments(p, R_BRACKET),
        ASSIGN | EQ => {
            p.fault_before(fault::no_location(found));
            p.bump();
            term(p, "the new value");
        }
        _ => p.fault_before(fault::missing_brackets(found)),
    }
    p.finish();
}

fn arguments(p: &mut Parser<'_>, close: SyntaxKind) {
    p.start(ARGUMENT_LIST);
    list::list(p, close, list::Empty::Allowed, |p| delimited(p, "an argument"));
    p.finish();
}

/// `f(a) := b`, `f(a) <- r_x(b)`, `f(a)`, `$r[a]`
fn update(p: &mut Parser<'_>) {
    let checkpoint = p.checkpoint();
    if matches!(p.current(), ENUM_ID | DOMAIN_ID | GENERIC_ID) {
        let found = p.found();
        p.fault(fault::no_location(found));
        p.start(FUNCTION_TERM);
        p.bump();
        p.finish();
    } else {
        location(p);
    }
    let kind = match p.current() {
        ASSIGN => {
            p.bump();
            term(p, "the new value");
            UPDATE_RULE
        }
        EQ => {
            let found = p.found();
            p.fault(fault::equals_for_assign(found));
            p.bump();
            term(p, "the new value");
            UPDATE_RULE
        }
        LT if operator::at_return_arrow(p) => {
            p.bump_joined(RETURN_ARROW);
            if p.at(RULE_ID) && p.peek(1) == L_PAREN {
                call(p);
            } else {
                recovery::no_turbo_call(p);
            }
            RETURN_RULE
        }
        L_BRACKET => {
            arguments(p, R_BRACKET);
            TERM_RULE
        }
        _ => {
            recovery::term_as_rule(p);
            TERM_RULE
        }
    };
    p.start_at(checkpoint, kind);
    p.finish();
}

/// The cursor is at a rule.
pub(super) fn starts(p: &Parser<'_>) -> bool {
    match p.current() {
        DYNAMIC_KW => p.peek(1) == LOCAL_KW,
        FUNCTION_ID => !operator::is_infix_word(p) && !conditional::at_foreign_elseif(p),
        kind => RULE_STARTS.contains(kind),
    }
}

#[cfg(test)]
mod tests {
    use crate::grammar::brief::rule;
    use expect_test::{Expect, expect};

    fn check(text: &str, expected: Expect) {
        expected.assert_eq(&rule(text));
    }

    #[test]
    fn rules() {
        check("skip", expect!["SKIP(skip)"]);
        check("x := 1", expect!["UPDATE(x := 1)"]);
        check("f($x, 1) := $y", expect!["UPDATE(FUNCTION(f ARGUMENT_LIST(( $x , 1 ))) := $y)"]);
        check("$x := 1", expect!["UPDATE($x := 1)"]);
        check("r_a[]", expect!["MACRO_CALL(r_a ARGUMENT_LIST([ ]))"]);
        check("r_a[1, x]", expect!["MACRO_CALL(r_a ARGUMENT_LIST([ 1 , x ]))"]);
        check("r_a()", expect!["TURBO_CALL(r_a ARGUMENT_LIST(( )))"]);
        check("r_a(1)", expect!["TURBO_CALL(r_a ARGUMENT_LIST(( 1 )))"]);
        check("x <- r_a(1)", expect!["RETURN(x <- TURBO_CALL(r_a ARGUMENT_LIST(( 1 ))))"]);
        check(
            "f(1) <- r_a()",
            expect![[r#"
            RETURN(
              FUNCTION(f ARGUMENT_LIST(( 1 )))
              <-
              TURBO_CALL(r_a ARGUMENT_LIST(( ))))"#]],
        );
        check("program(self)", expect!["TERM(FUNCTION(program ARGUMENT_LIST(( self ))))"]);
        check("$r[1, 2]", expect!["TERM($r ARGUMENT_LIST([ 1 , 2 ]))"]);
        check("f(x)[]", expect!["TERM(FUNCTION(f ARGUMENT_LIST(( x ))) ARGUMENT_LIST([ ]))"]);
        check("x", expect!["TERM(x)"]);
        check("par skip skip endpar", expect!["PAR(par SKIP(skip) SKIP(skip) endpar)"]);
        check("seq x := 1 y := 2 endseq", expect!["SEQ(seq UPDATE(x := 1) UPDATE(y := 2) endseq)"]);
        check("iterate skip enditerate", expect!["ITERATE(iterate SKIP(skip) enditerate)"]);
        check("while a do skip", expect!["WHILE(while a do SKIP(skip))"]);
        check("whilerec a do x := 1", expect!["RECURSIVE_WHILE(whilerec a do UPDATE(x := 1))"]);
        check("extend D with $x, $y do skip", expect!["EXTEND(extend D with $x , $y do SKIP(skip))"]);
        check("let ($x = 1) in x := $x endlet", expect!["LET(let ( BINDING($x = 1) ) in UPDATE(x := $x) endlet)"]);
        check(
            "local f: Integer [f := 1] dynamic local g: A -> B [skip] x := f",
            expect![[r#"
            LOCAL(
              LOCAL(local f : Integer [ UPDATE(f := 1) ])
              LOCAL(dynamic local g : A -> B [ SKIP(skip) ])
              UPDATE(x := f))"#]],
        );
    }

    #[test]
    fn branches() {
        check("if a then skip endif", expect!["IF(if CONDITIONAL_BRANCH(a then SKIP(skip)) endif)"]);
        check(
            "if a then skip else x := 1 endif",
            expect!["IF(if CONDITIONAL_BRANCH(a then SKIP(skip)) else UPDATE(x := 1) endif)"],
        );
        check(
            "if a then skip elseif b then skip else skip endif",
            expect![[r#"
            IF(
              if
              CONDITIONAL_BRANCH(a then SKIP(skip))
              elseif
              CONDITIONAL_BRANCH(b then SKIP(skip))
              else
              SKIP(skip)
              endif)"#]],
        );
        check(
            "switch x case 1: skip case 2: x := 1 otherwise skip endswitch",
            expect![[r#"
            SWITCH(
              switch
              x
              CASE_BRANCH(case 1 : SKIP(skip))
              CASE_BRANCH(case 2 : UPDATE(x := 1))
              otherwise
              SKIP(skip)
              endswitch)"#]],
        );
        check(
            "if a then if b then skip else skip endif else skip endif",
            expect![[r#"
            IF(
              if
              CONDITIONAL_BRANCH(
                a
                then
                IF(if CONDITIONAL_BRANCH(b then SKIP(skip)) else SKIP(skip) endif))
              else
              SKIP(skip)
              endif)"#]],
        );
    }

    #[test]
    fn variables() {
        check("choose $x in D do skip", expect!["CHOOSE(choose BINDER($x in DOMAIN(D)) do SKIP(skip))"]);
        check(
            "choose $x in D, $y in E with $x > $y do skip ifnone skip",
            expect![[r#"
            CHOOSE(
              choose
              BINDER($x in DOMAIN(D))
              ,
              BINDER($y in DOMAIN(E))
              with
              BINARY($x > $y)
              do
              SKIP(skip)
              ifnone
              SKIP(skip))"#]],
        );
        check(
            "choose $x in D do choose $y in E do skip ifnone skip",
            expect![[r#"
            CHOOSE(
              choose
              BINDER($x in DOMAIN(D))
              do
              CHOOSE(
                choose
                BINDER($y in DOMAIN(E))
                do
                SKIP(skip)
                ifnone
                SKIP(skip)))"#]],
        );
        check("forall $x in D do skip", expect!["FORALL(forall BINDER($x in DOMAIN(D)) do SKIP(skip))"]);
        check(
            "forall $x in {1:3} with $x in S do x := $x",
            expect![[r#"
            FORALL(
              forall
              BINDER($x in RANGE({ 1 : 3 }))
              with
              BINARY($x in DOMAIN(S))
              do
              UPDATE(x := $x))"#]],
        );
    }

    #[test]
    fn neighbours() {
        check(
            "par x := a f(1) := 2 endpar",
            expect![[r#"
            PAR(
              par
              UPDATE(x := a)
              UPDATE(FUNCTION(f ARGUMENT_LIST(( 1 ))) := 2)
              endpar)"#]],
        );
        check(
            "par x := a r_a[] $r[1] endpar",
            expect![[r#"
            PAR(
              par
              UPDATE(x := a)
              MACRO_CALL(r_a ARGUMENT_LIST([ ]))
              TERM($r ARGUMENT_LIST([ 1 ]))
              endpar)"#]],
        );
        check(
            "seq x := <1> y := [1] endseq",
            expect![[r#"
            SEQ(
              seq
              UPDATE(x := COLLECTION(< 1 >))
              UPDATE(y := COLLECTION([ 1 ]))
              endseq)"#]],
        );
        check("par x := y - 1 z endpar", expect!["PAR(par UPDATE(x := BINARY(y - 1)) TERM(z) endpar)"]);
    }

    #[test]
    fn faults() {
        check("", expect!["!expected-rule"]);
        check("x = 1", expect!["UPDATE(x = 1) !equals-for-assign"]);
        check("x : = 1", expect!["TERM(x ERROR(: =) 1) !equals-for-assign"]);
        check("x 1", expect!["TERM(x) ERROR(1) !expected-definition"]);
        check("r_a", expect!["MACRO_CALL(r_a) !missing-brackets"]);
        check("r_a x", expect!["MACRO_CALL(r_a) ERROR(TERM(x)) !missing-brackets !several-rules"]);
        check("r_a := 1", expect!["MACRO_CALL(r_a := 1) !name-class"]);
        check("RED := 1", expect!["UPDATE(RED := 1) !name-class"]);
        check("x := r_a[]", expect!["UPDATE(x := ERROR(r_a [ ])) !rule-in-term"]);
        check("x <- y", expect!["RETURN(x <- ERROR(y)) !expected-rule"]);
        check("x <- r_a[]", expect!["RETURN(x <- MACRO_CALL(r_a ARGUMENT_LIST([ ]))) !expected-rule"]);
        check("x + 1", expect!["TERM(x ERROR(+ 1)) !term-as-rule"]);
        check("par", expect!["PAR(par) !missing-end"]);
        check("par endpar", expect!["PAR(par endpar) !expected-rule"]);
        check(
            "par x := 1; y := 2; endpar",
            expect![[r#"
            PAR(par UPDATE(x := 1) ERROR(;) UPDATE(y := 2) ERROR(;) endpar)
            !unexpected-text
            !unexpected-text"#]],
        );
        check("par x := 1 endseq", expect!["PAR(par UPDATE(x := 1) ERROR(endseq)) !missing-end"]);
        check(
            "if a then x := 1 y := 2 endif",
            expect![[r#"
            IF(
              if
              CONDITIONAL_BRANCH(a then UPDATE(x := 1) ERROR(UPDATE(y := 2)))
              endif)
            !several-rules"#]],
        );
        check("if a x := 1 endif", expect!["IF(if CONDITIONAL_BRANCH(a UPDATE(x := 1)) endif) !expected-token"]);
        check("forall x in D do skip", expect!["FORALL(forall BINDER(x in DOMAIN(D)) do SKIP(skip)) !name-class"]);
        check("forall $x in D skip", expect!["FORALL(forall BINDER($x in DOMAIN(D)) SKIP(skip)) !expected-token"]);
        check(
            "forall $x in D do skip endforall",
            expect![[r#"
            FORALL(forall BINDER($x in DOMAIN(D)) do SKIP(skip) ERROR(endforall))
            !stray-end"#]],
        );
        check("while a skip", expect!["WHILE(while a SKIP(skip)) !expected-token"]);
        check(
            "choose $x in D with do skip",
            expect![[r#"
            CHOOSE(choose BINDER($x in DOMAIN(D)) with do SKIP(skip))
            !expected-term"#]],
        );
        check("par skip else skip endpar", expect!["PAR(par SKIP(skip) ERROR(else) SKIP(skip) endpar) !stray-end"]);
        check("par 5 skip endpar", expect!["PAR(par ERROR(5) SKIP(skip) endpar) !expected-rule"]);
        check("par (skip) skip endpar", expect!["PAR(par ERROR(( SKIP(skip) )) SKIP(skip) endpar) !expected-rule"]);
        check("extend d with $x do skip", expect!["EXTEND(extend d with $x do SKIP(skip)) !name-class"]);
        check("skip skip", expect!["SKIP(skip) ERROR(SKIP(skip)) !several-rules"]);
        check("skip endif", expect!["SKIP(skip) ERROR(endif) !stray-end"]);
        check("local f [skip] skip", expect!["LOCAL(LOCAL(local f [ SKIP(skip) ]) SKIP(skip)) !expected-token"]);
        check("let ($x = 1) in skip", expect!["LET(let ( BINDING($x = 1) ) in SKIP(skip)) !missing-end"]);
    }
}
