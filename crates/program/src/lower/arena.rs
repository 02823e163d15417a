//! Adds terms, rules and lists to the arenas.
//!
//! Children are added before their parents. INVARIANT: the tables of domains and places grow with their arena.

use model::{DomainId, Domains, Literal};
use syntax::Span;

use crate::ir::{Binder, BinderList, Rule, RuleId, RuleList, Term, TermId, TermList};
use crate::lower::{Lowering, MAX_NODES};

impl Lowering<'_, '_> {
    /// Adds a term.
    pub(super) fn term(&mut self, term: Term, domain: DomainId, span: Span) -> TermId {
        self.check_size(span);
        self.push_term(term, domain, span)
    }

    /// Adds a rule.
    pub(super) fn rule(&mut self, rule: Rule, span: Span) -> RuleId {
        self.check_size(span);
        self.push_rule(rule, span)
    }

    fn push_term(&mut self, term: Term, domain: DomainId, span: Span) -> TermId {
        self.program.add_term(term, domain, span)
    }

    fn push_rule(&mut self, rule: Rule, span: Span) -> RuleId {
        self.program.rules.push(rule);
        self.program.rule_spans.push(span);
        RuleId(self.program.rules.len() as u32 - 1)
    }

    /// Adds a list of terms.
    pub(super) fn term_list(&mut self, terms: &[TermId]) -> TermList {
        let start = self.program.term_lists.len() as u32;
        self.program.term_lists.extend_from_slice(terms);
        TermList { start, len: terms.len() as u32 }
    }

    /// Adds a list of rules.
    pub(super) fn rule_list(&mut self, rules: &[RuleId]) -> RuleList {
        let start = self.program.rule_lists.len() as u32;
        self.program.rule_lists.extend_from_slice(rules);
        RuleList { start, len: rules.len() as u32 }
    }

    /// Adds a list of binders.
    pub(super) fn binder_list(&mut self, binders: &[Binder]) -> BinderList {
        let start = self.program.binder_lists.len() as u32;
        self.program.binder_lists.extend_from_slice(binders);
        BinderList { start, len: binders.len() as u32 }
    }

    /// The term and the rule that replace all others once a limit is passed. They are added even then.
    pub(super) fn sentinels(&mut self, span: Span) -> (TermId, RuleId) {
        let undef = self.constant_index(&Literal::Undef);
        (self.push_term(Term::Constant(undef), Domains::UNDEF, span), self.push_rule(Rule::Skip, span))
    }

    fn check_size(&mut self, span: Span) {
        if self.program.terms.len() + self.program.rules.len() >= MAX_NODES {
            self.stop(span, format!("the model grows to more than {MAX_NODES} terms and rules"));
        }
    }
}
