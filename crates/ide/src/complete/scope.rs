//! The logical variables that are seen at a place.
//!
//! In: a token of a tree, however broken. Out: what binds variables around it: parameters, `let`, `forall`, `choose`, `extend`,
//! quantifiers, comprehensions. The inner one hides the outer one of the same name.

use std::collections::BTreeSet;

use model::{DomainId, Referent};
use syntax::ast::{self, AstNode};
use syntax::{SyntaxKind, SyntaxNode, SyntaxToken};

use crate::analysis::Analysis;

/// The variables seen at a token: name, domain if it is known, how that is shown.
pub(super) fn variables(analysis: &Analysis, at: &SyntaxToken) -> Vec<(String, Option<DomainId>, String)> {
    let mut seen = BTreeSet::new();
    let mut found = Vec::new();
    for node in at.parent_ancestors() {
        for token in bound_by(&node) {
            let ends_before = token.text_range().end() <= at.text_range().end();
            if !ends_before || !seen.insert(token.text().to_string()) {
                continue;
            }
            let start = u32::from(token.text_range().start());
            let domain = analysis.names_at(start).iter().find_map(|name| match name.referent {
                Referent::Variable(_, domain) => Some(domain),
                _ => None,
            });
            let shown = domain.map(|domain| analysis.model.domains.display(domain)).unwrap_or_default();
            found.push((token.text().to_string(), domain, shown));
        }
    }
    found
}

fn bound_by(node: &SyntaxNode) -> Vec<SyntaxToken> {
    match node.kind() {
        SyntaxKind::RULE_DECL | SyntaxKind::FUNCTION_DEF | SyntaxKind::MACHINE_CHART => {
            let lists = node.children().filter_map(ast::ParameterList::cast);
            lists.flat_map(|list| list.parameters().collect::<Vec<_>>()).filter_map(|one| one.variable()).collect()
        }
        SyntaxKind::CHOOSE_RULE
        | SyntaxKind::FORALL_RULE
        | SyntaxKind::QUANTIFIED_TERM
        | SyntaxKind::COMPREHENSION_TERM => {
            node.children().filter_map(ast::Binder::cast).filter_map(|binder| binder.variable()).collect()
        }
        SyntaxKind::LET_RULE | SyntaxKind::LET_TERM => {
            node.children().filter_map(ast::Binding::cast).filter_map(|binding| binding.variable()).collect()
        }
        SyntaxKind::EXTEND_RULE => {
            ast::ExtendRule::cast(node.clone()).map(|rule| rule.variables().collect()).unwrap_or_default()
        }
        _ => Vec::new(),
    }
}
