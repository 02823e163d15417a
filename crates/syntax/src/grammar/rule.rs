//! Rules and their declarations (spec/language.md, sections 5 and 7).

use super::conditional::Body;
use super::recovery::{self, RULE_STARTS};
use super::term::{delimited, location, term};
use super::{binding, conditional, domain, function, list, name};
use crate::SyntaxKind::{self, *};
use crate::fault;
use crate::parser::Parser;

/// `[macro | turbo] rule r_x($p in D) [in C] = R`
pub(super) fn declaration(p: &mut Parser<'_>) {
    p.start(RULE_DECL);
    let opener = p.found();
    if !p.eat(MACRO_KW) {
        p.eat(TURBO_KW);
    }
    if p.expect(RULE_KW, "in the declaration of a rule") && name::name(p, RULE_ID) {
        function::parameters(p);
        if p.eat(IN_KW) {
            domain::domain(p);
        }
        behind(p, EQ, "before the body of the rule", "the body of the rule");
        recovery::several_bodies(p, opener);
    }
    p.finish();
}

/// Words that look like the end of a rule that has none.
const NO_ENDS: [&str; 7] = ["endchoose", "enddo", "endforall", "endwhile", "endextend", "endrule", "endfor"];

/// A rule.
pub(super) fn rule(p: &mut Parser<'_>, wanted: &str) -> bool {
    if !p.enter() {
        return recovery::too_deep(p);
    }
    let found = rule_here(p, wanted);
    if p.at(SEMICOLON) && !p.in_scenario {
        let mark = p.found();
        p.fault(fault::separator(mark));
        recovery::error(p, 1);
    }
    p.leave();
    found
}

fn rule_here(p: &mut Parser<'_>, wanted: &str) -> bool {
    match p.current() {
        SKIP_KW => {
            p.start(SKIP_RULE);
            p.bump();
            p.finish();
        }
        PAR_KW => block(p, PAR_RULE, ENDPAR_KW),
        SEQ_KW => block(p, SEQ_RULE, ENDSEQ_KW),
        ITERATE_KW => block(p, ITERATE_RULE, ENDITERATE_KW),
        IF_KW => conditional::if_construct(p, IF_RULE, BRANCH),
        SWITCH_KW => conditional::switch_construct(p, SWITCH_RULE, BRANCH),
        LET_KW => binding::let_construct(p, LET_RULE, BRANCH),
        CHOOSE_KW => ranging(p, CHOOSE_RULE),
        FORALL_KW => ranging(p, FORALL_RULE),
        EXTEND_KW => extend(p),
        WHILE_KW => repeat(p, WHILE_RULE),
        WHILEREC_KW => repeat(p, RECURSIVE_WHILE_RULE),
        LOCAL_KW => local(p),
        DYNAMIC_KW if p.peek(1) == LOCAL_KW => local(p),
        RULE_ID => call(p),
        FUNCTION_ID if NO_ENDS.contains(&p.token_text()) && !matches!(p.peek(1), ASSIGN | L_PAREN) => {
            let found = p.found();
            p.fault(fault::no_such_end(found));
            recovery::error(p, 1);
        }
        FUNCTION_ID | VARIABLE => update(p),
        ENUM_ID | DOMAIN_ID if p.peek(1) == ASSIGN => update(p),
        _ => return recovery::no_rule(p, wanted),
    }
    true
}

/// The rule of a branch, which an end mark follows.
const BRANCH: Body = Body {
    parse: |p, wanted| {
        rule(p, wanted);
        recovery::several_rules(p);
    },
    starts,
};

/// The rule behind a keyword or mark; where that is missing, a rule that stands there is read all the same.
fn behind(p: &mut Parser<'_>, keyword: SyntaxKind, context: &str, wanted: &str) {
    if p.expect(keyword, context) || starts(p) {
        rule(p, wanted);
    }
}

/// `par R S endpar`, `seq R S endseq`, `iterate R enditerate`
fn block(p: &mut Parser<'_>, kind: SyntaxKind, end: SyntaxKind) {
    p.start(kind);
    p.bump_opener(end);
    while recovery::more_rules(p, end) {
        rule(p, "a rule");
    }
    recovery::end(p);
    p.finish();
}

