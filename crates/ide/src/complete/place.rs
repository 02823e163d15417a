//! What may be written at a place, by the tokens before it.
//!
//! In: a file and an offset. Out: a [`Place`]: the word that is there, what may stand in its place, the domain that is expected.
//! Nothing here relies on the tree being whole: the tokens and the sections' keywords are enough.

use model::{DomainId, Domains};
use syntax::{SyntaxKind, SyntaxToken};

use super::scope;
use crate::analysis::{Analysis, previous};
use crate::signature::call_before;

/// The domain that a term is to have, if it is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Expected(pub Option<DomainId>);

/// What may be written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Where {
    /// The path of a module, or of the model of a scenario.
    Path { scenario: bool },
    /// Before the signature.
    Header,
    /// A declaration of the signature.
    Declaration,
    /// A definition.
    Definition,
    /// A command of a scenario.
    Command,
    /// An item of a machine in a chart.
    ChartItem,
    /// The machine of an elaboration.
    Machine,
    /// The machine of the same chart by which a shape is to be refined.
    Drawn,
    /// A domain.
    Domain,
    /// A rule.
    Rule,
    /// The name of a rule, with its brackets.
    Call,
    /// A location that is updated or set.
    Target,
    /// A term.
    Term(Expected),
    /// An operator, or the next word of a construct.
    Operator,
    /// A new name, a comment, a string.
    Nothing,
}

/// See the module.
#[derive(Debug, Clone)]
pub(super) struct Place {
    /// The bytes of the word that is there.
    pub range: (u32, u32),
    /// What may stand there.
    pub wanted: Where,
    /// The environment writes here: a `set`.
    pub as_environment: bool,
    /// The variables seen here: name, domain if known, how that is shown.
    pub variables: Vec<(String, Option<DomainId>, String)>,
}

/// The place of an offset; none in a file without a tree.
pub(super) fn at(analysis: &Analysis, offset: u32) -> Option<Place> {
    let tree = analysis.tree()?;
    let offset = offset.min(tree.text_range().end().into());
    let left = tree.token_at_offset(offset.into()).left_biased();
    let nothing =
        Place { range: (offset, offset), wanted: Where::Nothing, as_environment: false, variables: Vec::new() };
    let Some(left) = left else { return Some(Place { wanted: first_word(tree.kind()), ..nothing }) };
    use SyntaxKind::*;
    if matches!(left.kind(), LINE_COMMENT | STRING | CHAR) || in_block_comment(&left, offset) {
        return Some(nothing);
    }
    let is_word = |token: &SyntaxToken| token.text().starts_with(|c: char| c.is_alphanumeric() || "$_".contains(c));
    let on_path = left.kind() == MODULE_REF;
    let word = (is_word(&left) || on_path || left.text() == "$").then(|| left.clone());
    let range = match &word {
        Some(word) => (word.text_range().start().into(), offset),
        None => (offset, offset),
    };
    let before = match &word {
        Some(word) => previous(word),
        None if left.kind().is_trivia() => previous(&left),
        None => Some(left.clone()),
    };
    // A word that is no token yet may lie outside of what it is written in.
    let variables = scope::variables(analysis, before.as_ref().unwrap_or(&left));
    let wanted = match tree.kind() {
        SOURCE_FILE => in_model(analysis, before.as_ref()),
        SCENARIO_FILE => in_scenario(analysis, before.as_ref()),
        CHART_FILE => in_chart(analysis, before.as_ref()),
        _ => Where::Nothing,
    };
    let as_environment = command(before.as_ref()) == Some(SET_KW);
    Some(Place { range, wanted, as_environment, variables })
}

fn first_word(kind: SyntaxKind) -> Where {
    match kind {
        SyntaxKind::SOURCE_FILE => Where::Header,
        SyntaxKind::SCENARIO_FILE => Where::Command,
        SyntaxKind::CHART_FILE => Where::ChartItem,
        _ => Where::Nothing,
    }
}

fn in_block_comment(token: &SyntaxToken, offset: u32) -> bool {
    token.kind() == SyntaxKind::BLOCK_COMMENT && offset < u32::from(token.text_range().end())
}

