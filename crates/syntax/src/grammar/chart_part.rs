//! What charts and systems share: their words, blocks, names of shapes, and links.

use super::{name, recovery, rule, term};
use crate::SyntaxKind::{self, *};
use crate::fault;
use crate::parser::Parser;

/// Words that end a block: never taken as names, so that a name left out costs no more than itself.
pub(super) const ENDS: [SyntaxKind; 6] =
    [ENDMACHINE_KW, ENDPATTERN_KW, ENDSTATE_KW, ENDSYSTEM_KW, ENDCOMPONENT_KW, ENDLAYOUT_KW];

/// The word of the section that starts at the cursor.
pub(super) fn section_word(p: &Parser<'_>) -> Option<SyntaxKind> {
    if p.at(IMPORT_KW) {
        return Some(IMPORT_KW);
    }
    keyword(p, &[MACHINE_KW, PATTERN_KW, SYSTEM_KW, LAYOUT_KW]).filter(|_| p.peek(1) != ARROW)
}

/// The keyword among these at the cursor.
pub(super) fn keyword(p: &Parser<'_>, kinds: &[SyntaxKind]) -> Option<SyntaxKind> {
    let text = p.token_text();
    kinds.iter().copied().find(|kind| kind.text() == Some(text))
}

/// Takes a word as a keyword, if it stands here.
pub(super) fn eat_word(p: &mut Parser<'_>, kind: SyntaxKind) -> bool {
    let here = keyword(p, &[kind]).is_some();
    if here {
        p.bump_as(kind);
    }
    here
}

/// Takes a word as a keyword, or reports that it is missing.
pub(super) fn expect_word(p: &mut Parser<'_>, kind: SyntaxKind, context: &str) -> bool {
    let here = eat_word(p, kind);
    if !here {
        let found = p.missing();
        p.fault(fault::expected_token(found, kind, context));
    }
    here
}

/// Where an item must start and none does: skips to the next one.
pub(super) fn no_item(p: &mut Parser<'_>, wanted: &str, starts: impl Fn(&Parser<'_>) -> bool) {
    let found = p.found();
    p.fault(fault::expected_shape(found, wanted));
    p.start(ERROR);
    p.bump();
    while !p.at(EOF) && keyword(p, &ENDS).is_none() && !(p.on_new_line() && starts(p)) {
        p.bump();
    }
    p.finish();
}

/// Skips what follows on the line of a fault: it would be told again as something that starts nothing.
pub(super) fn rest_of_line(p: &mut Parser<'_>, starts: impl Fn(&Parser<'_>) -> bool) {
    let goes_on = |p: &Parser<'_>| !p.at(EOF) && !p.on_new_line() && keyword(p, &ENDS).is_none() && !starts(p);
    if !goes_on(p) {
        return;
    }
    p.start(ERROR);
    while goes_on(p) {
        p.bump();
    }
    p.finish();
}

/// A name of any shape.
pub(super) fn shape_name(p: &mut Parser<'_>) -> bool {
    if keyword(p, &ENDS).is_none() {
        return name::generic_name(p);
    }
    let found = p.missing();
    p.fault(fault::expected_name(found, GENERIC_ID));
    false
}

/// The items of a block up to its last word, which is taken.
pub(super) fn block(p: &mut Parser<'_>, end: SyntaxKind, mut item: impl FnMut(&mut Parser<'_>)) {
    // The end of the machine ends a composite state that was left open.
    let outer = |p: &Parser<'_>| end == ENDSTATE_KW && keyword(p, &[ENDMACHINE_KW, ENDPATTERN_KW]).is_some();
    while !p.at(EOF) && keyword(p, &[end]).is_none() && !ends_block_around(p) && !outer(p) {
        p.starts_anew();
        item(p);
    }
    if eat_word(p, end) {
        p.close();
    } else {
        recovery::end(p);
    }
}

/// The next section starts, so the last word of this one was forgotten.
pub(super) fn ends_block_around(p: &Parser<'_>) -> bool {
    let section = section_word(p).is_some();
    section && p.on_new_line() && !matches!(p.peek(1), ARROW | EOF)
}

/// `{term}`, if it is there.
pub(super) fn term_link(p: &mut Parser<'_>) {
    link(p, |p| _ = term::delimited(p, "a term"));
}

/// `{rule}`, if it is there.
pub(super) fn rule_link(p: &mut Parser<'_>) {
    link(p, |p| _ = rule::rule(p, "a rule"));
}

/// `{r_name}`, if it is there.
pub(super) fn rule_name_link(p: &mut Parser<'_>) {
    link(p, |p| _ = name::name(p, RULE_ID));
}

fn link(p: &mut Parser<'_>, content: impl FnOnce(&mut Parser<'_>)) {
    if !p.at(L_BRACE) {
        return;
    }
    p.start(LINK);
    p.bump_opener(R_BRACE);
    content(p);
    recovery::end(p);
    p.finish();
}
