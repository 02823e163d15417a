//! What the functions of a component's machine rest on, and which of its rules do nothing once some functions are free.
//!
//! In: the tree of a machine's file. Out: names of its own functions. What is said to be read is a guide for who looks for a part that
//! suffices, nothing more: no verdict rests on it. INVARIANT: [`is_plain`] is true only of a machine in whose steps no function is both
//! updated and read again, and in which each update names its function; [`is_idle`] only of rules that update no function that is kept.

use std::collections::BTreeSet;

use syntax::ast::{self, AstNode, Rule};
use syntax::{SyntaxKind, SyntaxNode};

/// Rules after which something else in the same step sees what was updated, or whose updates do not name their function.
const SEQUENTIAL: [SyntaxKind; 9] = [
    SyntaxKind::SEQ_RULE,
    SyntaxKind::ITERATE_RULE,
    SyntaxKind::WHILE_RULE,
    SyntaxKind::RECURSIVE_WHILE_RULE,
    SyntaxKind::TURBO_CALL_RULE,
    SyntaxKind::RETURN_RULE,
    SyntaxKind::LOCAL_RULE,
    SyntaxKind::EXTEND_RULE,
    SyntaxKind::TERM_RULE,
];

/// Whether some functions of a machine can be left free: see the module.
pub(super) fn is_plain(tree: &SyntaxNode) -> bool {
    let own = |call: &SyntaxNode| called(call).is_some_and(|name| rule_named(tree, &name).is_some());
    tree.descendants().all(|node| match node.kind() {
        kind if SEQUENTIAL.contains(&kind) => false,
        SyntaxKind::UPDATE_RULE => updated(&node).is_some(),
        SyntaxKind::MACRO_CALL_RULE => own(&node),
        _ => true,
    })
}

/// The function that an update names.
pub(crate) fn updated(update: &SyntaxNode) -> Option<String> {
    let target = update.children().next().filter(|target| target.kind() == SyntaxKind::FUNCTION_TERM)?;
    let mut tokens = target.children_with_tokens().filter_map(|element| element.into_token());
    tokens.find(|token| token.kind() == SyntaxKind::FUNCTION_ID).map(|token| token.text().to_string())
}

/// The rule that a call names.
fn called(call: &SyntaxNode) -> Option<String> {
    ast::MacroCallRule::cast(call.clone())?.name().map(|name| name.text().to_string())
}

/// A rule of the file, by its name.
fn rule_named(tree: &SyntaxNode, name: &str) -> Option<SyntaxNode> {
    let mut rules = tree.descendants().filter_map(ast::RuleDecl::cast);
    rules.find(|rule| rule.name().is_some_and(|own| own.text() == name)).map(|rule| rule.syntax().clone())
}

/// Whether a rule, with all that it calls, updates none but functions that are free.
pub(super) fn is_idle(tree: &SyntaxNode, rule: &SyntaxNode, is_free: &dyn Fn(&str) -> bool) -> bool {
    let mut seen = BTreeSet::new();
    let mut open = vec![rule.clone()];
    while let Some(rule) = open.pop() {
        for node in rule.descendants() {
            match node.kind() {
                SyntaxKind::UPDATE_RULE if !updated(&node).is_some_and(|name| is_free(&name)) => return false,
                SyntaxKind::MACRO_CALL_RULE => {
                    let Some(name) = called(&node) else { return false };
                    let Some(body) = rule_named(tree, &name) else { return false };
                    if seen.insert(name) {
                        open.push(body);
                    }
                }
                kind if SEQUENTIAL.contains(&kind) => return false,
                _ => {}
            }
        }
    }
    true
}

/// The names that a function's definition and updates read, with all that decides whether they are made.
pub(super) fn read_for(tree: &SyntaxNode, function: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut rules = BTreeSet::new();
    let mut open = Vec::new();
    for node in tree.descendants() {
        match node.kind() {
            SyntaxKind::FUNCTION_DEF if defines(&node, function) => names_in(&node, &mut found),
            SyntaxKind::UPDATE_RULE if updated(&node).as_deref() == Some(function) => {
                names_in(&node, &mut found);
                open.push(node);
            }
            _ => {}
        }
    }
    while let Some(node) = open.pop() {
        for above in node.ancestors().skip(1) {
            if let Some(rule) = ast::RuleDecl::cast(above.clone()) {
                let Some(name) = rule.name().map(|name| name.text().to_string()) else { break };
                if rules.insert(name.clone()) {
                    let calls = tree.descendants().filter(|call| called(call).as_deref() == Some(name.as_str()));
                    for call in calls {
                        names_in(&call, &mut found);
                        open.push(call);
                    }
                }
                break;
            }
            above.children().for_each(|child| terms_in(&child, &mut found));
        }
    }
    found.remove(function);
    found
}

fn defines(definition: &SyntaxNode, function: &str) -> bool {
    let mut tokens = definition.children_with_tokens().filter_map(|element| element.into_token());
    tokens.find(|token| token.kind() == SyntaxKind::FUNCTION_ID).is_some_and(|token| token.text() == function)
}

/// The names of functions in a part.
fn names_in(node: &SyntaxNode, found: &mut BTreeSet<String>) {
    let tokens = node.descendants_with_tokens().filter_map(|element| element.into_token());
    let names = tokens.filter(|token| token.kind() == SyntaxKind::FUNCTION_ID);
    found.extend(names.map(|token| token.text().to_string()));
}

/// The same, without what stands in rules within it.
fn terms_in(node: &SyntaxNode, found: &mut BTreeSet<String>) {
    if Rule::cast(node.clone()).is_some() {
        return;
    }
    node.children().for_each(|child| terms_in(&child, found));
    let tokens = node.children_with_tokens().filter_map(|element| element.into_token());
    let names = tokens.filter(|token| token.kind() == SyntaxKind::FUNCTION_ID);
    found.extend(names.map(|token| token.text().to_string()));
}
