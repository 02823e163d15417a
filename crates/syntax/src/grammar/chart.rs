//! Charts: machines and patterns with their shapes, paths and layout (spec/charts.md). Systems are in `system`.
//!
//! Like those of scenarios, the words of charts are not keywords of the lexer. The grammar takes them as keywords where
//! an item starts, so a linked model may have a function `state`. The text in the braces of a link is AsmetaL.

use super::chart_part::{
    ENDS, block, eat_word, ends_block_around, expect_word, keyword, no_item, rule_link, rule_name_link, section_word,
    shape_name, term_link,
};
use super::{function, list, system, term};
use crate::SyntaxKind::{self, *};
use crate::fault;
use crate::limit::MAX_COMPOSITES;
use crate::parser::Parser;

/// A whole chart file.
pub(crate) fn chart_file(p: &mut Parser<'_>) {
    if p.at(EOF) {
        return;
    }
    if p.at_word("chart") {
        p.bump_as(CHART_KW);
        shape_name(p);
    } else {
        let found = p.found();
        p.fault(fault::expected_token(found, CHART_KW, "at the start of the file"));
    }
    while !p.at(EOF) {
        p.starts_anew();
        match section_word(p) {
            Some(IMPORT_KW) => import(p),
            Some(MACHINE_KW) => machine(p, MACHINE_KW, ENDMACHINE_KW),
            Some(PATTERN_KW) => machine(p, PATTERN_KW, ENDPATTERN_KW),
            Some(SYSTEM_KW) => system::system(p),
            Some(LAYOUT_KW) => layout(p),
            _ => no_item(p, "a machine, pattern, system or layout", |p| section_word(p).is_some()),
        }
    }
}

/// `import PATH`
fn import(p: &mut Parser<'_>) {
    p.start(IMPORT);
    p.bump();
    if !p.eat(STRING) {
        p.expect(MODULE_REF, "behind `import`");
    }
    p.finish();
}

/// `machine NAME ($x in D) "text" {r_rule} … endmachine`, and the same for a pattern.
fn machine(p: &mut Parser<'_>, kind: SyntaxKind, end: SyntaxKind) {
    p.start(MACHINE_CHART);
    p.bump_opener_as(kind, end);
    shape_name(p);
    function::parameters(p);
    p.eat(STRING);
    rule_name_link(p);
    block(p, end, item);
    p.finish();
}

const ITEMS: [SyntaxKind; 12] = [
    CONTROL_KW,
    INITIAL_KW,
    COMPOSITE_KW,
    STATE_KW,
    GUARD_KW,
    ACTION_KW,
    INSTANCE_KW,
    SEQUENCE_KW,
    HISTORY_KW,
    ENTRY_KW,
    EXIT_KW,
    ABORT_KW,
];

/// The word of the item that starts at the cursor; none for a path.
fn item_word(p: &Parser<'_>) -> Option<SyntaxKind> {
    let word = keyword(p, &ITEMS).filter(|_| p.peek(1) != ARROW)?;
    let leaves_a_guard = p.is_word_next("yes") || p.is_word_next("no");
    match word {
        COMPOSITE_KW | HISTORY_KW | ENTRY_KW | EXIT_KW | ABORT_KW => (!leaves_a_guard).then_some(word),
        _ => Some(word),
    }
}

fn starts_item(p: &Parser<'_>) -> bool {
    item_word(p).is_some() || is_name(p) && starts_path(p) || ends_block_around(p)
}

fn starts_path(p: &Parser<'_>) -> bool {
    p.peek(1) == ARROW || p.peek(2) == ARROW
}

/// A word that [`shape_name`] takes as a name, so an item that starts with one always makes progress.
fn is_name(p: &Parser<'_>) -> bool {
    p.token_text().starts_with(|letter: char| letter.is_alphabetic() || letter == '_') && keyword(p, &ENDS).is_none()
}