/// The section that a token is in, by the nearest keyword before it.
fn section(token: &SyntaxToken) -> SyntaxKind {
    use SyntaxKind::*;
    let mut at = Some(token.clone());
    while let Some(token) = at {
        match token.kind() {
            SIGNATURE_KW | DEFINITIONS_KW => return token.kind(),
            INIT_KW if previous(&token).is_none_or(|before| before.kind() != COLON) => return INIT_KW,
            _ => at = token.prev_token(),
        }
    }
    ASM_KW
}

fn in_model(analysis: &Analysis, before: Option<&SyntaxToken>) -> Where {
    use SyntaxKind::*;
    let Some(before) = before else { return Where::Header };
    match before.kind() {
        IMPORT_KW => return Where::Path { scenario: false },
        ASM_KW | MODULE_KW | INIT_KW => return Where::Nothing,
        _ => {}
    }
    match section(before) {
        ASM_KW => Where::Header,
        SIGNATURE_KW => in_signature(before),
        _ => in_body(analysis, before),
    }
}

fn in_signature(before: &SyntaxToken) -> Where {
    use SyntaxKind::*;
    match before.kind() {
        COLON if previous(before).is_some_and(|token| token.kind() == SIGNATURE_KW) => Where::Declaration,
        COLON | ARROW | SUBSETOF_KW => Where::Domain,
        L_PAREN | COMMA if before.parent().is_some_and(|parent| parent.kind() != ENUM_DOMAIN_DECL) => Where::Domain,
        STATIC_KW | DERIVED_KW | MONITORED_KW | CONTROLLED_KW | SHARED_KW | OUT_KW | DOMAIN_KW | ANYDOMAIN_KW
        | FUNCTION_ID | L_BRACE | BAR | EQ => Where::Nothing,
        _ => Where::Declaration,
    }
}

/// In definitions, properties and initial states.
fn in_body(analysis: &Analysis, before: &SyntaxToken) -> Where {
    use SyntaxKind::*;
    let parent = before.parent().map(|parent| parent.kind());
    match before.kind() {
        COLON => match parent {
            _ if previous(before).is_some_and(|token| token.kind() == DEFINITIONS_KW) => Where::Definition,
            Some(CASE_BRANCH) | Some(SWITCH_RULE) if in_rule(before) => Where::Rule,
            Some(INIT) => Where::Definition,
            Some(AGENT_INIT) => Where::Call,
            Some(INVARIANT | CTL_SPEC | LTL_SPEC) => Where::Term(Expected(Some(Domains::BOOLEAN))),
            _ => Where::Term(Expected(None)),
        },
        EQ if parent == Some(RULE_DECL) => Where::Rule,
        PAR_KW | SEQ_KW | ITERATE_KW | DO_KW | IFNONE_KW => Where::Rule,
        THEN_KW | ELSE_KW | OTHERWISE_KW if in_rule(before) => Where::Rule,
        ENDPAR_KW | ENDSEQ_KW | ENDITERATE_KW | SKIP_KW => after_rule(before),
        ENDIF_KW | ENDSWITCH_KW | ENDLET_KW if in_rule(before) => after_rule(before),
        IN_KW if matches!(parent, Some(LET_RULE)) => Where::Rule,
        IN_KW if matches!(parent, Some(PARAMETER | RULE_DECL)) => Where::Domain,
        LT if previous(before).is_some_and(|token| token.kind() == LT) => Where::Call,
        RETURN_ARROW => Where::Call,
        EXTEND_KW | DOMAIN_KW | AGENT_KW => Where::Domain,
        RULE_KW | MACRO_KW | TURBO_KW | MAIN_KW | DEFAULT_KW => Where::Nothing,
        FUNCTION_KW | OVER_KW => Where::Term(Expected(None)),
        INVARIANT_KW => Where::Nothing,
        IF_KW | ELSEIF_KW | WITH_KW | WHILE_KW | WHILEREC_KW | CTLSPEC_KW | LTLSPEC_KW | INVAR_KW | JUSTICE_KW => {
            Where::Term(Expected(Some(Domains::BOOLEAN)))
        }
        INTEGER | NATURAL | REAL | COMPLEX | CHAR | STRING | TRUE_KW | FALSE_KW | UNDEF_KW | FUNCTION_ID | VARIABLE
        | ENUM_ID | DOMAIN_ID | R_PAREN | R_BRACE | R_BRACKET
            if !is_operator(before) =>
        {
            if in_list_of_rules(before) {
                Where::Rule
            } else {
                after_term(before)
            }
        }
        _ => Where::Term(expected(analysis, before)),
    }
}

