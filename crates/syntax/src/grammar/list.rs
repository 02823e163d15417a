//! Lists between brackets, their items separated by commas.
//!
//! In: the closing bracket and how to parse an item. Out: the number of items. A forgotten comma is reported, and the
//! list goes on. An item on a new line belongs to what comes next: then the bracket is what was forgotten.
//! CIRCLE(grammar)

use super::recovery;
use super::sets::TERM_STARTS;
use crate::SyntaxKind::{self, *};
use crate::fault;
use crate::parser::Parser;

/// Whether a list may be empty.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Empty {
    Allowed,
    Forbidden,
}

/// From the opening bracket at the cursor to the closing one; gives the number of items.
pub(super) fn list(
    p: &mut Parser<'_>,
    close: SyntaxKind,
    empty: Empty,
    item: impl FnMut(&mut Parser<'_>) -> bool,
) -> usize {
    p.bump_opener(close);
    if p.at(close) && empty == Empty::Forbidden {
        let found = p.found();
        p.fault(fault::empty_parentheses(found));
    }
    let count = if p.at(close) { 0 } else { items(p, close, item) };
    recovery::end(p);
    count
}

/// Items up to the closing bracket, which is left; gives their number.
pub(super) fn items(p: &mut Parser<'_>, close: SyntaxKind, mut item: impl FnMut(&mut Parser<'_>) -> bool) -> usize {
    item(p);
    1 + more_items(p, close, item)
}

/// Items after the first one up to the closing bracket, which is left; gives their number.
pub(super) fn more_items(
    p: &mut Parser<'_>,
    close: SyntaxKind,
    mut item: impl FnMut(&mut Parser<'_>) -> bool,
) -> usize {
    let mut count = 0;
    loop {
        if !p.eat(COMMA) {
            let forgotten = !p.at(close) && p.at_any(TERM_STARTS) && !p.on_new_line();
            if !forgotten {
                return count;
            }
            let found = p.found();
            p.fault(fault::expected_token(found, COMMA, "between two items"));
        }
        let before = p.position();
        item(p);
        count += 1;
        if p.position() == before && !p.at(COMMA) {
            return count;
        }
    }
}
