//! What the grammar does where the text is faulty: which fault to report, what to skip, where to go on.
//!
//! Skipped tokens lie in ERROR nodes. The aim is one fault for one mistake: an end that a construct around waits for
//! is never skipped, and text that looks right is parsed even in a wrong place.

use super::{list, operator, rule, term};
use crate::SyntaxKind::{self, *};
use crate::fault::{self, Found};
use crate::parser::{Parser, Within};
use crate::token_set::TokenSet;

/// Words that a section of a file starts with.
pub(super) const SECTION_STARTS: TokenSet = TokenSet::new(&[
    IMPORT_KW,
    EXPORT_KW,
    SIGNATURE_KW,
    DEFINITIONS_KW,
    MAIN_KW,
    DEFAULT_KW,
    INIT_KW,
    ASM_KW,
    MODULE_KW,
    ASYNCR_KW,
    EOF,
]);
/// Words that a definition starts with.
pub(super) const DEFINITION_STARTS: TokenSet = TokenSet::new(&[
    DOMAIN_KW,
    FUNCTION_KW,
    RULE_KW,
    MACRO_KW,
    TURBO_KW,
    INVAR_KW,
    JUSTICE_KW,
    FAIRNESS_KW,
    COMPASSION_KW,
    INVARIANT_KW,
    CTLSPEC_KW,
    LTLSPEC_KW,
]);
/// Words that a declaration of the signature starts with.
pub(super) const DECLARATION_STARTS: TokenSet = TokenSet::new(&[
    ANYDOMAIN_KW,
    BASIC_KW,
    ABSTRACT_KW,
    ENUM_KW,
    DYNAMIC_KW,
    STATIC_KW,
    DERIVED_KW,
    MONITORED_KW,
    CONTROLLED_KW,
    SHARED_KW,
    OUT_KW,
    DOMAIN_KW,
]);
/// Words that no rule and no term holds: a faulty one ends there at the latest.
const FENCES: TokenSet =
    SECTION_STARTS.union(DEFINITION_STARTS).union(DECLARATION_STARTS).union(TokenSet::new(&[AGENT_KW]));

/// Tokens that a rule starts with.
pub(super) const RULE_STARTS: TokenSet = TokenSet::new(&[
    SKIP_KW,
    PAR_KW,
    SEQ_KW,
    ITERATE_KW,
    IF_KW,
    SWITCH_KW,
    LET_KW,
    CHOOSE_KW,
    FORALL_KW,
    EXTEND_KW,
    WHILE_KW,
    WHILEREC_KW,
    LOCAL_KW,
    RULE_ID,
    FUNCTION_ID,
    VARIABLE,
]);
const BLOCK_ENDS: TokenSet = TokenSet::new(&[ENDPAR_KW, ENDSEQ_KW, ENDITERATE_KW, ENDIF_KW, ENDSWITCH_KW, ENDLET_KW]);
const BRACKET_ENDS: TokenSet = TokenSet::new(&[R_PAREN, R_BRACKET, R_BRACE]);
const ENDS: TokenSet = BLOCK_ENDS.union(BRACKET_ENDS);
const OPENERS: TokenSet =
    TokenSet::new(&[PAR_KW, SEQ_KW, ITERATE_KW, IF_KW, SWITCH_KW, LET_KW, L_PAREN, L_BRACKET, L_BRACE]);
/// Words between the parts of a construct.
const MIDDLES: TokenSet =
    TokenSet::new(&[THEN_KW, ELSE_KW, ELSEIF_KW, CASE_KW, OTHERWISE_KW, DO_KW, IFNONE_KW, IN_KW, WITH_KW]);
/// Tokens that are skipped where a term is missing; all others may belong to what is around.
const TERM_JUNK: TokenSet = TokenSet::new(&[
    GENERIC_ID,
    INVARIANT_ID,
    CTL_ID,
    LTL_ID,
    STAR,
    SLASH,
    CARET,
    EQ,
    NEQ,
    GE,
    LE,
    GT,
    DOT,
    ERROR,
    ASSIGN,
    FUNCTION_ID,
]);

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
    let goes_on = p.at_any(term::STARTS) || p.at_any(TERM_JUNK);
    goes_on && !p.on_new_line() && term::term(p, wanted)
}