/// A word that is an operator: `and`, `mod`.
fn is_operator(token: &SyntaxToken) -> bool {
    matches!(token.text(), "and" | "or" | "xor" | "not" | "implies" | "iff" | "mod")
}

/// Whether the construct that a word belongs to is a rule, not a term.
fn in_rule(token: &SyntaxToken) -> bool {
    let kinds = token.parent_ancestors().map(|node| node.kind());
    for kind in kinds {
        match kind {
            SyntaxKind::IF_RULE | SyntaxKind::SWITCH_RULE | SyntaxKind::LET_RULE => return true,
            SyntaxKind::IF_TERM | SyntaxKind::SWITCH_TERM | SyntaxKind::LET_TERM => return false,
            _ => {}
        }
    }
    true
}

/// Whether rules follow one another here.
fn in_list_of_rules(token: &SyntaxToken) -> bool {
    let list = |kind| matches!(kind, SyntaxKind::PAR_RULE | SyntaxKind::SEQ_RULE);
    let rule =
        |kind| matches!(kind, SyntaxKind::UPDATE_RULE | SyntaxKind::MACRO_CALL_RULE | SyntaxKind::TURBO_CALL_RULE);
    let complete = token.parent_ancestors().find(|node| rule(node.kind()));
    complete.and_then(|node| node.parent()).is_some_and(|parent| list(parent.kind()))
}

fn after_rule(token: &SyntaxToken) -> Where {
    let ancestors = token.parent_ancestors().skip(1);
    let enclosing = ancestors.map(|node| node.kind()).find(|kind| {
        matches!(
            kind,
            SyntaxKind::PAR_RULE
                | SyntaxKind::SEQ_RULE
                | SyntaxKind::RULE_DECL
                | SyntaxKind::IF_RULE
                | SyntaxKind::SWITCH_RULE
        )
    });
    match enclosing {
        Some(SyntaxKind::PAR_RULE | SyntaxKind::SEQ_RULE) => Where::Rule,
        Some(SyntaxKind::IF_RULE | SyntaxKind::SWITCH_RULE) => Where::Operator,
        _ => Where::Definition,
    }
}

fn after_term(token: &SyntaxToken) -> Where {
    let inside = token.parent_ancestors().any(|node| {
        use SyntaxKind::*;
        matches!(
            node.kind(),
            IF_RULE
                | IF_TERM
                | SWITCH_RULE
                | SWITCH_TERM
                | CHOOSE_RULE
                | FORALL_RULE
                | LET_RULE
                | LET_TERM
                | WHILE_RULE
                | PAREN_TERM
                | QUANTIFIED_TERM
                | COMPREHENSION_TERM
                | ARGUMENT_LIST
                | EXTEND_RULE
        )
    });
    if inside { Where::Operator } else { Where::Definition }
}

/// The domain of what stands behind a token.
fn expected(analysis: &Analysis, before: &SyntaxToken) -> Expected {
    use SyntaxKind::*;
    let domain = match before.kind() {
        ASSIGN | EQ | NEQ | LT | LE | GT | GE => previous(before).and_then(|left| of_left(analysis, &left)),
        CASE_KW => {
            let switch = before.parent_ancestors().find(|node| matches!(node.kind(), SWITCH_RULE | SWITCH_TERM));
            let subject = switch.and_then(|node| node.children().next()).and_then(|node| node.last_token());
            subject.and_then(|token| of_left(analysis, &token))
        }
        L_PAREN | L_BRACKET | COMMA => of_argument(analysis, before),
        _ if is_operator(before) => Some(Domains::BOOLEAN).filter(|_| before.text() != "mod"),
        _ => None,
    };
    Expected(domain)
}

