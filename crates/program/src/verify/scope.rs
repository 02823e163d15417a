//! Frames: every slot that is read is bound around it, and no slot is bound twice.

use std::collections::BTreeSet;

use crate::ir::{BinderList, Expression, Procedure, Program, Rule, RuleId, Slot, Term, TermId};
use crate::verify::{domain_exists, ensure};

pub(super) fn verify_procedure(program: &Program, procedure: &Procedure) -> Result<(), String> {
    ensure((procedure.body.0 as usize) < program.rules.len(), || "the body does not exist".to_string())?;
    for domain in &procedure.parameters {
        domain_exists(program, *domain)?;
    }
    let mut scope = Scope::new(program, procedure.parameters.len(), procedure.frame, &procedure.names)?;
    scope.rule(procedure.body)
}

pub(super) fn verify_expression(program: &Program, expression: &Expression) -> Result<(), String> {
    ensure((expression.body.0 as usize) < program.terms.len(), || "the body does not exist".to_string())?;
    for domain in &expression.parameters {
        domain_exists(program, *domain)?;
    }
    let mut scope = Scope::new(program, expression.parameters.len(), expression.frame, &expression.names)?;
    scope.term(expression.body)
}

struct Scope<'p> {
    program: &'p Program,
    /// Slots that can be read here.
    visible: BTreeSet<Slot>,
    /// Slots bound so far.
    bound: Vec<bool>,
}

impl<'p> Scope<'p> {
    fn new(program: &'p Program, parameters: usize, frame: u32, names: &[String]) -> Result<Self, String> {
        ensure(parameters <= frame as usize, || format!("{parameters} parameters in {frame} slots"))?;
        ensure(names.len() == frame as usize, || format!("{} names for {frame} slots", names.len()))?;
        let mut bound = vec![false; frame as usize];
        bound[..parameters].fill(true);
        Ok(Scope { program, visible: (0..parameters as u32).map(Slot).collect(), bound })
    }

    fn bind(&mut self, slot: Slot) -> Result<(), String> {
        let Some(bound) = self.bound.get_mut(slot.0 as usize) else {
            return Err(format!("slot {} is not in the frame", slot.0));
        };
        ensure(!std::mem::replace(bound, true), || format!("slot {} is bound twice", slot.0))?;
        self.visible.insert(slot);
        Ok(())
    }

    fn bind_all(&mut self, binders: BinderList) -> Result<(), String> {
        for binder in self.program.binder_list(binders) {
            self.term(binder.range)?;
            self.bind(binder.slot)?;
        }
        Ok(())
    }

    fn unbind_all(&mut self, binders: BinderList) {
        for binder in self.program.binder_list(binders) {
            self.visible.remove(&binder.slot);
        }
    }

    fn term(&mut self, id: TermId) -> Result<(), String> {
        stacker::maybe_grow(64 * 1024, 1024 * 1024, || self.term_here(id))
    }

    fn term_here(&mut self, id: TermId) -> Result<(), String> {
        let program = self.program;
        match program.term(id) {
            Term::Slot(slot) => {
                ensure(self.visible.contains(slot), || format!("term {}: slot {} is not bound here", id.0, slot.0))
            }
            Term::Comprehension { binders, condition, body, .. } => {
                self.bind_all(*binders)?;
                condition.map_or(Ok(()), |condition| self.term(condition))?;
                self.term(*body)?;
                self.unbind_all(*binders);
                Ok(())
            }
            Term::Quantified { binders, condition, .. } => {
                self.bind_all(*binders)?;
                condition.map_or(Ok(()), |condition| self.term(condition))?;
                self.unbind_all(*binders);
                Ok(())
            }
            Term::Let { slot, value, body } => {
                self.term(*value)?;
                self.bind(*slot)?;
                self.term(*body)?;
                self.visible.remove(slot);
                Ok(())
            }
            _ => {
                let mut result = Ok(());
                program.each_child_of_term(id, &mut |child| {
                    if result.is_ok() {
                        result = self.term(child);
                    }
                });
                result
            }
        }
    }

    fn rule(&mut self, id: RuleId) -> Result<(), String> {
        stacker::maybe_grow(64 * 1024, 1024 * 1024, || self.rule_here(id))
    }

    fn rule_here(&mut self, id: RuleId) -> Result<(), String> {
        let program = self.program;
        match program.rule(id) {
            Rule::Let { slot, value, body } => {
                self.term(*value)?;
                self.bind(*slot)?;
                self.rule(*body)?;
                self.visible.remove(slot);
                Ok(())
            }
            Rule::Choose { binders, condition, body, if_none } => {
                self.bind_all(*binders)?;
                condition.map_or(Ok(()), |condition| self.term(condition))?;
                self.rule(*body)?;
                self.unbind_all(*binders);
                if_none.map_or(Ok(()), |rule| self.rule(rule))
            }
            Rule::Return { target, arguments, .. } => {
                // If a location replaces `result` in a body, the body gets the arguments of that location: the same terms.
                let arguments = program.term_list(*arguments);
                let target = program.term_list(*target).iter().filter(|term| !arguments.contains(term));
                arguments.iter().chain(target).try_for_each(|term| self.term(*term))
            }
            Rule::Forall { binders, condition, body } => {
                self.bind_all(*binders)?;
                condition.map_or(Ok(()), |condition| self.term(condition))?;
                self.rule(*body)?;
                self.unbind_all(*binders);
                Ok(())
            }
            Rule::Extend { first, count, body, .. } => {
                let slots = first.0..first.0.saturating_add(*count);
                slots.clone().try_for_each(|slot| self.bind(Slot(slot)))?;
                self.rule(*body)?;
                slots.for_each(|slot| {
                    self.visible.remove(&Slot(slot));
                });
                Ok(())
            }
            _ => {
                let mut result = Ok(());
                program.each_term_of_rule(id, &mut |term| {
                    if result.is_ok() {
                        result = self.term(term);
                    }
                });
                program.each_child_of_rule(id, &mut |rule| {
                    if result.is_ok() {
                        result = self.rule(rule);
                    }
                });
                result
            }
        }
    }
}