fn item(p: &mut Parser<'_>) {
    match item_word(p) {
        Some(CONTROL_KW) => control(p),
        Some(INITIAL_KW) if p.is_word_next("composite") => composite(p, true),
        Some(INITIAL_KW) => {
            p.start(CONTROL_STATE);
            p.bump_as(INITIAL_KW);
            if expect_word(p, STATE_KW, "behind `initial`") {
                shape(p, term_link);
            }
            p.finish();
        }
        Some(COMPOSITE_KW) => composite(p, false),
        Some(HISTORY_KW) => {
            p.start(HISTORY);
            p.bump_as(HISTORY_KW);
            term_link(p);
            p.finish();
        }
        Some(ENTRY_KW) => declared(p, ENTRY_ACTION, ENTRY_KW, rule_link),
        Some(EXIT_KW) => declared(p, EXIT_ACTION, EXIT_KW, rule_link),
        Some(ABORT_KW) => declared(p, ABORT_ACTION, ABORT_KW, rule_link),
        Some(STATE_KW) => declared(p, CONTROL_STATE, STATE_KW, term_link),
        Some(GUARD_KW) => declared(p, GUARD_SHAPE, GUARD_KW, term_link),
        Some(ACTION_KW) => declared(p, ACTION_SHAPE, ACTION_KW, rule_link),
        Some(INSTANCE_KW) => instance(p),
        Some(SEQUENCE_KW) => sequence(p),
        _ if is_name(p) && starts_path(p) => path(p),
        _ => no_item(p, "a shape or a path", starts_item),
    }
}

/// `control NAME`, `control {location}`
fn control(p: &mut Parser<'_>) {
    p.start(CONTROL_VARIABLE);
    p.bump_as(CONTROL_KW);
    if p.at(L_BRACE) {
        term_link(p);
    } else {
        shape_name(p);
    }
    p.finish();
}

fn declared(p: &mut Parser<'_>, node: SyntaxKind, word: SyntaxKind, link: fn(&mut Parser<'_>)) {
    p.start(node);
    p.bump_as(word);
    shape(p, link);
    p.finish();
}

/// `[initial] composite state NAME "text" … endstate`
fn composite(p: &mut Parser<'_>, initial: bool) {
    if p.awaiting(ENDSTATE_KW) >= MAX_COMPOSITES {
        return too_deep(p);
    }
    p.start(COMPOSITE_STATE);
    if initial {
        p.bump_opener_as(INITIAL_KW, ENDSTATE_KW);
        p.bump_as(COMPOSITE_KW);
    } else {
        p.bump_opener_as(COMPOSITE_KW, ENDSTATE_KW);
    }
    expect_word(p, STATE_KW, "behind `composite`");
    if shape_name(p) {
        p.eat(STRING);
    }
    block(p, ENDSTATE_KW, item);
    p.finish();
}

/// Skips a composite state up to its end.
fn too_deep(p: &mut Parser<'_>) {
    let found = p.found();
    p.fault_once(fault::composites_too_deep(found));
    p.start(ERROR);
    let mut open = 0usize;
    while !p.at(EOF) && !ends_block_around(p) && keyword(p, &[ENDMACHINE_KW, ENDPATTERN_KW]).is_none() {
        let word = keyword(p, &[COMPOSITE_KW, ENDSTATE_KW]);
        p.bump();
        match word {
            Some(COMPOSITE_KW) => open += 1,
            Some(_) => open = open.saturating_sub(1),
            None => continue,
        }
        if open == 0 {
            break;
        }
    }
    p.finish();
}

/// `NAME "text" {link} to refine by NAME`
fn shape(p: &mut Parser<'_>, link: fn(&mut Parser<'_>)) {
    if !shape_name(p) {
        return;
    }
    p.eat(STRING);
    link(p);
    if p.at_word("to") && p.peek(1) != ARROW {
        p.start(REFINEMENT);
        p.bump_as(TO_KW);
        expect_word(p, REFINE_KW, "behind `to`");
        if eat_word(p, BY_KW) {
            shape_name(p);
        }
        p.finish();
    }
}