/// Where a rule is expected and none starts. Gives `true` if a rule was read after all.
pub(super) fn no_rule(p: &mut Parser<'_>, wanted: &str) -> bool {
    let found = p.missing();
    p.fault(if found.kind == SEMICOLON { fault::separator(found) } else { fault::expected_rule(found, wanted) });
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
    while !stops(p) {
        p.bump();
    }
    p.finish();
}

/// In a block: is there one more rule? Skips what is none.
pub(super) fn more_rules(p: &mut Parser<'_>, end: SyntaxKind) -> bool {
    loop {
        if p.at(end) || p.ends_command() {
            return false;
        }
        if rule::starts(p) || p.at(DYNAMIC_KW) && p.peek(1) == LOCAL_KW {
            return true;
        }
        let found = p.found();
        let awaited = match p.current() {
            kind if FENCES.contains(kind) => return false,
            ELSE_KW | ELSEIF_KW => p.is_awaited(ENDIF_KW),
            CASE_KW | OTHERWISE_KW => p.is_awaited(ENDSWITCH_KW),
            kind => p.is_awaited(kind),
        };
        if awaited {
            return false;
        }
        if p.at_any(ENDS) {
            if !(p.peek(1) == end || RULE_STARTS.contains(p.peek(1))) {
                return false; // it stands where the block's own end should
            }
            p.fault(fault::stray_end(found));
            error(p, 1);
        } else if p.at_any(MIDDLES) {
            p.fault(fault::expected_rule(found, "a rule"));
            error(p, 1);
        } else if no_rule_read(p) {
            continue;
        }
    }
}

fn no_rule_read(p: &mut Parser<'_>) -> bool {
    let found = p.found();
    p.fault(match found.kind {
        SEMICOLON | COMMA => fault::separator(found),
        _ => fault::expected_rule(found, "a rule"),
    });
    rule_junk(p);
    true
}

/// Behind the one rule of a branch: reports further rules and keeps them out of the way.
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

/// Behind the body of a rule's declaration: the same.
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

/// Behind a term that stands as a rule: an operator shows that an update, or nothing, was meant.
pub(super) fn term_as_rule(p: &mut Parser<'_>) {
    let found = p.found();
    if p.at(COLON) && p.peek(1) == EQ {
        p.fault(fault::equals_for_assign(found));
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

/// Behind `<-`, where no call of a turbo rule stands.
pub(super) fn no_turbo_call(p: &mut Parser<'_>) {
    let found = p.missing();
    p.fault(fault::expected_rule(found, "a call of a turbo rule, `r_x(…)`, behind `<-`"));
    if p.at(RULE_ID) {
        rule::call(p);
    } else if p.at_any(term::STARTS) && !p.on_new_line() {
        p.start(ERROR);
        term::term(p, "a call of a turbo rule");
        p.finish();
    }
}

/// Where a definition, a declaration or an initial value is expected and none starts: skips to the next one.
pub(super) fn no_definition(p: &mut Parser<'_>, wanted: &str) {
    let found = p.found();
    p.fault(match found.kind {
        SEMICOLON | COMMA => fault::separator(found),
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

/// Behind the last thing of a file.
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

/// Skips up to the end that a construct around waits for.
pub(super) fn chain_too_long(p: &mut Parser<'_>) {
    let found = p.found();
    p.fault_once(fault::nested_too_deeply(found));
    p.start(ERROR);
    let mut nested = 0usize;
    let mut first = true;
    while !(p.at_any(FENCES) && !first) && !p.ends_command() {
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

/// Takes so many tokens into an ERROR node.
pub(super) fn error(p: &mut Parser<'_>, count: usize) {
    p.start(ERROR);
    for _ in 0..count {
        p.bump();
    }
    p.finish();
}