/// `choose $x in D with c do R ifnone S`, `forall $x in D with c do R`
fn ranging(p: &mut Parser<'_>, kind: SyntaxKind) {
    p.start(kind);
    p.bump();
    binding::binders(p);
    if p.eat(WITH_KW) {
        delimited(p, "a condition");
    }
    behind(p, DO_KW, "before the rule", "the rule behind `do`");
    if kind == CHOOSE_RULE && p.eat(IFNONE_KW) {
        rule(p, "the rule behind `ifnone`");
    }
    p.finish();
}

/// `extend D with $x, $y do R`
fn extend(p: &mut Parser<'_>) {
    p.start(EXTEND_RULE);
    p.bump();
    if name::domain_name(p) && p.expect(WITH_KW, "behind the domain that is extended") {
        while name::name(p, VARIABLE) && p.eat(COMMA) {}
        behind(p, DO_KW, "before the rule", "the rule behind `do`");
    }
    p.finish();
}

/// `while c do R`, `whilerec c do R`
fn repeat(p: &mut Parser<'_>, kind: SyntaxKind) {
    p.start(kind);
    p.bump();
    delimited(p, "a condition");
    behind(p, DO_KW, "behind the condition", "the rule behind `do`");
    p.finish();
}

/// `local f: D -> C [R] … S`
fn local(p: &mut Parser<'_>) {
    p.start(LOCAL_RULE);
    while p.at(LOCAL_KW) || p.at(DYNAMIC_KW) && p.peek(1) == LOCAL_KW {
        p.start(LOCAL_DECL);
        p.eat(DYNAMIC_KW);
        p.bump();
        function::name_and_domains(p);
        if p.at(L_BRACKET) {
            p.bump_opener(R_BRACKET);
            rule(p, "the rule that initialises the local function");
            recovery::end(p);
        } else {
            p.expect(L_BRACKET, "before the rule that initialises the local function");
        }
        p.finish();
    }
    rule(p, "the rule that the functions are local to");
    p.finish();
}

/// `r_x[a, b]`, `r_x(a, b)`
pub(super) fn call(p: &mut Parser<'_>) {
    let kind = if p.peek(1) == L_PAREN { TURBO_CALL_RULE } else { MACRO_CALL_RULE };
    p.start(kind);
    let found = p.found();
    p.bump();
    match p.current() {
        L_PAREN => arguments(p, R_PAREN),
        L_BRACKET => arguments(p, R_BRACKET),
        ASSIGN | EQ => {
            p.fault(fault::name_class(found, FUNCTION_ID));
            p.bump();
            term(p, "the new value");
        }
        _ => p.fault_before(fault::missing_brackets(found)),
    }
    p.finish();
}

fn arguments(p: &mut Parser<'_>, close: SyntaxKind) {
    p.start(ARGUMENT_LIST);
    list::list(p, close, list::Empty::Allowed, |p| delimited(p, "an argument"));
    p.finish();
}

/// `f(a) := b`, `f(a) <- r_x(b)`, `f(a)`, `$r[a]`
fn update(p: &mut Parser<'_>) {
    let checkpoint = p.checkpoint();
    if matches!(p.current(), ENUM_ID | DOMAIN_ID) {
        let found = p.found();
        p.fault(fault::name_class(found, FUNCTION_ID));
        p.start(FUNCTION_TERM);
        p.bump();
        p.finish();
    } else {
        location(p);
    }
    let kind = match p.current() {
        ASSIGN => {
            p.bump();
            term(p, "the new value");
            UPDATE_RULE
        }
        EQ => {
            let found = p.found();
            p.fault(fault::equals_for_assign(found));
            p.bump();
            term(p, "the new value");
            UPDATE_RULE
        }
        RETURN_ARROW => {
            p.bump();
            if p.at(RULE_ID) && p.peek(1) == L_PAREN {
                call(p);
            } else {
                recovery::no_turbo_call(p);
            }
            RETURN_RULE
        }
        L_BRACKET => {
            arguments(p, R_BRACKET);
            TERM_RULE
        }
        _ => {
            recovery::term_as_rule(p);
            TERM_RULE
        }
    };
    p.start_at(checkpoint, kind);
    p.finish();
}

/// The cursor is at a rule.
pub(super) fn starts(p: &Parser<'_>) -> bool {
    p.at_any(RULE_STARTS) && !(p.at(FUNCTION_ID) && super::operator::is_infix_word(p))
}
