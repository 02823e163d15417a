//! Brings the main rule and the initial state of a model in line with the machines of a chart.
//!
//! In: the model's tree, how a new model would run the machines. Out: edits. A machine that nothing runs is called by the main rule, if that
//! only calls rules, as one that was built does. It takes the place of the rule of a machine that was renamed: one that is called there and
//! says what becomes of the same control variable, state by state. A control variable begins as drawn, unless its initial value is
//! computed. INVARIANT: nothing else changes; what is left as it is because it was written by hand, `chart check` tells.

use std::collections::BTreeSet;

use syntax::ast::{AstNode, FunctionDef, Init, trimmed_range};
use syntax::{SyntaxKind, SyntaxKind::*, SyntaxNode};

use super::edit::Edit;

/// How a model runs a machine.
#[derive(Debug, Clone)]
pub(super) struct Running {
    /// The machine's rule.
    pub(super) rule: String,
    /// Its call, as the main rule makes it.
    pub(super) call: String,
    /// The control variable, if it was made for the machine.
    pub(super) control: Option<String>,
}

/// How a control variable begins.
#[derive(Debug, Clone)]
pub(super) struct Start {
    /// Its name.
    pub(super) control: String,
    /// Its definition up to the value: `function control = `.
    pub(super) head: String,
    /// The value.
    pub(super) value: String,
}

/// Calls each machine that nothing runs.
pub(super) fn calls(root: &SyntaxNode, machines: &[Running], edits: &mut Vec<Edit>) {
    let Some(main) = root.children().find(|node| node.kind() == MAIN_RULE) else { return };
    let Some(body) = main.children().find(|node| node.kind() == RULE_DECL).and_then(|rule| rule.children().last())
    else {
        return;
    };
    let is_block = body.kind() == PAR_RULE;
    let calls: Vec<SyntaxNode> = if is_block { body.children().collect() } else { vec![body.clone()] };
    let Some(called) = calls.iter().map(called).collect::<Option<Vec<String>>>() else { return };
    let reached = reached(root, &main);
    let mut added = Vec::new();
    let mut replaced: Vec<&SyntaxNode> = Vec::new();
    for machine in machines.iter().filter(|machine| !reached.contains(&machine.rule)) {
        let is_another = |rule: &str| !machines.iter().any(|other| other.rule == rule);
        let renamed = calls.iter().zip(&called).filter(|(_, rule)| {
            is_another(rule) && machine.control.as_ref().is_some_and(|control| moves(root, rule, control))
        });
        // Machines may share a control variable; one of them alone had the name before.
        match renamed.map(|(call, _)| call).filter(|call| !replaced.contains(call)).collect::<Vec<_>>()[..] {
            [] => added.push(machine.call.as_str()),
            [one] => {
                replaced.push(one);
                edits.push(Edit::replacing(one, machine.call.clone()));
            }
            // Which of them it was is not known.
            _ => {}
        }
    }
    if added.is_empty() {
        return;
    }
    let added = added.join("\n");
    let range = trimmed_range(&body);
    if is_block {
        let end = usize::from(range.end()) - "endpar".len();
        edits.push(Edit { start: end, end, text: format!("{added}\n") });
    } else {
        let (start, end) = (usize::from(range.start()), usize::from(range.end()));
        edits.push(Edit { start, end: start, text: "par\n".to_string() });
        edits.push(Edit { start: end, end, text: format!("\n{added}\nendpar") });
    }
}

/// The rule that a rule calls, if it does nothing else; it may do so for all elements of domains.
fn called(rule: &SyntaxNode) -> Option<String> {
    match rule.kind() {
        MACRO_CALL_RULE => name(rule, RULE_ID),
        FORALL_RULE => {
            let condition = rule.children().filter(|node| node.kind() == LITERAL_TERM).last()?;
            (condition.text() == "true").then(|| rule.children().last()).flatten().as_ref().and_then(called)
        }
        _ => None,
    }
}

fn name(node: &SyntaxNode, kind: SyntaxKind) -> Option<String> {
    let tokens = node.children_with_tokens().filter_map(|element| element.into_token());
    tokens.into_iter().find(|token| token.kind() == kind).map(|token| token.text().to_string())
}

/// The rules of the model that the main rule leads to.
fn reached(root: &SyntaxNode, main: &SyntaxNode) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut open = vec![main.clone()];
    while let Some(node) = open.pop() {
        for token in node.descendants_with_tokens().filter_map(|element| element.into_token()) {
            if token.kind() == RULE_ID && found.insert(token.text().to_string()) {
                open.extend(declared(root, token.text()));
            }
        }
    }
    found
}

fn declared(root: &SyntaxNode, rule: &str) -> Option<SyntaxNode> {
    let definitions = root.children().find(|node| node.kind() == DEFINITIONS)?;
    let mut rules = definitions.children().filter(|node| node.kind() == RULE_DECL);
    rules.find(|node| name(node, RULE_ID).as_deref() == Some(rule))
}

/// Whether a rule says, control state by control state, what becomes of a control variable.
fn moves(root: &SyntaxNode, rule: &str, control: &str) -> bool {
    let Some(body) = declared(root, rule).and_then(|declared| declared.children().last()) else { return false };
    let cases: Vec<SyntaxNode> = if body.kind() == PAR_RULE { body.children().collect() } else { vec![body] };
    let asks = |case: &SyntaxNode| {
        let condition = case.children().find(|node| node.kind() == CONDITIONAL_BRANCH).unwrap_or_else(|| case.clone());
        case.kind() == IF_RULE
            && condition.children().next().is_some_and(|condition| {
                let text: String = condition.text().to_string().split_whitespace().collect();
                let text = text.strip_prefix("isUndef(").unwrap_or(&text);
                text.strip_prefix(control).is_some_and(|rest| rest.starts_with(['=', '(', ')']))
            })
    };
    cases.iter().all(asks)
}

/// Sets each control variable to its initial state, unless its initial value is computed.
pub(super) fn starts(root: &SyntaxNode, starts: &[Start], edits: &mut Vec<Edit>) {
    let inits: Vec<Init> = root.children().filter_map(Init::cast).collect();
    let Some(init) = inits.iter().find(|init| init.is_default()).or(inits.first()) else { return };
    let mut missing = String::new();
    for start in starts {
        let is_it = |defined: &FunctionDef| defined.name().is_some_and(|name| name.text() == start.control);
        match init.function_defs().find(is_it).map(|defined| defined.body()) {
            None => missing.push_str(&format!("\n{}{}", start.head, start.value)),
            Some(Some(body)) => {
                let body = body.syntax();
                let is_literal = matches!(body.kind(), ENUM_TERM | LITERAL_TERM);
                if is_literal && trimmed_text(body) != start.value {
                    edits.push(Edit::replacing(body, start.value.clone()));
                }
            }
            Some(None) => {}
        }
    }
    let end = usize::from(trimmed_range(init.syntax()).end());
    edits.push(Edit { start: end, end, text: missing });
}

fn trimmed_text(node: &SyntaxNode) -> String {
    node.text().to_string().trim().to_string()
}
