//! Terms (spec/language.md, section 6).
//!
//! Every term is an operand everywhere; the peer's distinction between infix and extended terms is gone. A quantified
//! term's node and a tuple's node include their parentheses.
//! CIRCLE(grammar): terms hold rules and rules terms, and what recovers from a fault reads any of them.

use super::operator::{LOWEST, NOT, SIGN, infix, infix_power, is_infix_word};
use super::sets::RULE_WORDS;
use super::{binding, collection, conditional, domain, list, recovery};
use crate::SyntaxKind::*;
use crate::fault;
use crate::limit::MAX_CHAIN;
use crate::parser::{Parser, Within};

/// A whole term.
pub(super) fn term(p: &mut Parser<'_>, wanted: &str) -> bool {
    binary(p, LOWEST, wanted)
}

/// A term between brackets or keywords, where a bare `>` is a comparison again.
pub(super) fn delimited(p: &mut Parser<'_>, wanted: &str) -> bool {
    inside(p, Within::Plain, |p| term(p, wanted))
}

/// Parses something that stands in something else.
pub(super) fn inside<T>(p: &mut Parser<'_>, within: Within, parse: impl FnOnce(&mut Parser<'_>) -> T) -> T {
    let outer = std::mem::replace(&mut p.within, within);
    let result = parse(p);
    p.within = outer;
    result
}

/// A term of operators that bind at least as tightly as `least`.
fn binary(p: &mut Parser<'_>, least: u8, wanted: &str) -> bool {
    if !p.enter() {
        return recovery::too_deep(p);
    }
    let checkpoint = p.checkpoint();
    let outside = p.take_deepest();
    let found = prefix(p, least, wanted);
    while found && let Some(power) = infix_power(p).filter(|power| *power >= least) {
        if p.lift_deepest() > MAX_CHAIN {
            recovery::chain_too_long(p);
            break;
        }
        p.start_at(checkpoint, BINARY_TERM);
        infix(p);
        binary(p, power + 1, "the right operand");
        p.finish();
    }
    p.restore_deepest(outside);
    p.leave();
    found
}

/// `not`, which stands between the relations and the sums; below, `not (…)` is a call.
fn prefix(p: &mut Parser<'_>, least: u8, wanted: &str) -> bool {
    let foreign = p.at(ERROR) && fault::replacement(p.token_text()) == Some("not");
    if !(foreign || p.at_word("not") && (least <= NOT || p.peek(1) != L_PAREN)) {
        return sign(p, wanted);
    }
    p.start(UNARY_TERM);
    p.bump();
    binary(p, if least <= NOT { NOT } else { SIGN }, "the operand of `not`");
    p.finish();
    true
}

fn sign(p: &mut Parser<'_>, wanted: &str) -> bool {
    if !matches!(p.current(), PLUS | MINUS) {
        return basic(p, wanted);
    }
    p.start(UNARY_TERM);
    p.bump();
    binary(p, SIGN, "the operand of the sign");
    p.finish();
    true
}

/// A term without operators around it.
fn basic(p: &mut Parser<'_>, wanted: &str) -> bool {
    match p.current() {
        INTEGER | NATURAL | REAL | COMPLEX | CHAR | STRING | TRUE_KW | FALSE_KW | UNDEF_KW => literal(p),
        ENUM_ID => leaf(p, ENUM_TERM),
        VARIABLE => leaf(p, VARIABLE_TERM),
        FUNCTION_ID if is_infix_word(p) && p.peek(1) != L_PAREN => return recovery::no_term(p, wanted),
        FUNCTION_ID if p.on_new_line() && p.peek(1) == ASSIGN => return recovery::no_term(p, wanted),
        FUNCTION_ID => function(p),
        GENERIC_ID | INVARIANT_ID | CTL_ID | LTL_ID => {
            let found = p.found();
            p.fault(fault::name_class(found, FUNCTION_ID));
            function(p);
        }
        DOMAIN_ID | PROD_KW | SEQ_DOMAIN_KW | POWERSET_KW | BAG_KW | MAP_KW | RULE_DOMAIN_KW => {
            p.start(DOMAIN_TERM);
            domain::domain(p);
            p.finish();
        }
        L_PAREN => parenthesised(p),
        L_BRACE | L_BRACKET => collection::collection(p),
        LT if p.peek(1) == LT && p.peek(2) == RULE_ID => rule_term(p),
        LT if p.peek(1) == LT && RULE_WORDS.contains(p.peek(2)) => recovery::rule_as_value(p),
        LT => collection::collection(p),
        IF_KW => conditional::if_term(p),
        SWITCH_KW => conditional::switch_term(p),
        LET_KW => binding::let_term(p),
        _ => return recovery::no_term(p, wanted),
    }
    true
}

