//! Scenarios: the language Avalla (spec/avalla.md).
//!
//! Its words are not keywords of the lexer: each is an ordinary name, so a model may have a function `step`. The
//! grammar takes them as keywords where a command starts.

use super::sets::TERM_STARTS;
use super::term::{location, term};
use super::{domain, list, name, recovery, rule};
use crate::SyntaxKind::{self, *};
use crate::fault;
use crate::parser::Parser;

/// A whole scenario file.
pub(crate) fn scenario_file(p: &mut Parser<'_>) {
    header(p);
    while !p.at(EOF) {
        if !command(p) {
            no_command(p);
        }
    }
}

/// `scenario NAME load PATH`
fn header(p: &mut Parser<'_>) {
    if word(p, "scenario", SCENARIO_KW) {
        name::generic_name(p);
    }
    load(p);
    p.eat(SEMICOLON);
}

fn load(p: &mut Parser<'_>) {
    if word(p, "load", LOAD_KW) && !p.eat(STRING) {
        p.expect(MODULE_REF, "behind `load`");
    }
}

/// Takes a word as a keyword, or reports that it is missing.
fn word(p: &mut Parser<'_>, text: &str, kind: SyntaxKind) -> bool {
    if p.at_word(text) {
        p.bump_as(kind);
        return true;
    }
    let found = p.found();
    p.fault(fault::expected_token(found, kind, "in the head of the scenario"));
    false
}

/// The kind of the command that starts at the cursor.
fn command_word(p: &Parser<'_>) -> Option<SyntaxKind> {
    if p.at(INVARIANT_KW) {
        return Some(INVARIANT_KW);
    }
    if !p.at(FUNCTION_ID) {
        return None;
    }
    Some(match p.token_text() {
        "check" => CHECK_KW,
        "strict" => STRICT_KW,
        "set" => SET_KW,
        "step" => STEP_KW,
        "exec" => EXEC_KW,
        "pick" => PICK_KW,
        "begin" => BEGIN_KW,
        "execblock" => EXECBLOCK_KW,
        "expect" => EXPECT_KW,
        _ => return None,
    })
}

/// One command; `false` if the cursor is not at one.
fn command(p: &mut Parser<'_>) -> bool {
    let Some(kind) = command_word(p) else { return false };
    match kind {
        CHECK_KW | STRICT_KW => check(p, kind),
        SET_KW => set(p),
        STEP_KW => step(p),
        EXEC_KW => exec(p),
        PICK_KW => pick(p),
        BEGIN_KW => block(p),
        EXECBLOCK_KW => execblock(p),
        EXPECT_KW => expect(p),
        _ => invariant(p),
    }
    true
}

/// `invariant NAME: term;`
fn invariant(p: &mut Parser<'_>) {
    p.start(SCENARIO_INVARIANT);
    p.bump();
    name::generic_name(p);
    if p.expect(COLON, "behind the name of the invariant") {
        term(p, "a formula");
    }
    semicolon(p);
    p.finish();
}

/// `[strict] check term;`
fn check(p: &mut Parser<'_>, kind: SyntaxKind) {
    p.start(CHECK_COMMAND);
    p.bump_as(kind);
    if kind == STRICT_KW {
        if p.at_word("check") {
            p.bump_as(CHECK_KW);
        } else {
            p.expect(CHECK_KW, "behind `strict`");
        }
    }
    term(p, "a formula");
    semicolon(p);
    p.finish();
}

/// `set location := term;`
fn set(p: &mut Parser<'_>) {
    p.start(SET_COMMAND);
    p.bump_as(SET_KW);
    location(p);
    let found = p.found();
    if p.at(EQ) {
        p.fault(fault::equals_for_assign(found));
        p.bump();
        term(p, "a value");
    } else if p.expect(ASSIGN, "behind the location that is set") || p.at_any(TERM_STARTS) && !p.on_new_line() {
        term(p, "a value");
    }
    semicolon(p);
    p.finish();
}

/// `step`, `step N`, `step until term [within N];`
fn step(p: &mut Parser<'_>) {
    let checkpoint = p.checkpoint();
    p.bump_as(STEP_KW);
    if p.at_word("until") {
        p.start_at(checkpoint, STEP_UNTIL_COMMAND);
        p.bump_as(UNTIL_KW);
        term(p, "a condition");
        if p.at_word("within") {
            p.bump_as(WITHIN_KW);
            p.expect(INTEGER, "behind `within`");
        }
        semicolon(p);
    } else {
        p.start_at(checkpoint, STEP_COMMAND);
        p.eat(INTEGER);
        p.eat(SEMICOLON);
    }
    p.finish();
}

/// `exec rule;`
fn exec(p: &mut Parser<'_>) {
    p.start(EXEC_COMMAND);
    p.bump_as(EXEC_KW);
    rule::rule(p, "a rule behind `exec`");
    semicolon(p);
    p.finish();
}

