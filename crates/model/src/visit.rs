//! Walks over terms and rules in the order of the text; the parts of a node come before its later siblings.
//!
//! In: a term or rule, and a function to call on each. INVARIANT: every term and rule inside is visited once, the
//! outermost first; any depth is safe.

use crate::rule::{RuleKind, RuleNode, Target};
use crate::term::{Binder, Term, TermKind};

const RED_ZONE: usize = 64 * 1024;
const SEGMENT: usize = 1024 * 1024;

impl Term {
    /// Calls `visit` on this term and all inside it.
    pub fn walk<'t>(&'t self, visit: &mut dyn FnMut(&'t Term)) {
        visit(self);
        stacker::maybe_grow(RED_ZONE, SEGMENT, || self.parts(&mut |part| part.walk(visit)));
    }

    /// Calls `visit` on the terms directly inside this one.
    pub fn parts<'t>(&'t self, visit: &mut dyn FnMut(&'t Term)) {
        match &self.kind {
            TermKind::Literal(_)
            | TermKind::Variable(_)
            | TermKind::Domain(_)
            | TermKind::Rule(_)
            | TermKind::Unbound(_)
            | TermKind::Error => {}
            TermKind::Apply { arguments: parts, .. }
            | TermKind::Tuple(parts)
            | TermKind::Collection { elements: parts, .. } => {
                parts.iter().for_each(visit);
            }
            TermKind::Project { tuple: inner, .. } | TermKind::Coerce(inner) => visit(inner),
            TermKind::Range { low, high, step, .. } => {
                visit(low);
                visit(high);
                step.as_deref().into_iter().for_each(visit);
            }
            TermKind::Comprehension { binders, condition, body, .. } => {
                ranges(binders, visit);
                condition.as_deref().into_iter().for_each(&mut *visit);
                visit(body);
            }
            TermKind::Quantified { binders, condition, .. } => {
                ranges(binders, visit);
                condition.as_deref().into_iter().for_each(visit);
            }
            TermKind::If { branches, otherwise } => {
                pairs(branches, visit);
                otherwise.as_deref().into_iter().for_each(visit);
            }
            TermKind::Switch { subject, cases, otherwise } => {
                visit(subject);
                pairs(cases, visit);
                otherwise.as_deref().into_iter().for_each(visit);
            }
            TermKind::Let { bindings, body } => {
                bindings.iter().for_each(|(_, term)| visit(term));
                visit(body);
            }
        }
    }
}

impl RuleNode {
    /// Calls `visit` on this rule and all rules inside it.
    pub fn walk<'r>(&'r self, visit: &mut dyn FnMut(&'r RuleNode)) {
        visit(self);
        stacker::maybe_grow(RED_ZONE, SEGMENT, || self.parts(&mut |part| part.walk(visit)));
    }

    /// Calls `visit` on the rules directly inside this one.
    pub fn parts<'r>(&'r self, visit: &mut dyn FnMut(&'r RuleNode)) {
        match &self.kind {
            RuleKind::Skip
            | RuleKind::Update { .. }
            | RuleKind::MacroCall(_)
            | RuleKind::TurboCall(_)
            | RuleKind::Return { .. }
            | RuleKind::RunValue { .. }
            | RuleKind::RunAgent { .. }
            | RuleKind::Error => {}
            RuleKind::Par(rules) | RuleKind::Seq(rules) => rules.iter().for_each(visit),
            RuleKind::If { branches: parts, otherwise } | RuleKind::Switch { cases: parts, otherwise, .. } => {
                parts.iter().for_each(|(_, rule)| visit(rule));
                otherwise.as_deref().into_iter().for_each(visit);
            }
            RuleKind::Choose { body, if_none, .. } => {
                visit(body);
                if_none.as_deref().into_iter().for_each(visit);
            }
            RuleKind::Let { body, .. }
            | RuleKind::Forall { body, .. }
            | RuleKind::Extend { body, .. }
            | RuleKind::Iterate(body)
            | RuleKind::While { body, .. }
            | RuleKind::RecursiveWhile { body, .. } => visit(body),
            RuleKind::Local { locals, body } => {
                locals.iter().for_each(|(_, rule)| visit(rule));
                visit(body);
            }
        }
    }

    /// Calls `visit` on the terms of this rule that are not in a rule inside it; of an update target, on its arguments.
    pub fn terms<'r>(&'r self, visit: &mut dyn FnMut(&'r Term)) {
        match &self.kind {
            RuleKind::Update { target, value } => {
                target_terms(target, visit);
                visit(value);
            }
            RuleKind::MacroCall(call) | RuleKind::TurboCall(call) => call.arguments.iter().for_each(visit),
            RuleKind::Return { target, call } => {
                target_terms(target, visit);
                call.arguments.iter().for_each(visit);
            }
            RuleKind::RunValue { rule, arguments } => {
                visit(rule);
                arguments.iter().for_each(visit);
            }
            RuleKind::RunAgent { agent } => visit(agent),
            RuleKind::If { branches, .. } => branches.iter().for_each(|(guard, _)| visit(guard)),
            RuleKind::Switch { subject, cases, .. } => {
                visit(subject);
                cases.iter().for_each(|(value, _)| visit(value));
            }
            RuleKind::Let { bindings, .. } => bindings.iter().for_each(|(_, term)| visit(term)),
            RuleKind::Choose { binders, condition, .. } | RuleKind::Forall { binders, condition, .. } => {
                ranges(binders, visit);
                condition.iter().for_each(visit);
            }
            RuleKind::While { condition, .. } | RuleKind::RecursiveWhile { condition, .. } => visit(condition),
            RuleKind::Skip
            | RuleKind::Par(_)
            | RuleKind::Seq(_)
            | RuleKind::Extend { .. }
            | RuleKind::Iterate(_)
            | RuleKind::Local { .. }
            | RuleKind::Error => {}
        }
    }
}

fn target_terms<'r>(target: &'r Target, visit: &mut dyn FnMut(&'r Term)) {
    if let Target::Location { arguments, .. } = target {
        arguments.iter().for_each(visit);
    }
}

fn ranges<'t>(binders: &'t [Binder], visit: &mut dyn FnMut(&'t Term)) {
    binders.iter().for_each(|binder| visit(&binder.range));
}

fn pairs<'t>(pairs: &'t [(Term, Term)], visit: &mut dyn FnMut(&'t Term)) {
    for (first, second) in pairs {
        visit(first);
        visit(second);
    }
}
