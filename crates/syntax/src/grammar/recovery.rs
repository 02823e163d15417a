//! What the grammar does with faulty text: which fault to report, what to skip, where to go on.
//!
//! Skipped tokens lie in ERROR nodes. The aim is one fault for one mistake. An end that an enclosing construct waits
//! for is never skipped, and text that looks right is parsed even in a wrong place.
//! CIRCLE(grammar)

use super::sets::*;
use super::{domain, list, operator, rule, term};
use crate::SyntaxKind::{self, *};
use crate::fault::{self, Found};
use crate::parser::{Parser, Within};

/// The end of the innermost construct: takes it, or reports that it is missing.
pub(super) fn end(p: &mut Parser<'_>) {
    let Some((end, opener)) = p.innermost() else { return };
    if p.at(end) {
        p.bump_end();
        return;
    }
    let within = p.close();
    let found = if p.at_any(ENDS) { p.found() } else { p.missing() };
    p.fault(fault::missing_end(found, end, opener, within));
    if p.at_any(ENDS) && !p.is_awaited(p.current()) {
        error(p, 1); // an end that nothing waits for: instead of ours, or in excess before ours
        p.eat(end);
    } else if (BRACKET_ENDS.contains(end) || end == GT)
        && !p.on_new_line()
        && let Some(count) = p.find_on_line(end)
    {
        error(p, count);
        p.bump();
    }
}

/// Where a term is expected and none starts. Gives `true` if a term was read after all.
pub(super) fn no_term(p: &mut Parser<'_>, wanted: &str) -> bool {
    let found = p.found();
    match p.current() {
        FORALL_KW | EXISTS_KW if !p.on_new_line() => {
            p.fault(fault::quantifier_parentheses(found));
            p.start(QUANTIFIED_TERM);
            term::quantifier(p);
            p.finish();
            return true;
        }
        RULE_ID if !p.on_new_line() => {
            p.fault(fault::rule_in_term(found));
            p.start(ERROR);
            p.bump();
            match p.current() {
                L_PAREN => _ = list::list(p, R_PAREN, list::Empty::Allowed, |p| term::delimited(p, "an argument")),
                L_BRACKET => _ = list::list(p, R_BRACKET, list::Empty::Allowed, |p| term::delimited(p, "an argument")),
                _ => {}
            }
            p.finish();
            return true;
        }
        DOT if p.peek(1) == INTEGER => p.fault(fault::bare_fraction(found)),
        FUNCTION_ID if operator::is_infix_word(p) => p.fault(fault::no_left_operand(found)),
        EQ | NEQ | LE | GE | GT | STAR | SLASH | CARET => p.fault(fault::no_left_operand(found)),
        _ => p.fault(fault::expected_term(p.missing(), wanted)),
    }
    let word = p.at(FUNCTION_ID) && !operator::is_infix_word(p);
    if word || !p.at_any(TERM_JUNK) || p.at(GT) && p.within == Within::Bag {
        return false;
    }
    error(p, 1);
    let goes_on = p.at_any(TERM_STARTS) || p.at_any(TERM_JUNK);
    goes_on && !p.on_new_line() && term::term(p, wanted)
}

/// `A * B` after a domain: more domains, joined by a mark.
pub(super) fn product_of_domains(p: &mut Parser<'_>) {
    while p.at(STAR) || p.at(ERROR) && fault::replacement(p.token_text()) == Some("*") {
        let found = p.found();
        p.fault(fault::product_of_domains(found));
        p.start(ERROR);
        p.bump();
        domain::domain(p);
        p.finish();
    }
}

/// `<<skip>>`: a rule where its name must stand.
pub(super) fn rule_as_value(p: &mut Parser<'_>) {
    p.start(ERROR);
    p.bump();
    p.bump();
    let found = p.found();
    p.fault(fault::rule_as_value(found));
    rule::rule(p, "the name of a rule");
    if p.eat(GT) {
        p.eat(GT);
    }
    p.finish();
}