/// `instance NAME of NAME (arguments) "text" {r_rule}`
fn instance(p: &mut Parser<'_>) {
    p.start(PATTERN_INSTANCE);
    p.bump_as(INSTANCE_KW);
    if shape_name(p) && expect_word(p, OF_KW, "behind the name of an instance") {
        shape_name(p);
        if p.at(L_PAREN) {
            p.start(ARGUMENT_LIST);
            list::list(p, R_PAREN, list::Empty::Allowed, |p| term::delimited(p, "an argument"));
            p.finish();
        }
        p.eat(STRING);
        rule_name_link(p);
    }
    p.finish();
}

/// `sequence NAME, NAME`
fn sequence(p: &mut Parser<'_>) {
    p.start(SEQUENCE);
    p.bump_as(SEQUENCE_KW);
    while shape_name(p) && p.eat(COMMA) {}
    p.finish();
}

/// `NAME [yes|no] -> … -> NAME`; a pattern that answers ends at `exit yes` or `exit no`
fn path(p: &mut Parser<'_>) {
    p.start(CHART_PATH);
    stop(p);
    while p.eat(ARROW) {
        stop(p);
    }
    p.finish();
}

fn stop(p: &mut Parser<'_>) {
    p.start(PATH_STOP);
    if let Some(end) = keyword(p, &[ENTER_KW, EXIT_KW]) {
        p.bump_as(end);
        // A word before an arrow begins the next path.
        if end == EXIT_KW
            && let Some(answer) = keyword(p, &[YES_KW, NO_KW])
            && p.peek(1) != ARROW
        {
            p.bump_as(answer);
        }
    } else if shape_name(p)
        && let Some(branch) = keyword(p, &[YES_KW, NO_KW])
        && p.peek(1) == ARROW
    {
        p.bump_as(branch);
    }
    p.finish();
}

/// `layout NAME … endlayout`
fn layout(p: &mut Parser<'_>) {
    p.start(LAYOUT);
    p.bump_opener_as(LAYOUT_KW, ENDLAYOUT_KW);
    shape_name(p);
    block(p, ENDLAYOUT_KW, placement);
    p.finish();
}

/// `NAME at X, Y`
fn placement(p: &mut Parser<'_>) {
    if !is_name(p) || p.peek(1) == ARROW {
        no_item(p, "the place of a shape, as `NAME at X, Y`", |p| p.peek(2) != ARROW && is_name(p));
        return;
    }
    p.start(PLACEMENT);
    shape_name(p);
    if expect_word(p, AT_KW, "behind the name of a shape") {
        coordinate(p);
        if p.expect(COMMA, "between the two coordinates") {
            coordinate(p);
        }
    }
    p.finish();
}

fn coordinate(p: &mut Parser<'_>) {
    p.start(COORDINATE);
    p.eat(MINUS);
    if !p.eat(REAL) {
        p.expect(INTEGER, "as a coordinate in pixels");
    }
    p.finish();
}

#[cfg(test)]
mod tests {
    use crate::grammar::brief::chart;
    use expect_test::{Expect, expect};

    fn check(text: &str, expected: Expect) {
        expected.assert_eq(&chart(text));
    }