/// The domain of the application or variable that ends with a token.
fn of_left(analysis: &Analysis, last: &SyntaxToken) -> Option<DomainId> {
    let mut name = last.clone();
    if last.kind() == SyntaxKind::R_PAREN {
        let mut depth = 0;
        loop {
            match name.kind() {
                SyntaxKind::R_PAREN => depth += 1,
                SyntaxKind::L_PAREN => depth -= 1,
                _ => {}
            }
            name = previous(&name)?;
            if depth == 0 {
                break;
            }
        }
    }
    let names = &analysis.model.names;
    match name.kind() {
        SyntaxKind::FUNCTION_ID => {
            let function = names.functions(name.text()).last()?;
            Some(analysis.model.function(*function).codomain)
        }
        SyntaxKind::ENUM_ID => names.literal(name.text()).map(|(domain, _)| domain),
        SyntaxKind::VARIABLE => {
            let at = u32::from(name.text_range().start());
            analysis.names_at(at).first().and_then(|name| match name.referent {
                model::Referent::Variable(_, domain) => Some(domain),
                _ => None,
            })
        }
        _ => None,
    }
}

/// The domain of the argument behind an opening bracket or a comma.
fn of_argument(analysis: &Analysis, before: &SyntaxToken) -> Option<DomainId> {
    let (name, index) = call_before(before)?;
    let model = &analysis.model;
    if name.kind() == SyntaxKind::RULE_ID {
        let rule = model.rule(*model.names.rules(name.text()).last()?);
        let parameter = rule.parameters.get(index)?;
        return Some(rule.variables[parameter.0 as usize].domain);
    }
    let [only] = model.names.functions(name.text()) else { return None };
    model.function(*only).parameters.get(index).copied()
}

/// The keyword of the command of a scenario that a token is in.
fn command(before: Option<&SyntaxToken>) -> Option<SyntaxKind> {
    use SyntaxKind::*;
    let mut at = before.cloned();
    while let Some(token) = at {
        match token.kind() {
            SEMICOLON => return None,
            SET_KW | CHECK_KW | EXEC_KW | PICK_KW | UNTIL_KW | LOAD_KW | EXECBLOCK_KW | EXPECT_KW | INVARIANT_KW => {
                return Some(token.kind());
            }
            _ => at = previous(&token),
        }
    }
    None
}

fn in_scenario(analysis: &Analysis, before: Option<&SyntaxToken>) -> Where {
    use SyntaxKind::*;
    let Some(token) = before else { return Where::Command };
    match token.kind() {
        LOAD_KW => return Where::Path { scenario: true },
        SCENARIO_KW | BEGIN_KW | EXECBLOCK_KW => return Where::Nothing,
        STEP_KW | GENERIC_ID | MODULE_REF => return Where::Command,
        SET_KW => return Where::Target,
        EXEC_KW => return Where::Rule,
        CHECK_KW | UNTIL_KW => return Where::Term(Expected(Some(Domains::BOOLEAN))),
        _ => {}
    }
    match command(before) {
        None => Where::Command,
        Some(EXEC_KW) => in_body(analysis, token),
        Some(SET_KW | CHECK_KW | UNTIL_KW | PICK_KW | INVARIANT_KW) => match in_body(analysis, token) {
            Where::Definition => Where::Operator,
            other => other,
        },
        Some(_) => Where::Nothing,
    }
}

fn in_chart(analysis: &Analysis, before: Option<&SyntaxToken>) -> Where {
    let Some(token) = before else { return Where::ChartItem };
    if token.kind() == SyntaxKind::IMPORT_KW {
        return Where::Path { scenario: false };
    }
    // In a text with faults the word after `by` may be of no phase.
    if token.text() == "by" {
        let of_shape = previous(token).is_some_and(|before| before.text() == "refine");
        return if of_shape { Where::Drawn } else { Where::Machine };
    }
    let in_link = token.parent_ancestors().any(|node| node.kind() == SyntaxKind::LINK);
    if !in_link || token.kind() == SyntaxKind::R_BRACE {
        return Where::ChartItem;
    }
    let of_action = token.parent_ancestors().any(|node| node.kind() == SyntaxKind::ACTION_SHAPE);
    match token.kind() {
        SyntaxKind::L_BRACE if of_action => Where::Rule,
        _ => in_body(analysis, token),
    }
}