/// Where a rule is expected and none starts. Gives `true` if a rule was read after all.
pub(super) fn no_rule(p: &mut Parser<'_>, wanted: &str) -> bool {
    let found = p.missing();
    p.fault(if separates(p) { fault::separator(found) } else { fault::expected_rule(found, wanted) });
    rule_junk(p);
    rule::starts(p) && rule::rule(p, wanted)
}

/// Skips to a token from which rules can go on.
fn rule_junk(p: &mut Parser<'_>) {
    let stops = |p: &Parser<'_>| {
        rule::starts(p) || p.at_any(FENCES) || p.at_any(BLOCK_ENDS) || p.at_any(MIDDLES) || p.ends_command()
    };
    if stops(p) {
        return;
    }
    p.start(ERROR);
    p.bump();
    while !stops(p) && !matches!(p.current(), L_PAREN | L_BRACE) {
        p.bump();
    }
    p.finish();
}

/// In a block: is there one more rule? Skips text that is not one.
pub(super) fn more_rules(p: &mut Parser<'_>, end: SyntaxKind) -> bool {
    loop {
        if p.on_new_line() {
            p.starts_anew();
        }
        if rule::starts(p) || matches!(p.current(), L_PAREN | L_BRACE) {
            return true;
        }
        if p.at(end) || p.ends_command() || p.at_any(FENCES) || belongs_around(p) {
            return false;
        }
        let found = p.found();
        if p.at_any(ENDS) {
            if p.peek(1) != end && !RULE_STARTS.contains(p.peek(1)) {
                return false; // it stands where the block's own end should
            }
            p.fault(fault::stray_end(found));
            error(p, 1);
        } else if p.at_any(MIDDLES) {
            p.fault(fault::stray_word(found));
            error(p, 1);
            rule_junk(p);
        } else {
            p.fault(if separates(p) { fault::separator(found) } else { fault::expected_rule(found, "a rule") });
            rule_junk(p);
        }
    }
}

/// An enclosing construct waits for the token at the cursor.
fn belongs_around(p: &Parser<'_>) -> bool {
    p.is_awaited(match p.current() {
        ELSE_KW | ELSEIF_KW => ENDIF_KW,
        CASE_KW | OTHERWISE_KW => ENDSWITCH_KW,
        kind => kind,
    })
}

fn separates(p: &Parser<'_>) -> bool {
    matches!(p.current(), SEMICOLON | COMMA)
}

/// Words that look like an end of a rule that has no end.
const NO_ENDS: [&str; 7] = ["endchoose", "enddo", "endforall", "endwhile", "endextend", "endrule", "endfor"];

/// After a rule: a mark or a word that other languages put there.
pub(super) fn behind_rule(p: &mut Parser<'_>) {
    let found = p.found();
    if p.at(SEMICOLON) && !p.in_scenario {
        p.fault(fault::separator(found));
    } else if p.at(FUNCTION_ID) && NO_ENDS.contains(&found.text) && !matches!(p.peek(1), ASSIGN | L_PAREN) {
        p.fault(fault::no_such_end(found));
    } else {
        return;
    }
    error(p, 1);
}

/// Rules in parentheses or braces.
pub(super) fn bracketed_rule(p: &mut Parser<'_>) {
    let found = p.found();
    p.fault(fault::bracketed_rule(found));
    let close = if p.at(L_PAREN) { R_PAREN } else { R_BRACE };
    p.start(ERROR);
    p.bump_opener(close);
    while more_rules(p, close) {
        rule::rule(p, "a rule");
    }
    end(p);
    p.finish();
}

/// After the one rule of a branch: reports further rules and keeps them out of the way.
pub(super) fn several_rules(p: &mut Parser<'_>) {
    let Some((end, opener)) = p.innermost() else { return };
    if !rule::starts(p) {
        return;
    }
    if p.is_left_of_innermost() {
        let found = p.missing(); // by its indentation this is a neighbour of the construct
        p.fault(fault::missing_end(found, end, opener, p.crooked_within_innermost()));
        return;
    }
    more_than_one(p, opener);
}

/// After the body of a rule's declaration: the same.
pub(super) fn several_bodies(p: &mut Parser<'_>, declaration: Found<'_>) {
    if rule::starts(p) {
        more_than_one(p, declaration);
    }
}

