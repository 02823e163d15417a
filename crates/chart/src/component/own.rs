//! A machine's text with the names that it has within its component.
//!
//! In: a checked machine. Out: the text of each of its parts, in which each name that the machine's own file declares stands as the name
//! that it gets: `f` as `sequencer_f`, `r_x` as `r_sequencer_x`, `Mode` as `SequencerMode`, `IDLE` as `SEQUENCER_IDLE`. Comments stay.

use std::collections::BTreeMap;

use model::Referent;
use syntax::ast::{self, AstNode};
use syntax::{FileId, Span, SyntaxKind, SyntaxNode, SyntaxToken};

use super::reads;
use crate::computing::ComponentMachine;

/// The names of a machine within its component.
pub(super) struct Names<'m> {
    machine: &'m ComponentMachine,
    component: &'m str,
    /// What each name of the file refers to.
    uses: BTreeMap<Span, Referent>,
    /// Functions that get another name than the component's and their own.
    devices: BTreeMap<String, String>,
}

impl<'m> Names<'m> {
    /// The names of a machine in the component of that name; these functions have the names of devices.
    pub(super) fn new(
        machine: &'m ComponentMachine,
        component: &'m str,
        devices: BTreeMap<String, String>,
    ) -> Names<'m> {
        let uses = machine.model().uses.in_file(machine.model().root);
        Names { machine, component, uses: uses.into_iter().map(|one| (one.span, one.referent)).collect(), devices }
    }

    /// The file's tree.
    pub(super) fn tree(&self) -> Option<ast::SourceFile> {
        let text = &self.machine.checked.sources.file(self.root()).text;
        ast::SourceFile::cast(syntax::parse_asmetal(self.root(), text).syntax())
    }

    fn root(&self) -> FileId {
        self.machine.model().root
    }

    /// A function of the machine.
    pub(super) fn function(&self, name: &str) -> String {
        self.devices.get(name).cloned().unwrap_or_else(|| format!("{}_{name}", self.component))
    }

    /// A rule of the machine.
    pub(super) fn rule(&self, name: &str) -> String {
        format!("r_{}_{}", self.component, name.strip_prefix("r_").unwrap_or(name))
    }

    /// A domain of the machine.
    pub(super) fn domain(&self, name: &str) -> String {
        let mut letters = self.component.chars();
        let first = letters.next().map(|first| first.to_uppercase().to_string()).unwrap_or_default();
        format!("{first}{}{name}", letters.as_str())
    }

    fn literal(&self, name: &str) -> String {
        format!("{}_{name}", self.component.to_uppercase())
    }

    /// Whether a function may have any value in each step.
    pub(super) fn is_free(&self, name: &str) -> bool {
        self.machine.freed.contains(name)
    }

    /// The text of a part, with these names, and without what is done to functions that are free.
    pub(super) fn text(&self, node: &SyntaxNode) -> String {
        let mut text = String::new();
        if self.machine.freed.is_empty() {
            let tokens = node.descendants_with_tokens().filter_map(|element| element.into_token());
            text.extend(tokens.map(|token| self.token(&token)));
        } else if let Some(tree) = node.ancestors().last() {
            self.kept_text(&tree, node, &mut text);
        }
        text.trim().to_string()
    }

    fn kept_text(&self, tree: &SyntaxNode, node: &SyntaxNode, text: &mut String) {
        if ast::Rule::cast(node.clone()).is_some() && reads::is_idle(tree, node, &|name| self.is_free(name)) {
            // Comments before it may stand within it.
            text.push_str(" skip ");
            return;
        }
        for child in node.children_with_tokens() {
            match child.as_token() {
                Some(token) => text.push_str(&self.token(token)),
                None => child.as_node().into_iter().for_each(|child| self.kept_text(tree, child, text)),
            }
        }
    }

    fn token(&self, token: &SyntaxToken) -> String {
        let text = token.text();
        let model = self.machine.model();
        let is_own = |span: Option<Span>| span.is_some_and(|span| span.file == self.root());
        match self.uses.get(&Span::new(self.root(), token.text_range())) {
            Some(Referent::Function(id)) => {
                let function = model.function(*id);
                if is_own(Some(function.span)) && !function.library { self.function(text) } else { text.to_string() }
            }
            Some(Referent::Rule(id)) if is_own(Some(model.rule(*id).span)) => self.rule(text),
            Some(Referent::Domain(id)) if is_own(model.domains.get(*id).span) => self.domain(text),
            Some(Referent::Literal(id, _)) if is_own(model.domains.get(*id).span) => self.literal(text),
            Some(Referent::Rule(_) | Referent::Domain(_) | Referent::Literal(..) | Referent::Variable(..)) => {
                text.to_string()
            }
            // A name that might mean several things: it is the machine's if the machine declares it.
            None => self.unresolved(token),
        }
    }

    fn unresolved(&self, token: &SyntaxToken) -> String {
        let text = token.text();
        let model = self.machine.model();
        let own = |span: Option<Span>| span.is_some_and(|span| span.file == self.root());
        let functions = || model.functions.iter().filter(|function| function.name == text);
        match token.kind() {
            SyntaxKind::FUNCTION_ID if functions().count() > 0 && functions().all(|one| own(Some(one.span))) => {
                self.function(text)
            }
            SyntaxKind::RULE_ID if model.rules.iter().any(|rule| rule.name == text && own(Some(rule.span))) => {
                self.rule(text)
            }
            _ => text.to_string(),
        }
    }
}

/// The first name that a declaration or definition has.
pub(super) fn declared(node: &SyntaxNode) -> Option<SyntaxToken> {
    let names = [SyntaxKind::FUNCTION_ID, SyntaxKind::DOMAIN_ID, SyntaxKind::ENUM_ID, SyntaxKind::RULE_ID];
    let mut tokens = node.descendants_with_tokens().filter_map(|element| element.into_token());
    tokens.find(|token| names.contains(&token.kind()))
}
