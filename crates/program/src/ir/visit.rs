//! The children of terms and rules, in the order in which they are written.
//!
//! It is for code that walks a program whatever its constructs mean: the verifier, dependency searches, generators.
//! The procedure of a call is not a child, because it has its own frame.

use std::collections::BTreeSet;

use crate::ir::{BinderList, Expression, Program, Rule, RuleId, Term, TermId};
use model::{FunctionId, FunctionKind};

impl Program {
    /// Calls `visit` with each child of a term: arguments, ranges, conditions, bodies.
    pub fn each_child_of_term(&self, id: TermId, visit: &mut dyn FnMut(TermId)) {
        match self.term(id) {
            Term::Constant(_) | Term::Slot(_) | Term::Domain(_) | Term::Rule(_) | Term::Unbound | Term::Missing(_) => {}
            Term::Read { arguments: list, .. }
            | Term::Define { arguments: list, .. }
            | Term::Builtin { arguments: list, .. }
            | Term::Tuple(list)
            | Term::Collection { elements: list, .. } => self.term_list(*list).iter().copied().for_each(visit),
            Term::Project { tuple: term, .. } | Term::Coerce(term) => visit(*term),
            Term::Range { low, high, step, .. } => {
                [Some(*low), Some(*high), *step].into_iter().flatten().for_each(visit)
            }
            Term::Comprehension { binders, condition, body, .. } => {
                self.each_range(*binders, visit);
                condition.iter().copied().for_each(&mut *visit);
                visit(*body);
            }
            Term::Quantified { binders, condition, .. } => {
                self.each_range(*binders, visit);
                condition.iter().copied().for_each(visit);
            }
            Term::If { branches, otherwise } => {
                self.term_list(*branches).iter().chain(otherwise).copied().for_each(visit);
            }
            Term::Switch { subject, cases, otherwise } => {
                visit(*subject);
                self.term_list(*cases).iter().chain(otherwise).copied().for_each(visit);
            }
            Term::Let { value, body, .. } => {
                visit(*value);
                visit(*body);
            }
        }
    }

    /// Calls `visit` with each term that stands directly in a rule: guards, arguments, values, ranges.
    pub fn each_term_of_rule(&self, id: RuleId, visit: &mut dyn FnMut(TermId)) {
        match self.rule(id) {
            Rule::Skip | Rule::Par(_) | Rule::Seq(_) | Rule::Extend { .. } | Rule::Iterate(_) | Rule::Local { .. } => {}
            Rule::Update { arguments, value, .. } => {
                self.term_list(*arguments).iter().copied().for_each(&mut *visit);
                visit(*value);
            }
            Rule::Call { arguments: list, .. }
            | Rule::TurboCall { arguments: list, .. }
            | Rule::If { guards: list, .. } => {
                self.term_list(*list).iter().copied().for_each(visit);
            }
            Rule::Return { target, arguments, .. } => {
                self.term_list(*target).iter().chain(self.term_list(*arguments)).copied().for_each(visit);
            }
            Rule::RunValue { rule: first, arguments: rest } | Rule::Switch { subject: first, values: rest, .. } => {
                visit(*first);
                self.term_list(*rest).iter().copied().for_each(visit);
            }
            Rule::RunAgent { agent: term }
            | Rule::Let { value: term, .. }
            | Rule::While { condition: term, .. }
            | Rule::RecursiveWhile { condition: term, .. } => visit(*term),
            Rule::Choose { binders, condition, .. } | Rule::Forall { binders, condition, .. } => {
                self.each_range(*binders, visit);
                condition.iter().copied().for_each(visit);
            }
        }
    }

    /// Calls `visit` with each rule that stands directly in a rule.
    pub fn each_child_of_rule(&self, id: RuleId, visit: &mut dyn FnMut(RuleId)) {
        match self.rule(id) {
            Rule::Skip
            | Rule::Update { .. }
            | Rule::Call { .. }
            | Rule::TurboCall { .. }
            | Rule::Return { .. }
            | Rule::RunValue { .. }
            | Rule::RunAgent { .. } => {}
            Rule::Par(list) | Rule::Seq(list) | Rule::If { rules: list, .. } | Rule::Switch { rules: list, .. } => {
                self.rule_list(*list).iter().copied().for_each(visit);
            }
            Rule::Let { body, .. }
            | Rule::Forall { body, .. }
            | Rule::Extend { body, .. }
            | Rule::Iterate(body)
            | Rule::While { body, .. }
            | Rule::RecursiveWhile { body, .. } => visit(*body),
            Rule::Choose { body, if_none, .. } => [Some(*body), *if_none].into_iter().flatten().for_each(visit),
            Rule::Local { initialisations, body, .. } => {
                self.rule_list(*initialisations).iter().chain([body]).copied().for_each(visit);
            }
        }
    }

