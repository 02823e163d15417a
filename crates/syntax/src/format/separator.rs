//! The table of the layout: what stands between two parts of a node.
//!
//! In: a node, the kind of the part before, and the part. Out: a [`Separator`]. Only this module looks at the author's
//! line breaks: a body on a line of its own stays there, and a short `if` or a single simple rule stays on its line.

use super::comment;
use crate::SyntaxKind::{self, *};
use crate::{SyntaxElement, SyntaxNode};

/// What stands before a part.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Separator {
    Nothing,
    Space,
    /// A blank, or a line end and deeper indentation where the line is too long.
    Fold,
    /// The same without a blank.
    SoftFold,
    /// A fold of its own, further right: it does not depend on the rest of the node.
    FoldAlone,
    /// The same, further right.
    FoldAloneTwice,
    /// A blank, or a line end.
    Line,
    /// A line end within a group, which folds all of it.
    Break,
    /// A line of its own.
    Own,
    /// A line of its own, indented.
    OwnIndented,
    /// A line of its own, indented twice.
    OwnIndentedTwice,
    /// A line of its own with an empty line before it.
    Section,
}
use Separator::*;

/// What stands before a part of a node, when a part of the kind `before` precedes it.
pub(super) fn part(node: &SyntaxNode, before: SyntaxKind, part: &SyntaxElement) -> Separator {
    let kind = part.kind();
    if matches!(kind, COMMA | SEMICOLON) {
        return Nothing;
    }
    let here = node.kind();
    match here {
        SOURCE_FILE | SIGNATURE | DEFINITIONS | INIT => section(here, before, kind),
        SCENARIO_FILE | BLOCK => scenario(here, before, kind),
        CHART_FILE | MACHINE_CHART | COMPOSITE_STATE | SYSTEM_CHART | COMPONENT | LAYOUT | LINK | COORDINATE => {
            chart(here, before, kind)
        }
        FUNCTION_TERM | MACRO_CALL_RULE | TURBO_CALL_RULE | TERM_RULE => Nothing,
        EXPORT | OVER_LIST | COLLECTION_TERM | IMPORT_SELECTION if before == COMMA => FoldAlone,
        ARGUMENT_LIST | PAREN_TERM | TUPLE_TERM | COLLECTION_TERM | MAP_TERM | PARAMETER_LIST | IMPORT_SELECTION
        | STRUCTURED_DOMAIN | OVER_ITEM | RULE_TERM => list(before, kind),
        ENUM_DOMAIN_DECL => literals(before, kind),
        COMPREHENSION_TERM | QUANTIFIED_TERM => ranging(before, kind),
        RANGE_TERM if before == COLON || kind == COLON => Space,
        RANGE_TERM => list(before, kind),
        UNARY_TERM if matches!(before, PLUS | MINUS) => Nothing,
        QUANTITY if before == DOT || kind == DOT => Nothing,
        IF_RULE | LET_RULE | CONDITIONAL_BRANCH if is_short(node) => branching(here, before, kind, true),
        PAR_RULE | SEQ_RULE | ITERATE_RULE | LOCAL_RULE => block(here, kind),
        IF_TERM | SWITCH_TERM | LET_TERM | CASE_BRANCH | CONDITIONAL_BRANCH | IF_RULE | SWITCH_RULE | LET_RULE => {
            let ends = matches!(kind, ENDIF_KW | ENDSWITCH_KW | ENDLET_KW) && is_term(here);
            if ends && is_spread(node) {
                return Break;
            }
            if here == CASE_BRANCH && before == COLON && !goes_on(part) {
                return OwnIndented;
            }
            let may_stay = matches!(here, CASE_BRANCH | SWITCH_RULE) && is_simple(kind);
            branching(here, before, kind, may_stay && goes_on(part))
        }
        CHOOSE_RULE | FORALL_RULE | EXTEND_RULE | WHILE_RULE | RECURSIVE_WHILE_RULE => {
            body(before, kind, is_simple(kind) && goes_on(part))
        }
        LOCAL_DECL if before == L_BRACKET || kind == R_BRACKET => Nothing,
        FUNCTION_DECL | LOCAL_DECL | DOMAIN_DEF | FUNCTION_DEF | RULE_DECL | INVARIANT | CTL_SPEC | LTL_SPEC
        | INVAR | JUSTICE | COMPASSION | UPDATE_RULE | AGENT_INIT | SCENARIO_INVARIANT => {
            definition(before, kind, goes_on(part))
        }
        PATTERN_INSTANCE if kind == ARGUMENT_LIST => Nothing,
        CONTROL_STATE | GUARD_SHAPE | ACTION_SHAPE | ENTRY_ACTION | EXIT_ACTION | ABORT_ACTION | PATTERN_INSTANCE
            if kind == LINK =>
        {
            FoldAlone
        }
        EXECBLOCK_COMMAND if before == COLON || kind == COLON => Nothing,
        PICK_COMMAND if before == L_PAREN || matches!(kind, L_PAREN | R_PAREN) => Nothing,
        SET_COMMAND | PICK_COMMAND if before == ASSIGN => Fold,
        _ => Space,
    }
}

