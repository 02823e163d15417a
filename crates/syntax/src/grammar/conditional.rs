//! `if` and `switch`, which terms and rules share (spec/language.md, 6.2 and 7).
//!
//! In: the cursor at the first word, and what a branch holds: a term or a rule. Out: IF_ and SWITCH_ nodes with
//! CONDITIONAL_BRANCH and CASE_BRANCH. A branch that comes too late is parsed and reported.
//! CIRCLE(grammar)

use super::recovery;
use super::sets::TERM_STARTS;
use super::term::delimited;
use crate::SyntaxKind::{self, *};
use crate::fault;
use crate::parser::Parser;

/// What stands after `then`, `else`, `case a:` and `otherwise`.
#[derive(Clone, Copy)]
pub(super) struct Body {
    /// Parses the body.
    pub(super) parse: fn(&mut Parser<'_>, &str),
    /// The cursor is at one.
    pub(super) starts: fn(&Parser<'_>) -> bool,
}

/// A body that is a term.
pub(super) const TERM: Body = Body { parse: |p, wanted| _ = delimited(p, wanted), starts: |p| p.at_any(TERM_STARTS) };

impl Body {
    /// The body after a keyword or mark. If that is missing, a body that stands there is read all the same.
    pub(super) fn behind(self, p: &mut Parser<'_>, keyword: SyntaxKind, context: &str, wanted: &str) {
        if p.expect(keyword, context) || (self.starts)(p) {
            (self.parse)(p, wanted);
        }
    }
}

/// `if g then a elseif h then b else c endif`
pub(super) fn if_term(p: &mut Parser<'_>) {
    if_construct(p, IF_TERM, TERM);
}

/// `switch t case a: b otherwise c endswitch`
pub(super) fn switch_term(p: &mut Parser<'_>) {
    switch_construct(p, SWITCH_TERM, TERM);
}

/// An `if` with branches that are terms or rules.
pub(super) fn if_construct(p: &mut Parser<'_>, kind: SyntaxKind, body: Body) {
    p.start(kind);
    p.bump_opener(ENDIF_KW);
    branch(p, body);
    while elseif(p) {
        branch(p, body);
    }
    let mut else_if = None;
    let ended = p.eat(ELSE_KW);
    if ended {
        else_if = (p.at(IF_KW) && !p.on_new_line()).then(|| p.found());
        (body.parse)(p, "what to do or give otherwise, behind `else`");
    }
    while else_if.is_none() && ended && matches!(p.current(), ELSE_KW | ELSEIF_KW) {
        let found = p.found();
        p.fault(fault::misplaced_branch(found, "else"));
        p.start(ERROR);
        if p.eat(ELSE_KW) {
            (body.parse)(p, "what to do or give behind `else`");
        } else {
            p.bump();
            branch(p, body);
        }
        p.finish();
    }
    if let (Some(inner), Some((_, outer)), false) = (else_if, p.innermost(), p.at(ENDIF_KW)) {
        let found = p.missing();
        p.fault(fault::else_if(found, outer, inner));
    }
    recovery::end(p);
    p.finish();
}

/// The cursor is at another language's word for `elseif`.
pub(super) fn at_foreign_elseif(p: &Parser<'_>) -> bool {
    (p.at_word("elif") || p.at_word("elsif")) && !matches!(p.peek(1), ASSIGN | COLON)
}

/// Takes `elseif`, or another language's word for it.
fn elseif(p: &mut Parser<'_>) -> bool {
    if at_foreign_elseif(p) {
        let found = p.found();
        p.fault(fault::foreign_word(found, "elseif"));
        p.bump_as(ELSEIF_KW);
        return true;
    }
    p.eat(ELSEIF_KW)
}

fn branch(p: &mut Parser<'_>, body: Body) {
    p.start(CONDITIONAL_BRANCH);
    delimited(p, "a condition");
    body.behind(p, THEN_KW, "behind the condition", "what to do or give behind `then`");
    p.finish();
}

/// A `switch` with cases that are terms or rules.
pub(super) fn switch_construct(p: &mut Parser<'_>, kind: SyntaxKind, body: Body) {
    p.start(kind);
    p.bump_opener(ENDSWITCH_KW);
    delimited(p, "the term that `switch` compares");
    if !p.at(CASE_KW) {
        p.expect(CASE_KW, "behind the term of `switch`");
        if (body.starts)(p) {
            p.start(ERROR);
            (body.parse)(p, "a case");
            p.finish();
        }
    }
    while p.at(CASE_KW) {
        case(p, body);
    }
    if p.eat(OTHERWISE_KW) {
        (body.parse)(p, "what to do or give otherwise");
    }
    while p.at(CASE_KW) {
        let found = p.found();
        p.fault(fault::misplaced_branch(found, "otherwise"));
        case(p, body);
    }
    recovery::end(p);
    p.finish();
}

fn case(p: &mut Parser<'_>, body: Body) {
    p.start(CASE_BRANCH);
    p.bump();
    delimited(p, "a value behind `case`");
    body.behind(p, COLON, "behind the value of `case`", "what to do or give in this case");
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
    fn if_terms() {
        check("if a then b endif", expect!["IF(if CONDITIONAL_BRANCH(a then b) endif)"]);
        check("if a then b else c endif", expect!["IF(if CONDITIONAL_BRANCH(a then b) else c endif)"]);
        check(
            "if a then b elseif c then d elseif e then f else g endif",
            expect![[r#"
            IF(
              if
              CONDITIONAL_BRANCH(a then b)
              elseif
              CONDITIONAL_BRANCH(c then d)
              elseif
              CONDITIONAL_BRANCH(e then f)
              else
              g
              endif)"#]],
        );
        check(
            "if a then if b then c endif else d endif",
            expect![[r#"
            IF(
              if
              CONDITIONAL_BRANCH(a then IF(if CONDITIONAL_BRANCH(b then c) endif))
              else
              d
              endif)"#]],
        );
        check(
            "if a > b then {1} else <1> endif",
            expect![[r#"
            IF(
              if
              CONDITIONAL_BRANCH(BINARY(a > b) then COLLECTION({ 1 }))
              else
              COLLECTION(< 1 >)
              endif)"#]],
        );
    }

    #[test]
    fn switch_terms() {
        check(
            "switch x case 1: a case 2: b otherwise c endswitch",
            expect![[r#"
            SWITCH(
              switch
              x
              CASE_BRANCH(case 1 : a)
              CASE_BRANCH(case 2 : b)
              otherwise
              c
              endswitch)"#]],
        );
        check(
            "switch x case {1:2}: 3 endswitch",
            expect!["SWITCH(switch x CASE_BRANCH(case RANGE({ 1 : 2 }) : 3) endswitch)"],
        );
    }

    #[test]
    fn faults() {
        check("if a then b", expect!["IF(if CONDITIONAL_BRANCH(a then b)) !missing-end"]);
        check("if a b endif", expect!["IF(if CONDITIONAL_BRANCH(a b) endif) !expected-token"]);
        check("if then b endif", expect!["IF(if CONDITIONAL_BRANCH(then b) endif) !expected-term"]);
        check(
            "if a then b else if c then d endif",
            expect![[r#"
            IF(
              if
              CONDITIONAL_BRANCH(a then b)
              else
              IF(if CONDITIONAL_BRANCH(c then d) endif))
            !missing-end"#]],
        );
        check(
            "if a then b elif c then d endif",
            expect![[r#"
            IF(
              if
              CONDITIONAL_BRANCH(a then b)
              elif
              CONDITIONAL_BRANCH(c then d)
              endif)
            !foreign-operator"#]],
        );
        check(
            "if a then b else c else d endif",
            expect![[r#"
            IF(if CONDITIONAL_BRANCH(a then b) else c ERROR(else d) endif)
            !misplaced-branch"#]],
        );
        check("switch x endswitch", expect!["SWITCH(switch x endswitch) !expected-token"]);
        check(
            "switch x case 1 a endswitch",
            expect!["SWITCH(switch x CASE_BRANCH(case 1 a) endswitch) !expected-token"],
        );
        check(
            "switch x case 1: a otherwise b case 2: c endswitch",
            expect![[r#"
            SWITCH(
              switch
              x
              CASE_BRANCH(case 1 : a)
              otherwise
              b
              CASE_BRANCH(case 2 : c)
              endswitch)
            !misplaced-branch"#]],
        );
    }
}
