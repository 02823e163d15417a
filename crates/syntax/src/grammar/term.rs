//! Terms (spec/language.md, section 6).
//!
//! Every term is an operand everywhere; the peer's distinction between infix and extended terms is gone. A quantified
//! term's node and a tuple's node include their parentheses.

use super::operator::{LOWEST, NOT, SIGN, infix, infix_power, is_infix_word};
use super::{binding, collection, conditional, domain, list, recovery};
use crate::SyntaxKind::*;
use crate::fault;
use crate::parser::{MAX_CHAIN, Parser, Within};
use crate::token_set::TokenSet;

/// Tokens that a term can start with.
pub(super) const STARTS: TokenSet = TokenSet::new(&[
    INTEGER,
    NATURAL,
    REAL,
    COMPLEX,
    CHAR,
    STRING,
    TRUE_KW,
    FALSE_KW,
    UNDEF_KW,
    ENUM_ID,
    VARIABLE,
    FUNCTION_ID,
    DOMAIN_ID,
    PROD_KW,
    SEQ_DOMAIN_KW,
    POWERSET_KW,
    BAG_KW,
    MAP_KW,
    RULE_DOMAIN_KW,
    L_PAREN,
    L_BRACE,
    L_BRACKET,
    LT,
    RETURN_ARROW,
    PLUS,
    MINUS,
    IF_KW,
    SWITCH_KW,
    LET_KW,
]);

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
        INTEGER | NATURAL | REAL | COMPLEX | CHAR | STRING | TRUE_KW | FALSE_KW | UNDEF_KW => leaf(p, LITERAL_TERM),
        ENUM_ID => leaf(p, ENUM_TERM),
        VARIABLE => leaf(p, VARIABLE_TERM),
        FUNCTION_ID if is_infix_word(p) && p.peek(1) != L_PAREN => return recovery::no_term(p, wanted),
        FUNCTION_ID if p.on_new_line() && p.peek(1) == ASSIGN => return recovery::no_term(p, wanted),
        FUNCTION_ID => function(p),
        DOMAIN_ID | PROD_KW | SEQ_DOMAIN_KW | POWERSET_KW | BAG_KW | MAP_KW | RULE_DOMAIN_KW => {
            p.start(DOMAIN_TERM);
            domain::domain(p);
            p.finish();
        }
        L_PAREN => parenthesised(p),
        L_BRACE | L_BRACKET => collection::collection(p),
        LT if p.peek(1) == LT && p.peek(2) == RULE_ID => rule_term(p),
        LT | RETURN_ARROW => collection::collection(p),
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

/// `f`, `f(a, b)`, `agent.f(a)`
fn function(p: &mut Parser<'_>) {
    p.start(FUNCTION_TERM);
    p.bump();
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
        _ => return recovery::no_term(p, "a location: a function or a variable"),
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