fn section(here: SyntaxKind, before: SyntaxKind, kind: SyntaxKind) -> Separator {
    match (here, kind) {
        (_, COLON) => Nothing,
        (SOURCE_FILE, MACHINE_NAME) => Space,
        (SOURCE_FILE, IMPORT) if before == IMPORT => Own,
        (SOURCE_FILE, IMPORT | EXPORT | SIGNATURE | DEFINITIONS | INIT) => Section,
        (SOURCE_FILE, MAIN_RULE) => OwnIndented,
        (INIT, INIT_KW | GENERIC_ID) => Space,
        _ => OwnIndented,
    }
}

fn scenario(here: SyntaxKind, before: SyntaxKind, kind: SyntaxKind) -> Separator {
    match (before, kind) {
        (SCENARIO_KW, _) | (LOAD_KW, _) | (BEGIN_KW, _) => Space,
        (_, END_KW) => Own,
        _ if here == BLOCK => OwnIndented,
        _ => Own,
    }
}

/// Sections of a chart, and the items in them.
fn chart(here: SyntaxKind, before: SyntaxKind, kind: SyntaxKind) -> Separator {
    match kind {
        _ if here == CHART_FILE && before == CHART_KW => Space,
        IMPORT if before == IMPORT => Own,
        _ if here == CHART_FILE => Section,
        _ if matches!(here, LINK | COORDINATE) => Nothing,
        PARAMETER_LIST => Nothing,
        GENERIC_ID | STRING | LINK | COMPONENT_KIND | COMPOSITE_KW | STATE_KW => Space,
        ENDMACHINE_KW | ENDPATTERN_KW | ENDSTATE_KW | ENDSYSTEM_KW | ENDCOMPONENT_KW | ENDLAYOUT_KW => Own,
        _ => OwnIndented,
    }
}

/// Items between brackets.
fn list(before: SyntaxKind, kind: SyntaxKind) -> Separator {
    match (before, kind) {
        (COMMA, _) => Fold,
        (_, R_PAREN | R_BRACKET | R_BRACE | GT | LT | RULE_ID | ARROW | L_PAREN) => Nothing,
        _ => SoftFold,
    }
}

fn literals(before: SyntaxKind, kind: SyntaxKind) -> Separator {
    match (before, kind) {
        (L_BRACE, _) => SoftFold,
        (_, R_BRACE) => Nothing,
        (BAR | COMMA, _) => FoldAlone,
        _ => Space,
    }
}

/// Variables with their ranges, a condition, and what is collected.
fn ranging(before: SyntaxKind, kind: SyntaxKind) -> Separator {
    match (before, kind) {
        (L_PAREN | L_BRACE | L_BRACKET | LT, _) | (_, R_PAREN | R_BRACE | R_BRACKET | GT) => Nothing,
        (COMMA, _) => FoldAlone,
        (WITH_KW, _) | (_, BAR | COLON) => Fold,
        _ => Space,
    }
}