    /// Whether a term reads a monitored function, directly or through definitions.
    pub fn reads_monitored(&self, expression: &Expression) -> bool {
        let mut entered = vec![false; self.functions.len()];
        let mut open = vec![expression.body];
        while let Some(id) = open.pop() {
            let function: Option<FunctionId> = match self.term(id) {
                Term::Read { function, .. } | Term::Define { function, .. } => Some(*function),
                Term::Constant(_)
                | Term::Slot(_)
                | Term::Builtin { .. }
                | Term::Domain(_)
                | Term::Tuple(_)
                | Term::Project { .. }
                | Term::Collection { .. }
                | Term::Range { .. }
                | Term::Comprehension { .. }
                | Term::Quantified { .. }
                | Term::If { .. }
                | Term::Switch { .. }
                | Term::Let { .. }
                | Term::Rule(_)
                | Term::Unbound
                | Term::Missing(_)
                | Term::Coerce(_) => None,
            };
            if let Some(function) = function {
                if self.function(function).kind == FunctionKind::Monitored {
                    return true;
                }
                if !std::mem::replace(&mut entered[function.0 as usize], true) {
                    open.extend(self.function(function).definition.as_ref().map(|definition| definition.body));
                }
            }
            self.each_child_of_term(id, &mut |child| open.push(child));
        }
        false
    }

    /// The dynamic functions that a closed term reads, directly or through definitions, in order. None if its value
    /// depends on more than these and the elements of domains: on inputs, the clock, a choice, or an agent's program.
    pub fn reads(&self, expression: &Expression) -> Option<Vec<FunctionId>> {
        let (functions, depends_on_more) = self.all_reads(expression);
        (!depends_on_more).then_some(functions)
    }

    /// The dynamic functions that a closed term reads, inputs included, directly or through definitions, in order; and
    /// whether its value depends on more than those of the state and the elements of domains.
    pub fn all_reads(&self, expression: &Expression) -> (Vec<FunctionId>, bool) {
        let (read, depends_on_more) = self.reads_and_more(expression);
        let input = |id: &FunctionId| self.function(*id).kind == FunctionKind::Monitored;
        let depends_on_more = depends_on_more || read.iter().any(input);
        (read, depends_on_more)
    }

    /// The same, but treats monitored functions like all others.
    pub fn reads_and_more(&self, expression: &Expression) -> (Vec<FunctionId>, bool) {
        let mut read = BTreeSet::new();
        let mut depends_on_more = false;
        let mut entered = vec![false; self.functions.len()];
        let mut open = vec![expression.body];
        while let Some(id) = open.pop() {
            match self.term(id) {
                Term::Read { function, .. } | Term::Define { function, .. } => {
                    let kind = self.function(*function).kind;
                    depends_on_more |= Some(*function) == self.self_function || kind == FunctionKind::Shared;
                    if !matches!(kind, FunctionKind::Static | FunctionKind::Derived) {
                        read.insert(*function);
                    }
                    if !std::mem::replace(&mut entered[function.0 as usize], true) {
                        open.extend(self.function(*function).definition.as_ref().map(|definition| definition.body));
                    }
                }
                Term::Builtin { builtin, .. } => depends_on_more |= !builtin.info().effect.is_none(),
                Term::Constant(_)
                | Term::Slot(_)
                | Term::Domain(_)
                | Term::Tuple(_)
                | Term::Project { .. }
                | Term::Collection { .. }
                | Term::Range { .. }
                | Term::Comprehension { .. }
                | Term::Quantified { .. }
                | Term::If { .. }
                | Term::Switch { .. }
                | Term::Let { .. }
                | Term::Rule(_)
                | Term::Unbound
                | Term::Missing(_)
                | Term::Coerce(_) => {}
            }
            self.each_child_of_term(id, &mut |child| open.push(child));
        }
        (read.into_iter().collect(), depends_on_more)
    }

    fn each_range(&self, binders: BinderList, visit: &mut dyn FnMut(TermId)) {
        self.binder_list(binders).iter().for_each(|binder| visit(binder.range));
    }
}
