//! Sets, sequences, bags and maps: literals, ranges and comprehensions (spec/language.md, 6.2).
//!
//! Only the text after the first element shows which of them it is, so the node is put around what was read. `{$x in …`
//! always starts a comprehension; a set whose first element is a membership test has it in parentheses.
//! CIRCLE(grammar)

use super::term::{delimited, inside, term};
use super::{binding, list, recovery};
use crate::SyntaxKind::{self, *};
use crate::fault;
use crate::parser::{Parser, Within};

/// From one of the brackets `{`, `[`, `<` to its end.
pub(super) fn collection(p: &mut Parser<'_>) {
    let checkpoint = p.checkpoint();
    let close = match p.current() {
        L_BRACE => R_BRACE,
        L_BRACKET => R_BRACKET,
        _ => GT,
    };
    p.bump_opener(close);
    let within = match close {
        GT => Within::Bag,
        R_BRACE => Within::Braces,
        _ => Within::Plain,
    };
    let kind = inside(p, within, |p| contents(p, close));
    recovery::end(p);
    p.start_at(checkpoint, kind);
    p.finish();
}

fn contents(p: &mut Parser<'_>, close: SyntaxKind) -> SyntaxKind {
    if p.at(close) {
        return COLLECTION_TERM;
    }
    if p.at(ARROW) && p.peek(1) == close {
        p.bump();
        return MAP_TERM;
    }
    if p.at(VARIABLE) && p.peek(1) == IN_KW {
        comprehension(p);
        return COMPREHENSION_TERM;
    }
    let first = p.checkpoint();
    term(p, "an element");
    match p.current() {
        ARROW => {
            p.start_at(first, MAP_ENTRY);
            arrow_and_value(p);
            p.finish();
            if p.eat(COMMA) {
                list::items(p, close, entry);
            }
            MAP_TERM
        }
        COLON | DOT => {
            if p.at(DOT) {
                let found = p.found();
                let two = p.peek(1) == DOT && p.touches_next();
                p.fault(fault::dots_in_range(found, two));
                recovery::error(p, if two { 2 } else { 1 });
            } else {
                p.bump();
            }
            term(p, "the upper bound of the range");
            if p.eat(COMMA) {
                term(p, "the step of the range");
            }
            RANGE_TERM
        }
        _ => {
            list::more_items(p, close, |p| term(p, "an element"));
            COLLECTION_TERM
        }
    }
}

fn entry(p: &mut Parser<'_>) -> bool {
    p.start(MAP_ENTRY);
    let found = term(p, "an entry `key -> value`");
    if found {
        arrow_and_value(p);
    }
    p.finish();
    found
}

fn arrow_and_value(p: &mut Parser<'_>) {
    if p.expect(ARROW, "between the key and the value of a map's entry") {
        term(p, "the value of the entry");
    }
}

/// `$x in D, $y in E | c : t`, and with `-> u |` the comprehension of a map.
fn comprehension(p: &mut Parser<'_>) {
    binding::binders(p);
    if p.eat(BAR) {
        delimited(p, "a condition"); // it cannot be the last part of a bag, so `>` compares
    }
    if !p.expect(COLON, "before the elements of the comprehension") {
        return;
    }
    let element = p.checkpoint();
    term(p, "the element of the comprehension");
    if p.at(ARROW) {
        p.start_at(element, MAP_ENTRY);
        arrow_and_value(p);
        p.finish();
        p.eat(BAR); // the peer demands it
    }
}

#[cfg(test)]
mod tests {
    use crate::grammar::brief::term;
    use expect_test::{Expect, expect};

    fn check(text: &str, expected: Expect) {
        expected.assert_eq(&term(text));
    }