fn block(here: SyntaxKind, kind: SyntaxKind) -> Separator {
    match (here, kind) {
        (LOCAL_RULE, _) | (_, ENDPAR_KW | ENDSEQ_KW | ENDITERATE_KW) => Own,
        _ => OwnIndented,
    }
}

/// The parts of `if`, `switch` and `let`; `on_line` when rules may stay on the line.
fn branching(here: SyntaxKind, before: SyntaxKind, kind: SyntaxKind, on_line: bool) -> Separator {
    if kind == COLON || kind == R_PAREN || before == L_PAREN {
        return Nothing;
    }
    let rules = matches!(here, IF_RULE | SWITCH_RULE | LET_RULE) && !on_line;
    match kind {
        ELSE_KW | ELSEIF_KW | ENDIF_KW | ENDSWITCH_KW | ENDLET_KW => return if rules { Own } else { Line },
        CASE_BRANCH | OTHERWISE_KW => return if rules { OwnIndented } else { Fold },
        _ if is_rule(kind) && !on_line => return if before == OTHERWISE_KW { OwnIndentedTwice } else { OwnIndented },
        _ => {}
    }
    match before {
        COMMA | THEN_KW | ELSE_KW | IN_KW | COLON => Fold,
        OTHERWISE_KW => FoldAloneTwice,
        _ => Space,
    }
}

/// A rule after `do` or `ifnone`.
fn body(before: SyntaxKind, kind: SyntaxKind, on_line: bool) -> Separator {
    match kind {
        IFNONE_KW => Own,
        _ if is_rule(kind) => {
            if on_line {
                FoldAlone
            } else {
                OwnIndented
            }
        }
        _ if before == COMMA => FoldAlone,
        _ if before == WITH_KW && is_term(kind) => Fold,
        _ => Space,
    }
}

fn definition(before: SyntaxKind, kind: SyntaxKind, on_line: bool) -> Separator {
    match (before, kind) {
        (_, COLON | PARAMETER_LIST) => Nothing,
        (EQ, _) if is_rule(kind) => {
            if on_line && is_simple(kind) {
                FoldAlone
            } else {
                OwnIndented
            }
        }
        (EQ | COLON, _) if is_term(kind) => {
            if on_line {
                Fold
            } else {
                OwnIndented
            }
        }
        (ASSIGN | INVAR_KW | JUSTICE_KW, _) if is_term(kind) => Fold,
        (L_PAREN, _) | (_, R_PAREN) => Nothing,
        _ => Space,
    }
}

/// Some part of the term starts a line.
fn is_spread(node: &SyntaxNode) -> bool {
    node.children_with_tokens().skip(1).filter(|part| !part.kind().is_trivia()).any(|part| !goes_on(&part))
}

/// The part starts on the line where the part before ends.
fn goes_on(part: &SyntaxElement) -> bool {
    let first = match part {
        rowan::NodeOrToken::Node(node) => node.first_token(),
        rowan::NodeOrToken::Token(token) => Some(token.clone()),
    };
    first.is_some_and(|first| !comment::starts_line(&first))
}

/// An `if` or `let` on one line, all of whose rules are simple; or a branch of one.
fn is_short(node: &SyntaxNode) -> bool {
    let whole = match node.kind() {
        CONDITIONAL_BRANCH => node.parent().filter(|parent| parent.kind() == IF_RULE),
        _ => Some(node.clone()),
    };
    let compound = |node: &SyntaxNode| is_rule(node.kind()) && !is_simple(node.kind());
    whole.is_some_and(|node| {
        let mut inner = node.descendants().skip(1);
        !inner.any(|node| compound(&node)) && !node.text().contains_char('\n')
    })
}

/// A rule that holds no rules.
fn is_simple(kind: SyntaxKind) -> bool {
    (SKIP_RULE as u16..=TERM_RULE as u16).contains(&(kind as u16))
}

pub(super) fn is_rule(kind: SyntaxKind) -> bool {
    (SKIP_RULE as u16..=LOCAL_RULE as u16).contains(&(kind as u16))
}

fn is_term(kind: SyntaxKind) -> bool {
    (LITERAL_TERM as u16..=RULE_TERM as u16).contains(&(kind as u16))
}