fn leaf(p: &mut Parser<'_>, kind: crate::SyntaxKind) {
    p.start(kind);
    p.bump();
    p.finish();
}

fn literal(p: &mut Parser<'_>) {
    let integer = p.at(INTEGER);
    leaf(p, LITERAL_TERM);
    if integer && p.at(DOT) && p.touches_previous() && p.peek(1) != DOT {
        let found = p.found();
        p.fault(fault::bare_point(found));
        recovery::error(p, 1);
    }
}

/// `f`, `f(a, b)`, `agent.f(a)`
fn function(p: &mut Parser<'_>) {
    p.start(FUNCTION_TERM);
    p.bump_as(FUNCTION_ID);
    if p.at(DOT) {
        p.bump();
        super::name::name(p, FUNCTION_ID);
    }
    if p.at(L_PAREN) {
        p.start(ARGUMENT_LIST);
        list::list(p, R_PAREN, list::Empty::Forbidden, |p| delimited(p, "an argument"));
        p.finish();
    }
    p.finish();
}

/// What can be updated: a function term or a variable.
pub(super) fn location(p: &mut Parser<'_>) -> bool {
    match p.current() {
        VARIABLE => leaf(p, VARIABLE_TERM),
        FUNCTION_ID => function(p),
        _ => {
            let found = p.missing();
            p.fault(fault::expected_term(found, "a location: a function or a variable"));
            return false;
        }
    }
    true
}

/// `(a)`, `(a, b)`, `(forall $x in D with c)`
fn parenthesised(p: &mut Parser<'_>) {
    if matches!(p.peek(1), FORALL_KW | EXISTS_KW) {
        p.start(QUANTIFIED_TERM);
        p.bump_opener(R_PAREN);
        inside(p, Within::Plain, quantifier);
        recovery::end(p);
        p.finish();
        return;
    }
    let checkpoint = p.checkpoint();
    let count = list::list(p, R_PAREN, list::Empty::Forbidden, |p| delimited(p, "a term"));
    p.start_at(checkpoint, if count > 1 { TUPLE_TERM } else { PAREN_TERM });
    p.finish();
}

/// `forall $x in D with c` without its parentheses.
pub(super) fn quantifier(p: &mut Parser<'_>) {
    if p.eat(EXISTS_KW) {
        p.eat(UNIQUE_KW);
    } else {
        p.bump();
    }
    binding::binders(p);
    if p.eat(WITH_KW) {
        term(p, "a condition");
    }
}

/// `<<r_x(D)>>`
fn rule_term(p: &mut Parser<'_>) {
    p.start(RULE_TERM);
    p.bump();
    p.bump();
    p.bump();
    if p.at(L_PAREN) {
        list::list(p, R_PAREN, list::Empty::Allowed, domain::domain);
    }
    let context = "behind the rule's name in `<<…>>`";
    if p.expect(GT, context) {
        p.expect(GT, context);
    }
    p.finish();
}

#[cfg(test)]
mod tests {
    use crate::grammar::brief::term;
    use expect_test::{Expect, expect};

    fn check(text: &str, expected: Expect) {
        expected.assert_eq(&term(text));
    }

