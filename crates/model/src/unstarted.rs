//! Finds control states that nothing ever enters: functions without an initial value that are set only if they have one.
//!
//! In: a model without errors. Out: a warning for each such function. It finds controlled functions over enums that no
//! initial state gives a value, if each of their updates, in all rules that can run, is guarded by a test for one of
//! their values: `mode = IDLE`, `switch mode`, `isDef(mode)`, also within `and` and derived functions. INVARIANT: it
//! reports no function that some rule might set first. So rules that are used as values, and locations that are passed to
//! rules, count as updates.

use std::collections::BTreeSet;

use syntax::Span;

use crate::declaration::FunctionKind;
use crate::domain::DomainKind;
use crate::fault::{self, Faults};
use crate::id::{FunctionId, RuleId};
use crate::model::Model;
use crate::rule::{RuleKind, RuleNode, Target};
use crate::running::roots;
use crate::term::{Literal, Term, TermKind};

/// LIMIT: the depth to which definitions of derived functions are followed.
const DEFINITIONS: usize = 8;

/// Warns of functions that never get a value.
pub(crate) fn check(model: &Model, faults: &mut Faults) {
    let roots = roots(model);
    if roots.is_empty() {
        return;
    }
    let init = model.default_init.and_then(|index| model.inits.get(index));
    let given = |id: FunctionId| init.is_some_and(|init| init.functions.iter().any(|given| given.function == id));
    for (index, function) in model.functions.iter().enumerate() {
        let id = FunctionId(index as u32);
        let over_enum =
            matches!(model.domains.kind(model.domains.type_domain(function.codomain)), DomainKind::Enum { .. });
        if function.kind != FunctionKind::Controlled || function.library || !over_enum || given(id) {
            continue;
        }
        let mut search = Search { model, function: id, asked: None };
        if !search.can_begin(&roots)
            && let Some(asked) = search.asked
        {
            faults.push(fault::function::unstarted(function.span, &function.name, asked, init.is_some()));
        }
    }
}

struct Search<'m> {
    model: &'m Model,
    function: FunctionId,
    /// The first test that guards an update of the function.
    asked: Option<Span>,
}

impl<'m> Search<'m> {
    /// Whether a rule that can run while the function has no value may give it one.
    fn can_begin(&mut self, roots: &BTreeSet<RuleId>) -> bool {
        let mut seen = roots.clone();
        let mut open: Vec<&'m RuleNode> = roots.iter().map(|rule| &self.model.rule(*rule).body).collect();
        while let Some(node) = open.pop() {
            let call = match &node.kind {
                RuleKind::Update { target, .. } if self.sets(target) => return true,
                RuleKind::Return { target, .. } if self.sets(target) => return true,
                RuleKind::MacroCall(call) | RuleKind::TurboCall(call) | RuleKind::Return { call, .. } => Some(call),
                _ => None,
            };
            if let Some(call) = call {
                if call.arguments.iter().any(|argument| self.is_location(argument)) {
                    return true;
                }
                if seen.insert(call.rule) {
                    open.push(&self.model.rule(call.rule).body);
                }
            }
            self.parts(node, &mut open);
        }
        false
    }

    /// The rules inside that run while the function has no value.
    fn parts(&mut self, node: &'m RuleNode, open: &mut Vec<&'m RuleNode>) {
        match &node.kind {
            RuleKind::If { branches, otherwise } => {
                for (guard, rule) in branches {
                    self.unless(self.excludes(guard, 0), guard.span, rule, open);
                }
                open.extend(otherwise.as_deref());
            }
            RuleKind::Switch { subject, cases, otherwise } => {
                let over = self.is_location(subject);
                for (value, rule) in cases {
                    self.unless(over && is_value(value), value.span, rule, open);
                }
                open.extend(otherwise.as_deref());
            }
            RuleKind::Choose { condition: Some(condition), body, if_none, .. } => {
                self.unless(self.excludes(condition, 0), condition.span, body, open);
                open.extend(if_none.as_deref());
            }
            RuleKind::Forall { condition: Some(condition), body, .. }
            | RuleKind::While { condition, body }
            | RuleKind::RecursiveWhile { condition, body } => {
                self.unless(self.excludes(condition, 0), condition.span, body, open);
            }
            _ => node.parts(&mut |part| open.push(part)),
        }
    }

    fn unless(&mut self, excluded: bool, test: Span, rule: &'m RuleNode, open: &mut Vec<&'m RuleNode>) {
        if !excluded {
            open.push(rule);
        } else if self.asked.is_none() {
            self.asked = Some(test);
        }
    }

    fn sets(&self, target: &Target) -> bool {
        matches!(target, Target::Location { function, .. } if *function == self.function)
    }

    /// The function applied, and nothing else.
    fn is_location(&self, term: &Term) -> bool {
        matches!(&term.kind, TermKind::Apply { function, .. } if *function == self.function)
    }

    /// Whether the term cannot be true while the function has no value.
    fn excludes(&self, term: &Term, depth: usize) -> bool {
        let TermKind::Apply { function, arguments } = &term.kind else { return false };
        let applied = self.model.function(*function);
        if !applied.library {
            let body = applied.definition.as_ref().filter(|_| depth < DEFINITIONS).map(|definition| &definition.body);
            return body.is_some_and(|body| self.excludes(body, depth + 1));
        }
        match (applied.name.as_str(), &arguments[..]) {
            ("and", both) => both.iter().any(|one| self.excludes(one, depth)),
            ("or", both) => both.iter().all(|one| self.excludes(one, depth)),
            ("eq", [one, other]) => {
                self.is_location(one) && is_value(other) || self.is_location(other) && is_value(one)
            }
            ("isDef", [one]) => self.is_location(one),
            _ => false,
        }
    }
}

/// A literal that is not undef.
fn is_value(term: &Term) -> bool {
    matches!(&term.kind, TermKind::Literal(literal) if !matches!(literal, Literal::Undef))
}
