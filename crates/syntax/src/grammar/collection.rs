//! Sets, sequences, bags and maps: literals, ranges and comprehensions (spec/language.md, 6.2).
//!
//! Which of them it is shows only behind the first element, so the node is put around what was read. `{$x in …` always
//! starts a comprehension; a set whose first element is a membership test has it in parentheses.

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
    if p.at(RETURN_ARROW) {
        p.split_opener(LT, MINUS, close); // `<-1, 2>` is a bag
    } else {
        p.bump_opener(close);
    }
    let within = if close == GT { Within::Bag } else { Within::Plain };
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
                p.fault(fault::dots_in_range(found));
                recovery::error(p, if p.peek(1) == DOT { 2 } else { 1 });
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