    #[test]
    fn operands() {
        check("1", expect!["1"]);
        check("-1", expect!["UNARY(- 1)"]);
        check("3n", expect!["3n"]);
        check("2.5", expect!["2.5"]);
        check("i", expect!["i"]);
        check("i27", expect!["i27"]);
        check("2.5i3", expect!["2.5i3"]);
        check("3+i2", expect!["BINARY(3 + i2)"]);
        check("3+idx", expect!["BINARY(3 + idx)"]);
        check("x-index", expect!["BINARY(x - index)"]);
        check("i_x", expect!["i_x"]);
        check("'a'", expect!["'a'"]);
        check(r#"'\n'"#, expect![[r#"'\n'"#]]);
        check(r#""a \"b\" \u0041""#, expect![[r#""a \"b\" \u0041""#]]);
        check("true", expect!["true"]);
        check("undef", expect!["undef"]);
        check("RED", expect!["RED"]);
        check("Red", expect!["DOMAIN(Red)"]);
        check("$x", expect!["$x"]);
        check("f", expect!["f"]);
        check("f(1)", expect!["FUNCTION(f ARGUMENT_LIST(( 1 )))"]);
        check("f (1, $x)", expect!["FUNCTION(f ARGUMENT_LIST(( 1 , $x )))"]);
        check("self.f(1)", expect!["FUNCTION(self . f ARGUMENT_LIST(( 1 )))"]);
        check("Powerset(Prod(A, B))", expect!["DOMAIN(STRUCTURED(Powerset ( STRUCTURED(Prod ( A , B )) )))"]);
        check("Rule", expect!["DOMAIN(STRUCTURED(Rule))"]);
        check("(1)", expect!["PAREN(( 1 ))"]);
        check("(1, 2)", expect!["TUPLE(( 1 , 2 ))"]);
        check("<<r_x>>", expect!["RULE(< < r_x > >)"]);
        check("<<r_x(A, Seq(B))>>", expect!["RULE(< < r_x ( A , STRUCTURED(Seq ( B )) ) > >)"]);
    }

    #[test]
    fn levels() {
        check("a implies b implies c", expect!["BINARY(BINARY(a implies b) implies c)"]);
        check("a or b and c", expect!["BINARY(a or BINARY(b and c))"]);
        check("a and b or c xor d", expect!["BINARY(BINARY(BINARY(a and b) or c) xor d)"]);
        check("not a = b", expect!["BINARY(UNARY(not a) = b)"]);
        check("not a + b = c", expect!["BINARY(UNARY(not BINARY(a + b)) = c)"]);
        check("not (a = b)", expect!["UNARY(not PAREN(( BINARY(a = b) )))"]);
        check("not(a) and b", expect!["BINARY(UNARY(not PAREN(( a ))) and b)"]);
        check("and(a, b)", expect!["FUNCTION(and ARGUMENT_LIST(( a , b )))"]);
        check("not not a", expect!["UNARY(not UNARY(not a))"]);
        check("a = not b", expect!["BINARY(a = UNARY(not b))"]);
        check("a + not b", expect!["BINARY(a + UNARY(not b))"]);
        check("a + not(b)", expect!["BINARY(a + FUNCTION(not ARGUMENT_LIST(( b ))))"]);
        check("2^3^2", expect!["BINARY(BINARY(2 ^ 3) ^ 2)"]);
        check("-2^2", expect!["BINARY(UNARY(- 2) ^ 2)"]);
        check("2^-3", expect!["BINARY(2 ^ UNARY(- 3))"]);
        check("- -x", expect!["UNARY(- UNARY(- x))"]);
        check("a < b < c", expect!["BINARY(BINARY(a < b) < c)"]);
        check("a mod b * c / d", expect!["BINARY(BINARY(BINARY(a mod b) * c) / d)"]);
        check("a + b * c ^ d", expect!["BINARY(a + BINARY(b * BINARY(c ^ d)))"]);
        check("a iff b or c", expect!["BINARY(a iff BINARY(b or c))"]);
        check("x in S and y notin T", expect!["BINARY(BINARY(x in DOMAIN(S)) and BINARY(y notin DOMAIN(T)))"]);
        check("notin(S, x)", expect!["FUNCTION(notin ARGUMENT_LIST(( DOMAIN(S) , x )))"]);
        check("mod(7, 2) mod 2", expect!["BINARY(FUNCTION(mod ARGUMENT_LIST(( 7 , 2 ))) mod 2)"]);
    }

    #[test]
    fn quantified() {
        check(
            "(forall $x in D with $x > 1)",
            expect!["QUANTIFIED(( forall BINDER($x in DOMAIN(D)) with BINARY($x > 1) ))"],
        );
        check(
            "(exists $x in D, $y in E with a)",
            expect![[r#"
            QUANTIFIED(
              (
              exists
              BINDER($x in DOMAIN(D))
              ,
              BINDER($y in DOMAIN(E))
              with
              a
              ))"#]],
        );
        check(
            "(exist unique $x in {1, 2})",
            expect!["QUANTIFIED(( exist unique BINDER($x in COLLECTION({ 1 , 2 })) ))"],
        );
        check(
            "(forall $x in D with c) and d",
            expect!["BINARY(QUANTIFIED(( forall BINDER($x in DOMAIN(D)) with c )) and d)"],
        );
    }

    #[test]
    fn arrows() {
        check("a<-1", expect!["BINARY(a < UNARY(- 1))"]);
        check("a < -1", expect!["BINARY(a < UNARY(- 1))"]);
        check("x <- 3", expect!["BINARY(x < UNARY(- 3))"]);
        check("a<-b+1", expect!["BINARY(a < BINARY(UNARY(- b) + 1))"]);
        check("1<-2", expect!["BINARY(1 < UNARY(- 2))"]);
    }

    #[test]
    fn faults() {
        check("", expect!["!expected-term"]);
        check("1 +", expect!["BINARY(1 +) !expected-term"]);
        check("* 2", expect!["ERROR(*) 2 !expected-term"]);
        check("1 + * 2", expect!["BINARY(1 + ERROR(*) 2) !expected-term"]);
        check("mod 3", expect!["ERROR(mod) 3 !expected-term"]);
        check("a == b", expect!["BINARY(a == b) !foreign-operator"]);
        check("a && !b", expect!["BINARY(a && UNARY(! b)) !foreign-operator !foreign-operator"]);
        check("a <> b", expect!["BINARY(a < > b) !foreign-operator"]);
        check("(a -> b or c)", expect!["PAREN(( BINARY(a -> BINARY(b or c)) )) !foreign-operator"]);
        check("{a -> b}", expect!["MAP({ MAP_ENTRY(a -> b) })"]);
        check("a := b", expect!["BINARY(a := b) !assign-in-term"]);
        check("f()", expect!["FUNCTION(f ARGUMENT_LIST(( ))) !expected-term"]);
        check("f(a", expect!["FUNCTION(f ARGUMENT_LIST(( a)) !missing-end"]);
        check("f(a b)", expect!["FUNCTION(f ARGUMENT_LIST(( a b ))) !expected-token"]);
        check("f(,)", expect!["FUNCTION(f ARGUMENT_LIST(( , ))) !expected-term !expected-term"]);
        check("r_x(1) + 2", expect!["BINARY(ERROR(r_x ( 1 )) + 2) !rule-in-term"]);
        check(
            "forall $x in D with c",
            expect![[r#"
            QUANTIFIED(forall BINDER($x in DOMAIN(D)) with c)
            !quantifier-parentheses"#]],
        );
        check(".5", expect!["ERROR(.) 5 !number-form"]);
        check("a ? b", expect!["a ? ERROR(b) !unknown-character"]);
        check("1 2", expect!["1 ERROR(2) !unexpected-text"]);
        check("(1, )", expect!["TUPLE(( 1 , )) !expected-term"]);
        check("f(a]", expect!["FUNCTION(f ARGUMENT_LIST(( a ERROR(]))) !missing-end"]);
        check("_x", expect!["_x !name-class"]);
        check("$", expect!["$ !unknown-character"]);
        check("a.1", expect!["FUNCTION(a .) ERROR(1) !expected-name"]);
        check("x = = y", expect!["BINARY(x = ERROR(=) y) !expected-term"]);
        check("1e5", expect!["1e5 !number-form"]);
        check("f(1", expect!["FUNCTION(f ARGUMENT_LIST(( 1)) !missing-end"]);
    }
}
