//! `if` and `switch`, which terms and rules share (spec/language.md, 6.2 and 7).

use super::recovery;
use super::term::delimited;
use crate::SyntaxKind::{self, *};
use crate::parser::Parser;

/// Parses what stands behind `then`, `else`, `case a:` and `otherwise`.
type Body = fn(&mut Parser<'_>, &str);

fn term_body(p: &mut Parser<'_>, wanted: &str) {
    delimited(p, wanted);
}

/// `if g then a elseif h then b else c endif`
pub(super) fn if_term(p: &mut Parser<'_>) {
    if_construct(p, IF_TERM, term_body);
}

/// `switch t case a: b otherwise c endswitch`
pub(super) fn switch_term(p: &mut Parser<'_>) {
    switch_construct(p, SWITCH_TERM, term_body);
}

/// An `if` with branches that are terms or rules.
pub(super) fn if_construct(p: &mut Parser<'_>, kind: SyntaxKind, body: Body) {
    p.start(kind);
    p.bump_opener(ENDIF_KW);
    branch(p, body);
    while p.eat(ELSEIF_KW) {
        branch(p, body);
    }
    if p.eat(ELSE_KW) {
        body(p, "what to do or give otherwise, behind `else`");
    }
    recovery::end(p);
    p.finish();
}

fn branch(p: &mut Parser<'_>, body: Body) {
    p.start(CONDITIONAL_BRANCH);
    delimited(p, "a condition");
    if p.expect(THEN_KW, "behind the condition") {
        body(p, "what to do or give behind `then`");
    }
    p.finish();
}

/// A `switch` with cases that are terms or rules.
pub(super) fn switch_construct(p: &mut Parser<'_>, kind: SyntaxKind, body: Body) {
    p.start(kind);
    p.bump_opener(ENDSWITCH_KW);
    delimited(p, "the term that `switch` compares");
    if !p.at(CASE_KW) {
        p.expect(CASE_KW, "behind the term of `switch`");
    }
    while p.at(CASE_KW) {
        p.start(CASE_BRANCH);
        p.bump();
        delimited(p, "a value behind `case`");
        if p.expect(COLON, "behind the value of `case`") {
            body(p, "what to do or give in this case");
        }
        p.finish();
    }
    if p.eat(OTHERWISE_KW) {
        body(p, "what to do or give otherwise");
    }
    recovery::end(p);
    p.finish();
}