    #[test]
    fn literals() {
        check("{}", expect!["COLLECTION({ })"]);
        check("[]", expect!["COLLECTION([ ])"]);
        check("<>", expect!["COLLECTION(< >)"]);
        check("{1}", expect!["COLLECTION({ 1 })"]);
        check("{1, a, {2}}", expect!["COLLECTION({ 1 , a , COLLECTION({ 2 }) })"]);
        check("[1, [2]]", expect!["COLLECTION([ 1 , COLLECTION([ 2 ]) ])"]);
        check("<1, 2>", expect!["COLLECTION(< 1 , 2 >)"]);
        check("< <1>, <2>>", expect!["COLLECTION(< COLLECTION(< 1 >) , COLLECTION(< 2 >) >)"]);
        check("<<1>, <2>>", expect!["COLLECTION(< COLLECTION(< 1 >) , COLLECTION(< 2 >) >)"]);
        check("<-1, 2>", expect!["COLLECTION(< UNARY(- 1) , 2 >)"]);
        check("<a, (b > c)>", expect!["COLLECTION(< a , PAREN(( BINARY(b > c) )) >)"]);
        check("<1> = <2>", expect!["BINARY(COLLECTION(< 1 >) = COLLECTION(< 2 >))"]);
        check("x = <>", expect!["BINARY(x = COLLECTION(< >))"]);
        check("{a -> b}", expect!["MAP({ MAP_ENTRY(a -> b) })"]);
        check("{->}", expect!["MAP({ -> })"]);
        check(
            "{a -> {1 -> 2}, c -> d}",
            expect![[r#"
            MAP(
              {
              MAP_ENTRY(a -> MAP({ MAP_ENTRY(1 -> 2) }))
              ,
              MAP_ENTRY(c -> d)
              })"#]],
        );
    }

    #[test]
    fn ranges() {
        check("{1 : 5}", expect!["RANGE({ 1 : 5 })"]);
        check("{-3:5}", expect!["RANGE({ UNARY(- 3) : 5 })"]);
        check("[1n : 5n, 2n]", expect!["RANGE([ 1n : 5n , 2n ])"]);
        check("<1:3>", expect!["RANGE(< 1 : 3 >)"]);
        check("{a + 1 : f(b), c}", expect!["RANGE({ BINARY(a + 1) : FUNCTION(f ARGUMENT_LIST(( b ))) , c })"]);
    }

    #[test]
    fn comprehensions() {
        check("{$x in D : $x}", expect!["COMPREHENSION({ BINDER($x in DOMAIN(D)) : $x })"]);
        check(
            "{$x in D, $y in E | $x > $y : $x + $y}",
            expect![[r#"
            COMPREHENSION(
              {
              BINDER($x in DOMAIN(D))
              ,
              BINDER($y in DOMAIN(E))
              |
              BINARY($x > $y)
              :
              BINARY($x + $y)
              })"#]],
        );
        check(
            "[$x in [1:3] | $x > 1 : $x]",
            expect![[r#"
            COMPREHENSION(
              [
              BINDER($x in RANGE([ 1 : 3 ]))
              |
              BINARY($x > 1)
              :
              $x
              ])"#]],
        );
        check(
            "<$x in <1, 2> | $x > 1 : $x>",
            expect![[r#"
            COMPREHENSION(
              <
              BINDER($x in COLLECTION(< 1 , 2 >))
              |
              BINARY($x > 1)
              :
              $x
              >)"#]],
        );
        check(
            "{$x in D | c : $x -> 1 |}",
            expect!["COMPREHENSION({ BINDER($x in DOMAIN(D)) | c : MAP_ENTRY($x -> 1) | })"],
        );
        check("{$x in D : $x -> 1}", expect!["COMPREHENSION({ BINDER($x in DOMAIN(D)) : MAP_ENTRY($x -> 1) })"]);
        check("{($x in D)}", expect!["COLLECTION({ PAREN(( BINARY($x in DOMAIN(D)) )) })"]);
    }

    #[test]
    fn extended_terms_as_operands() {
        check("x = {1, 2}", expect!["BINARY(x = COLLECTION({ 1 , 2 }))"]);
        check(
            "{1} = {2} or [1] != []",
            expect![[r#"
            BINARY(
              BINARY(COLLECTION({ 1 }) = COLLECTION({ 2 }))
              or
              BINARY(COLLECTION([ 1 ]) != COLLECTION([ ])))"#]],
        );
        check("if a then 1 else 2 endif + 1", expect!["BINARY(IF(if CONDITIONAL_BRANCH(a then 1) else 2 endif) + 1)"]);
        check("1 + let ($x = 1) in $x endlet", expect!["BINARY(1 + LET(let ( BINDING($x = 1) ) in $x endlet))"]);
        check("({1})", expect!["PAREN(( COLLECTION({ 1 }) ))"]);
        check("-{1}", expect!["UNARY(- COLLECTION({ 1 }))"]);
    }

    #[test]
    fn faults() {
        check("{1..5}", expect!["RANGE({ 1 ERROR(. .) 5 }) !foreign-operator"]);
        check("{1, 2", expect!["COLLECTION({ 1 , 2) !missing-end"]);
        check("{1 2}", expect!["COLLECTION({ 1 2 }) !expected-token"]);
        check("{a -> b, c}", expect!["MAP({ MAP_ENTRY(a -> b) , MAP_ENTRY(c) }) !expected-token"]);
        check("{$x in D}", expect!["COMPREHENSION({ BINDER($x in DOMAIN(D)) }) !expected-token"]);
        check("{1, }", expect!["COLLECTION({ 1 , }) !expected-term"]);
        check("{1)", expect!["COLLECTION({ 1 ERROR())) !missing-end"]);
        check("<1, 2", expect!["COLLECTION(< 1 , 2) !missing-end"]);
        check("{a -> }", expect!["MAP({ MAP_ENTRY(a ->) }) !expected-term"]);
        check("{1 : }", expect!["RANGE({ 1 : }) !expected-term"]);
    }
}