/// `pick $x [in r_R(D)] := term;`
fn pick(p: &mut Parser<'_>) {
    p.start(PICK_COMMAND);
    p.bump_as(PICK_KW);
    name::name(p, VARIABLE);
    if p.eat(IN_KW) && name::name(p, RULE_ID) && p.at(L_PAREN) {
        list::list(p, R_PAREN, list::Empty::Allowed, domain::domain);
    }
    if p.expect(ASSIGN, "before the value that is picked") {
        term(p, "a value");
    }
    semicolon(p);
    p.finish();
}

/// `begin NAME … end`
fn block(p: &mut Parser<'_>) {
    if !p.enter() {
        recovery::too_deep(p);
        return;
    }
    p.start(BLOCK);
    p.bump_opener_as(BEGIN_KW, END_KW);
    name::generic_name(p);
    while !p.at(EOF) && !p.at_word("end") {
        if !command(p) {
            no_command(p);
        }
    }
    if p.at_word("end") {
        p.bump_as(END_KW);
        p.close();
    } else {
        recovery::end(p);
    }
    p.eat(SEMICOLON);
    p.finish();
    p.leave();
}

/// `execblock [FILE:]NAME;`
fn execblock(p: &mut Parser<'_>) {
    p.start(EXECBLOCK_COMMAND);
    p.bump_as(EXECBLOCK_KW);
    if name::generic_name(p) {
        if p.at(DOT) && p.touches_next() {
            let found = p.found();
            p.fault(fault::dot_in_block_name(found));
            p.bump_as(COLON);
            name::generic_name(p);
        } else if p.eat(COLON) {
            name::generic_name(p);
        }
    }
    semicolon(p);
    p.finish();
}

/// `expect failure [by …];` for the whole scenario, or `expect inconsistent update;`, `expect error;` for one step.
fn expect(p: &mut Parser<'_>) {
    let checkpoint = p.checkpoint();
    p.bump_as(EXPECT_KW);
    if p.at_word("failure") {
        p.start_at(checkpoint, SCENARIO_EXPECT);
        p.bump();
        if p.at_word("by") {
            p.bump();
            trouble(p, true);
        }
    } else {
        p.start_at(checkpoint, EXPECT_STEP_COMMAND);
        trouble(p, false);
    }
    semicolon(p);
    p.finish();
}

/// `inconsistent update`, `error`; for a whole scenario also `check`, `invariant [NAME]`
fn trouble(p: &mut Parser<'_>, whole: bool) {
    if p.at_word("inconsistent") {
        p.bump();
        if p.at_word("update") {
            p.bump();
            return;
        }
    } else if p.at_word("error") {
        p.bump();
        return;
    } else if whole && p.at_word("check") {
        p.bump_as(CHECK_KW);
        return;
    } else if whole && p.at(INVARIANT_KW) {
        p.bump();
        if !p.at(SEMICOLON) {
            name::generic_name(p);
        }
        return;
    }
    let found = p.found();
    p.fault(fault::unknown_trouble(found, whole));
}

/// The `;` that ends a command; skips to it, or to the next command.
fn semicolon(p: &mut Parser<'_>) {
    if p.eat(SEMICOLON) {
        return;
    }
    p.expect(SEMICOLON, "at the end of the command");
    skip_command(p);
}

fn no_command(p: &mut Parser<'_>) {
    let found = p.found();
    p.fault(fault::expected_command(found));
    if p.at_word("load") {
        load(p); // too late, but the model is known
    } else if !p.eat(SEMICOLON) {
        p.start(ERROR);
        p.bump();
        p.finish();
        skip_command(p);
    }
}

fn skip_command(p: &mut Parser<'_>) {
    let stops = |p: &Parser<'_>| p.ends_command() || p.on_new_line() && command_word(p).is_some() || p.at_word("end");
    if !stops(p) {
        p.start(ERROR);
        while !stops(p) {
            p.bump();
        }
        p.finish();
    }
    p.eat(SEMICOLON);
}

#[cfg(test)]
mod tests {
    use crate::grammar::brief::scenario;
    use expect_test::{Expect, expect};

    fn check(text: &str, expected: Expect) {
        expected.assert_eq(&scenario(text));
    }