fn more_than_one(p: &mut Parser<'_>, opener: Found<'_>) {
    let found = p.found();
    p.fault(fault::several_rules(found, opener));
    p.start(ERROR);
    while rule::starts(p) {
        rule::rule(p, "a rule");
    }
    p.finish();
}

/// After a term that stands as a rule: an operator shows that an update, or nothing, was meant.
pub(super) fn term_as_rule(p: &mut Parser<'_>) {
    let found = p.found();
    if p.at(COLON) && p.peek(1) == EQ {
        p.fault(fault::equals_for_assign(found));
        error(p, 2);
        term::term(p, "the new value");
    } else if matches!(p.current(), PLUS | MINUS | STAR | SLASH) && p.peek(1) == EQ && p.touches_next() {
        p.fault(fault::compound_assignment(found));
        error(p, 2);
        term::term(p, "the new value");
    } else if operator::infix_power(p).is_some() && !p.on_new_line() {
        p.fault(fault::term_as_rule(found));
        p.start(ERROR);
        p.bump();
        term::term(p, "a term");
        p.finish();
    }
}

/// After `<-`, where no call of a turbo rule stands.
pub(super) fn no_turbo_call(p: &mut Parser<'_>) {
    let found = p.missing();
    p.fault(fault::expected_rule(found, "a call of a turbo rule, as `r_x(…)`, behind `<-`"));
    if p.at(RULE_ID) {
        rule::call(p);
    } else if p.at_any(TERM_STARTS) && !p.on_new_line() {
        p.start(ERROR);
        term::term(p, "a call of a turbo rule");
        p.finish();
    }
}

/// Before the next item of a section: at a word that starts an item, earlier trouble is over.
pub(super) fn item(p: &mut Parser<'_>) {
    if p.at_any(FENCES) {
        p.starts_anew();
    }
}

/// Where a definition, a declaration or an initial value is expected and none starts: skips to the next one.
pub(super) fn no_definition(p: &mut Parser<'_>, wanted: &str) {
    let found = p.found();
    p.fault(match found.kind {
        _ if separates(p) => fault::separator(found),
        kind if ENDS.contains(kind) => fault::stray_end(found),
        _ => fault::expected_definition(found, wanted),
    });
    p.start(ERROR);
    p.bump();
    while !p.at_any(FENCES) {
        p.bump();
    }
    p.finish();
}

/// At the start of a file that has none: skips to the first word that a section or an item of one starts with.
pub(super) fn no_head(p: &mut Parser<'_>) {
    p.start(ERROR);
    while !p.at_any(FENCES) {
        p.bump();
    }
    p.finish();
}

/// After the last thing of a file.
pub(super) fn rest_of_file(p: &mut Parser<'_>) {
    if p.at(EOF) {
        return;
    }
    let found = p.found();
    p.fault(fault::unexpected_text(found));
    p.start(ERROR);
    while !p.at(EOF) {
        p.bump();
    }
    p.finish();
}

/// Where [`Parser::enter`] refused: skips the construct and leaves the level again.
pub(super) fn too_deep(p: &mut Parser<'_>) -> bool {
    chain_too_long(p);
    p.leave();
    true
}

/// Skips up to the end that an enclosing construct waits for.
pub(super) fn chain_too_long(p: &mut Parser<'_>) {
    let found = p.found();
    p.fault_once(fault::nested_too_deeply(found));
    p.start(ERROR);
    let mut nested = 0usize;
    let mut first = true;
    while (first || !p.at_any(FENCES)) && !p.ends_command() {
        if p.at_any(OPENERS) {
            nested += 1;
        } else if p.at_any(ENDS) {
            if nested == 0 {
                break;
            }
            nested -= 1;
        }
        first = false;
        p.bump();
    }
    p.finish();
}

/// Takes this many tokens into an ERROR node.
pub(super) fn error(p: &mut Parser<'_>, count: usize) {
    p.start(ERROR);
    for _ in 0..count {
        p.bump();
    }
    p.finish();
}