    #[test]
    fn machines() {
        check("", expect![[""]]);
        check(
            "chart C import ../a/B machine m ($x in D) \"text\" {r_m} control phase initial state A {AA} state B \"b c\" guard g {f($x) = 1} to refine by h action a {r_a[$x]} to refine instance i of p ($x) \"i\" {r_p} sequence a, i A -> g yes -> a -> B g no -> B B -> i -> A endmachine pattern p control {f($x)} enter -> a -> exit endpattern",
            expect![[r#"
                chart
                C
                IMPORT(import ../a/B)
                MACHINE_CHART(
                  machine
                  m
                  PARAMETER_LIST(( PARAMETER($x in D) ))
                  "text"
                  LINK({ r_m })
                  CONTROL_VARIABLE(control phase)
                  CONTROL_STATE(initial state A LINK({ AA }))
                  CONTROL_STATE(state B "b c")
                  GUARD_SHAPE(
                    guard
                    g
                    LINK({ BINARY(FUNCTION(f ARGUMENT_LIST(( $x ))) = 1) })
                    REFINEMENT(to refine by h))
                  ACTION_SHAPE(
                    action
                    a
                    LINK({ MACRO_CALL(r_a ARGUMENT_LIST([ $x ])) })
                    REFINEMENT(to refine))
                  PATTERN_INSTANCE(
                    instance
                    i
                    of
                    p
                    ARGUMENT_LIST(( $x ))
                    "i"
                    LINK({ r_p }))
                  SEQUENCE(sequence a , i)
                  CHART_PATH(
                    PATH_STOP(A)
                    ->
                    PATH_STOP(g yes)
                    ->
                    PATH_STOP(a)
                    ->
                    PATH_STOP(B))
                  CHART_PATH(PATH_STOP(g no) -> PATH_STOP(B))
                  CHART_PATH(PATH_STOP(B) -> PATH_STOP(i) -> PATH_STOP(A))
                  endmachine)
                MACHINE_CHART(
                  pattern
                  p
                  CONTROL_VARIABLE(
                    control
                    LINK({ FUNCTION(f ARGUMENT_LIST(( $x ))) }))
                  CHART_PATH(PATH_STOP(enter) -> PATH_STOP(a) -> PATH_STOP(exit))
                  endpattern)"#]],
        );
    }

    #[test]
    fn answers() {
        check(
            "chart C pattern p enter -> g yes -> exit yes g no -> exit no endpattern pattern q a -> exit yes -> exit endpattern",
            expect![[r#"
                chart
                C
                MACHINE_CHART(
                  pattern
                  p
                  CHART_PATH(
                    PATH_STOP(enter)
                    ->
                    PATH_STOP(g yes)
                    ->
                    PATH_STOP(exit yes))
                  CHART_PATH(PATH_STOP(g no) -> PATH_STOP(exit no))
                  endpattern)
                MACHINE_CHART(
                  pattern
                  q
                  CHART_PATH(PATH_STOP(a) -> PATH_STOP(exit))
                  CHART_PATH(PATH_STOP(yes) -> PATH_STOP(exit))
                  endpattern)"#]],
        );
    }

    #[test]
    fn composite_states() {
        check(
            "chart C machine m initial composite state a \"A\" history {f} entry b {r_b[]} exit c state d d -> g yes -> d endstate abort e history yes -> d endmachine",
            expect![[r#"
                chart
                C
                MACHINE_CHART(
                  machine
                  m
                  COMPOSITE_STATE(
                    initial
                    composite
                    state
                    a
                    "A"
                    HISTORY(history LINK({ f }))
                    ENTRY_ACTION(entry b LINK({ MACRO_CALL(r_b ARGUMENT_LIST([ ])) }))
                    EXIT_ACTION(exit c)
                    CONTROL_STATE(state d)
                    CHART_PATH(PATH_STOP(d) -> PATH_STOP(g yes) -> PATH_STOP(d))
                    endstate)
                  ABORT_ACTION(abort e)
                  CHART_PATH(PATH_STOP(history yes) -> PATH_STOP(d))
                  endmachine)"#]],
        );
        // The end of the machine ends what was left open in it.
        check(
            "chart C machine m\n composite state a\n state b\nendmachine",
            expect![[r#"
            chart
            C
            MACHINE_CHART(
              machine
              m
              COMPOSITE_STATE(composite state a CONTROL_STATE(state b))
              endmachine)
            !missing-end"#]],
        );
        check(
            "chart C machine m\n composite a\n endstate\nendmachine",
            expect![[r#"
                chart
                C
                MACHINE_CHART(
                  machine
                  m
                  COMPOSITE_STATE(composite a endstate)
                  endmachine)
                !expected-token"#]],
        );
    }

    #[test]
    fn layouts() {
        check(
            "chart C layout m a at 10, -2.5 enter at 0, 0 endlayout",
            expect![[r#"
            chart
            C
            LAYOUT(
              layout
              m
              PLACEMENT(a at COORDINATE(10) , COORDINATE(- 2.5))
              PLACEMENT(enter at COORDINATE(0) , COORDINATE(0))
              endlayout)"#]],
        );
    }

    #[test]
    fn a_word_that_ends_another_block_is_no_name() {
        check(
            "chart C machine m endsystem -> A endmachine",
            expect![[r#"
            chart
            C
            MACHINE_CHART(machine m ERROR(endsystem -> A) endmachine)
            !expected-shape"#]],
        );
        // Wherever an item may start, every such word is passed over.
        let blocks = [
            "machine m",
            "machine m composite state x",
            "pattern p",
            "system s",
            "system s component c",
            "layout l",
            "",
        ];
        for block in blocks {
            for end in ["endmachine", "endpattern", "endstate", "endsystem", "endcomponent", "endlayout"] {
                for rest in ["->", "-> A", "A ->", "at 1, 2", "yes ->", ""] {
                    crate::assert_invariants(format!("chart C {block} {end}{rest} {end} {rest} endlayout").as_bytes());
                    crate::assert_invariants(format!("{block} {end}{rest}").as_bytes());
                    crate::assert_invariants(format!("{block} A -> {end} {rest}").as_bytes());
                }
            }
        }
    }

    #[test]
    fn faults() {
        check("machine m endmachine", expect!["MACHINE_CHART(machine m endmachine) !expected-token"]);
        check(
            "chart C machine m state endmachine",
            expect![[r#"
            chart
            C
            MACHINE_CHART(machine m CONTROL_STATE(state) endmachine)
            !expected-name"#]],
        );
        check(
            "chart C machine m 12 state A endmachine",
            expect![[r#"
            chart
            C
            MACHINE_CHART(machine m ERROR(12 state A) endmachine)
            !expected-shape"#]],
        );
        check(
            "chart C machine m state A\nmachine n endmachine",
            expect![[r#"
            chart
            C
            MACHINE_CHART(machine m CONTROL_STATE(state A))
            MACHINE_CHART(machine n endmachine)
            !missing-end"#]],
        );
        check(
            "chart C machine m guard g {f( } state A A -> endmachine",
            expect![[r#"
            chart
            C
            MACHINE_CHART(
              machine
              m
              GUARD_SHAPE(guard g LINK({ FUNCTION(f ARGUMENT_LIST(()) }))
              CONTROL_STATE(state A)
              CHART_PATH(PATH_STOP(A) ->)
              endmachine)
            !expected-term
            !expected-name"#]],
        );
        check(
            "chart C machine m action g {r_x} instance i p initial A endmachine",
            expect![[r#"
            chart
            C
            MACHINE_CHART(
              machine
              m
              ACTION_SHAPE(action g LINK({ MACRO_CALL(r_x) }))
              PATTERN_INSTANCE(instance i)
              ERROR(p initial A)
              endmachine)
            !missing-brackets
            !expected-token
            !expected-shape"#]],
        );
        check(
            "chart C layout m a 10, 20 b at 1 2 endlayout x",
            expect![[r#"
            chart
            C
            LAYOUT(layout m PLACEMENT(a) ERROR(10 , 20 b at 1 2) endlayout)
            ERROR(x)
            !expected-token
            !expected-shape
            !expected-shape"#]],
        );
    }
}