    #[test]
    fn heads() {
        check("scenario s load a.asm", expect!["scenario s load a.asm"]);
        check(r#"scenario s load "a b.asm""#, expect![[r#"scenario s load "a b.asm""#]]);
        check("scenario s.avalla load ../a/B.asm", expect!["scenario s.avalla load ../a/B.asm"]);
        check("scenario load load load", expect!["scenario load load load"]);
        check("// nothing", expect!["!expected-token"]);
    }

    #[test]
    fn commands() {
        check(
            "scenario s load a check a = 1; strict check b; set f(1) := 2; step step 3 step until a within 4; step until b; exec par skip skip endpar; exec r_x[]; pick $x in r_a(D) := 1; pick $x := RED; begin b check a; begin c step end end execblock b; execblock f:b;",
            expect![[r#"
            scenario
            s
            load
            a
            CHECK(check BINARY(a = 1) ;)
            CHECK(strict check b ;)
            SET(set FUNCTION(f ARGUMENT_LIST(( 1 ))) := 2 ;)
            STEP(step)
            STEP(step 3)
            STEP_UNTIL(step until a within 4 ;)
            STEP_UNTIL(step until b ;)
            EXEC(exec PAR(par SKIP(skip) SKIP(skip) endpar) ;)
            EXEC(exec MACRO_CALL(r_x ARGUMENT_LIST([ ])) ;)
            PICK(pick $x in r_a ( D ) := 1 ;)
            PICK(pick $x := RED ;)
            BLOCK(begin b CHECK(check a ;) BLOCK(begin c STEP(step) end) end)
            EXECBLOCK(execblock b ;)
            EXECBLOCK(execblock f : b ;)"#]],
        );
    }

    #[test]
    fn expectations() {
        check(
            "scenario s load a expect failure; expect failure by check; expect failure by invariant inv_x; expect failure by invariant; expect failure by inconsistent update; expect failure by error; invariant inv_x: a; expect inconsistent update; expect error;",
            expect![[r#"
            scenario
            s
            load
            a
            SCENARIO_EXPECT(expect failure ;)
            SCENARIO_EXPECT(expect failure by check ;)
            SCENARIO_EXPECT(expect failure by invariant inv_x ;)
            SCENARIO_EXPECT(expect failure by invariant ;)
            SCENARIO_EXPECT(expect failure by inconsistent update ;)
            SCENARIO_EXPECT(expect failure by error ;)
            SCENARIO_INVARIANT(invariant inv_x : a ;)
            EXPECT_STEP(expect inconsistent update ;)
            EXPECT_STEP(expect error ;)"#]],
        );
    }

    #[test]
    fn words_as_names() {
        check(
            "scenario step load a set step := check; check set(1) = until and step;",
            expect![[r#"
            scenario
            step
            load
            a
            SET(set step := check ;)
            CHECK(
              check
              BINARY(BINARY(FUNCTION(set ARGUMENT_LIST(( 1 ))) = until) and step)
              ;)"#]],
        );
    }

    #[test]
    fn faults() {
        check("check a;", expect!["CHECK(check a ;) !expected-token"]);
        check("scenario s check a;", expect!["scenario s CHECK(check a ;) !expected-token"]);
        check(
            "scenario s load a check a step",
            expect!["scenario s load a CHECK(check a ERROR(step)) !expected-token"],
        );
        check(
            "scenario s load a set a = 1; set b 2; set := 3;",
            expect![[r#"
            scenario
            s
            load
            a
            SET(set a = 1 ;)
            SET(set b 2 ;)
            SET(set := 3 ;)
            !equals-for-assign
            !expected-token
            !expected-term"#]],
        );
        check(
            "scenario s load a foo; check ; step until; end",
            expect![[r#"
            scenario
            s
            load
            a
            ERROR(foo)
            ;
            CHECK(check ;)
            STEP_UNTIL(step until ;)
            ERROR(end)
            !expected-command
            !expected-term
            !expected-term
            !expected-command"#]],
        );
        check("scenario s load a begin b step", expect!["scenario s load a BLOCK(begin b STEP(step)) !missing-end"]);
        check(
            "scenario s load a expect nothing; expect failure by luck; expect inconsistent;",
            expect![[r#"
            scenario
            s
            load
            a
            EXPECT_STEP(expect ERROR(nothing) ;)
            SCENARIO_EXPECT(expect failure by ERROR(luck) ;)
            EXPECT_STEP(expect inconsistent ;)
            !expected-command
            !expected-command
            !expected-command"#]],
        );
        check(
            "scenario s load a execblock a.b; pick x := 1; exec if a then b := 1; step",
            expect![[r#"
            scenario
            s
            load
            a
            EXECBLOCK(execblock a . b ;)
            PICK(pick x := 1 ;)
            EXEC(exec IF(if CONDITIONAL_BRANCH(a then UPDATE(b := 1))) ;)
            STEP(step)
            !expected-token
            !name-class
            !missing-end"#]],
        );
        check(
            "scenario s load a check x == 1; check (1;",
            expect![[r#"
            scenario
            s
            load
            a
            CHECK(check BINARY(x == 1) ;)
            CHECK(check PAREN(( 1) ;)
            !foreign-operator
            !missing-end"#]],
        );
        check(
            "invariant inv_a: b; scenario",
            expect![[r#"
            SCENARIO_INVARIANT(invariant inv_a : b ;)
            ERROR(scenario)
            !expected-token
            !expected-command"#]],
        );
    }
}
