//! Infix operators: which token is one, and how tightly it binds (spec/language.md, 6.1).
//!
//! All are left associative. Lowest first: `implies iff` < `or xor` < `and` < relations < `not` < `+ -` < `* / mod` <
//! `^` < signs. Operators of other languages are reported; they bind like the ones they stand for.
//! CIRCLE(grammar)

use crate::SyntaxKind::*;
use crate::fault;
use crate::parser::{Parser, Within};

/// The power of the operators that bind least.
pub(super) const LOWEST: u8 = 1;
const RELATION: u8 = 4;
/// The power of `not`; it is above the relations.
pub(super) const NOT: u8 = 5;
const SUM: u8 = 6;
const PRODUCT: u8 = 7;
const POWER: u8 = 8;
/// The power of signs, above every infix operator.
pub(super) const SIGN: u8 = 9;

/// How tightly an operator binds.
pub(crate) fn power_of(operator: &str) -> Option<u8> {
    Some(match operator {
        "implies" | "iff" => LOWEST,
        "or" | "xor" => 2,
        "and" => 3,
        "=" | "!=" | "<" | "<=" | ">" | ">=" | "in" | "notin" => RELATION,
        "+" | "-" => SUM,
        "*" | "/" | "mod" => PRODUCT,
        "^" => POWER,
        _ => return None,
    })
}

/// The binding power of the operator at the cursor, if there is one.
pub(super) fn infix_power(p: &Parser<'_>) -> Option<u8> {
    match p.current() {
        FUNCTION_ID => power_of(p.token_text()),
        GT if p.within == Within::Bag => None,
        LT if at_return_arrow(p) && p.peek(2) == RULE_ID => None,
        EQ | NEQ | LT | LE | GT | GE => Some(RELATION),
        IN_KW if p.within == Within::Bindings && p.find_on_line(R_PAREN).is_none() => None, // `let ($x = a in` lacks its `)`
        IN_KW => Some(RELATION),
        ASSIGN => Some(RELATION), // meant as `=`; reported when it is taken
        ARROW if p.within == Within::Plain => Some(LOWEST), // meant as `implies`
        PLUS | MINUS => Some(SUM),
        STAR | SLASH => Some(PRODUCT),
        CARET => Some(POWER),
        ERROR => power_of(fault::replacement(p.token_text())?),
        _ => None,
    }
}

/// The cursor is at `<-`, which the lexer gives as two marks: in a term, `a<-1` is `a < -1`.
pub(super) fn at_return_arrow(p: &Parser<'_>) -> bool {
    p.at(LT) && p.peek(1) == MINUS && p.touches_next()
}

/// Takes the operator at the cursor.
pub(super) fn infix(p: &mut Parser<'_>) {
    match p.current() {
        FUNCTION_ID if p.at_word("notin") => p.bump_as(NOTIN_KW),
        LT if p.peek(1) == GT && p.touches_next() => {
            let found = p.found();
            p.fault(fault::foreign_operator(found.span, "<>"));
            p.bump();
            p.bump();
        }
        ARROW => {
            let found = p.found();
            p.fault(fault::foreign_operator(found.span, "->"));
            p.bump();
        }
        ASSIGN => {
            let found = p.found();
            p.fault(fault::assign_in_term(found));
            p.bump();
        }
        _ => p.bump(),
    }
}

/// The cursor is at a name that is an infix operator.
pub(super) fn is_infix_word(p: &Parser<'_>) -> bool {
    power_of(p.token_text()).is_some()
}
