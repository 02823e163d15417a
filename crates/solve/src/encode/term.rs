//! Encodes terms, like `machine/src/evaluate.rs`.
//!
//! SYNC(evaluate): the order of evaluation and of faults.

use machine::{Closed, Value};
use program::{
    Builtin, CollectionKind, DomainKind, Expression, FunctionId, FunctionKind, Quantifier, Slot, Term, TermId, TermList,
};
use std::collections::BTreeSet;
use std::sync::Arc;

use super::{Encoder, FaultClass, Result, components, free};
use crate::shared::{Node, Terms};
use crate::symbol::{Open, Shape, Symbol};

impl Encoder {
    /// The symbol of a term.
    pub(super) fn evaluate(&mut self, id: TermId) -> Result {
        let program = Arc::clone(&self.program);
        self.count(program.term_span(id))?;
        if let Term::Slot(slot) = program.term(id) {
            return Ok(self.frame[slot.0 as usize].clone());
        }
        if let Some(symbol) = self.evaluate_fixed(id)? {
            return Ok(symbol);
        }
        let symbol = stacker::maybe_grow(128 << 10, 4 << 20, || self.evaluate_open(id));
        Encoder::placed(symbol, program.term_span(id))
    }

    fn evaluate_open(&mut self, id: TermId) -> Result {
        let program = Arc::clone(&self.program);
        let span = program.term_span(id);
        match program.term(id) {
            Term::Constant(_) | Term::Slot(_) => self.outside("a constant without a value", span),
            Term::Read { function, arguments } => self.read(*function, *arguments, id),
            Term::Define { function, arguments } => self.evaluate_definition(*function, *arguments, id),
            Term::Builtin { builtin, arguments } => self.evaluate_builtin(*builtin, program.term_list(*arguments), id),
            Term::If { branches, otherwise } => self.evaluate_if(program.term_list(*branches), *otherwise),
            Term::Switch { subject, cases, otherwise } => {
                let subject = self.evaluate(*subject)?;
                self.evaluate_cases(&subject, program.term_list(*cases), *otherwise)
            }
            Term::Let { slot, value, body } => {
                let value = self.evaluate(*value)?;
                self.bind(*slot, value);
                self.evaluate(*body)
            }
            Term::Tuple(parts) => Ok(Symbol::Tuple(self.evaluate_all(*parts)?)),
            Term::Project { tuple, index } => {
                let tuple = self.evaluate(*tuple)?;
                match components(&tuple) {
                    Some(mut parts) if parts.len() > *index as usize => Ok(parts.swap_remove(*index as usize)),
                    _ => self.outside("a component of what is no tuple", span),
                }
            }
            Term::Quantified { quantifier, binders, condition } => {
                let bindings = self.bindings(program.binder_list(*binders))?;
                self.evaluate_quantified(*quantifier, program.binder_list(*binders), bindings, *condition)
            }
            Term::Collection { kind: CollectionKind::Set, elements } => {
                let elements = self.evaluate_all(*elements)?;
                self.set_of(elements.into_iter().map(|element| (Terms::TRUE, element)).collect())
            }
            Term::Range { kind: CollectionKind::Set, low, high, step: None } => {
                let elements = self.range_between(*low, *high, span)?;
                Ok(Symbol::Set(elements))
            }
            Term::Comprehension { kind: CollectionKind::Set, binders, condition, body } => {
                let binders = program.binder_list(*binders);
                let mut elements = Vec::new();
                for (present, values) in self.bindings(binders)? {
                    self.bind_all(binders, &values);
                    let element = self.under(present, |this| {
                        let holds = condition.map_or(Ok(Terms::TRUE), |condition| this.holds(condition))?;
                        let element = this.under(holds, |this| this.evaluate(*body))?;
                        Ok(element.map(|element| (this.terms.and([present, holds]), element)))
                    })?;
                    elements.extend(element.flatten());
                }
                self.set_of(elements)
            }
            Term::Domain(_) => self.outside("a domain whose elements cannot be listed", span),
            Term::Coerce(operand) => {
                let operand = self.evaluate(*operand)?;
                let complex = !matches!(
                    program.domain(program.base_domain(program.term_domain(id))).kind,
                    DomainKind::Basic(model::Basic::Real)
                );
                self.coerce(&operand, complex, span)
            }
            Term::Collection { .. } | Term::Range { .. } | Term::Comprehension { .. } => {
                let domain = &program.domain(program.term_domain(id)).name;
                self.outside(format!("a term of the domain {domain}"), span)
            }
            Term::Missing(function) if self.free.is_some() && program.function(*function).parameters.is_empty() => {
                self.read_free(*function, &[], span)
            }
            Term::Rule(_) | Term::Unbound | Term::Missing(_) => self.outside("a term that is no value", span),
        }
    }

    /// The value of a term that depends only on known variables: the machine evaluates it.
    fn evaluate_fixed(&mut self, id: TermId) -> Result<Option<Symbol>> {
        let Some(slots) = self.free_variables(id) else { return Ok(None) };
        let mut bindings = Vec::with_capacity(slots.len());
        for slot in slots.iter() {
            let Symbol::Known(value) = &self.frame[slot.0 as usize] else { return Ok(None) };
            bindings.push((*slot, value.clone()));
        }
        let frame = self.frame.len() as u32;
        let symbol = match self.machine.evaluate_with(id, frame, &bindings, &mut Closed) {
            Ok(value) => Symbol::Known(value),
            Err(fault) => self.met(&fault)?,
        };
        Ok(Some(symbol))
    }

    /// The free variables of a term, if its value depends on them alone.
    fn free_variables(&mut self, id: TermId) -> Option<Arc<[Slot]>> {
        if let Some(known) = self.fixed.get(&id) {
            return known.clone();
        }
        let closed = match self.free {
            Some(_) => self.is_settled(id),
            None => {
                let expression = Expression { parameters: Vec::new(), frame: 0, names: Vec::new(), body: id };
                self.program.reads(&expression).is_some_and(|read| read.is_empty())
            }
        };
        let free = closed.then(|| free_in(&self.program, id));
        self.fixed.insert(id, free.clone());
        free
    }

    pub(super) fn evaluate_all(&mut self, list: TermList) -> Result<Vec<Symbol>> {
        let program = Arc::clone(&self.program);
        program.term_list(list).iter().map(|term| self.evaluate(*term)).collect()
    }

    /// The condition that a guard holds; adds a fault if it is undef.
    pub(super) fn holds(&mut self, id: TermId) -> Result<Node> {
        match self.evaluate(id)? {
            Symbol::Known(Value::Boolean(truth)) => Ok(self.terms.boolean(truth)),
            Symbol::Open(Open { shape: Shape::Boolean, value, defined }) => {
                let undefined = self.terms.not(defined);
                self.fault(FaultClass::Undefined, undefined);
                Ok(self.terms.and([value, defined]))
            }
            _ => {
                self.fault(FaultClass::Undefined, Terms::TRUE);
                Ok(Terms::FALSE)
            }
        }
    }

    fn evaluate_if(&mut self, branches: &[TermId], otherwise: Option<TermId>) -> Result {
        let [guard, value, rest @ ..] = branches else {
            return otherwise.map_or(Ok(Symbol::UNDEF), |otherwise| self.evaluate(otherwise));
        };
        let holds = self.holds(*guard)?;
        let yes = self.under(holds, |this| this.evaluate(*value))?;
        let not = self.terms.not(holds);
        let no = self.under(not, |this| this.evaluate_if(rest, otherwise))?;
        self.either(holds, yes, no)
    }

    fn evaluate_cases(&mut self, subject: &Symbol, cases: &[TermId], otherwise: Option<TermId>) -> Result {
        let [case, value, rest @ ..] = cases else {
            return otherwise.map_or(Ok(Symbol::UNDEF), |otherwise| self.evaluate(otherwise));
        };
        let case = self.evaluate(*case)?;
        let holds = self.equal(&case, subject)?;
        let yes = self.under(holds, |this| this.evaluate(*value))?;
        let not = self.terms.not(holds);
        let no = self.under(not, |this| this.evaluate_cases(subject, rest, otherwise))?;
        self.either(holds, yes, no)
    }

    /// The result of two branches, of which one may be impossible.
    fn either(&mut self, condition: Node, yes: Option<Symbol>, no: Option<Symbol>) -> Result {
        match (yes, no) {
            (Some(yes), Some(no)) => self.merge(condition, &yes, &no),
            (Some(one), None) | (None, Some(one)) => Ok(one),
            (None, None) => Ok(Symbol::UNDEF),
        }
    }

    fn evaluate_definition(&mut self, function: FunctionId, arguments: TermList, id: TermId) -> Result {
        let program = Arc::clone(&self.program);
        let arguments = self.evaluate_all(arguments)?;
        let Some(definition) = &program.function(function).definition else { return Ok(Symbol::UNDEF) };
        debug_assert!(!matches!(program.function(function).kind, FunctionKind::Monitored));
        self.in_frame(arguments, definition.frame, program.term_span(id), |this| this.evaluate(definition.body))
    }

    fn evaluate_quantified(
        &mut self,
        quantifier: Quantifier,
        binders: &[program::Binder],
        bindings: Vec<(Node, Vec<Symbol>)>,
        condition: Option<TermId>,
    ) -> Result {
        // A deciding element ends the evaluation.
        let (mut once, mut twice, mut refuted) = (Terms::FALSE, Terms::FALSE, Terms::FALSE);
        for (present, values) in bindings {
            self.bind_all(binders, &values);
            let decided = match quantifier {
                Quantifier::Forall => refuted,
                Quantifier::Exists => once,
                Quantifier::ExistsUnique => twice,
            };
            let open = self.terms.not(decided);
            let here = self.terms.and([present, open]);
            let holds = self.under(here, |this| match condition {
                Some(condition) => this.holds(condition),
                None => Ok(Terms::TRUE),
            })?;
            let Some(holds) = holds else { continue };
            let satisfied = self.terms.and([present, holds]);
            let again = self.terms.and([once, satisfied]);
            twice = self.terms.or([twice, again]);
            once = self.terms.or([once, satisfied]);
            let not = self.terms.not(holds);
            let fails = self.terms.and([present, not]);
            refuted = self.terms.or([refuted, fails]);
        }
        let value = match quantifier {
            Quantifier::Forall => self.terms.not(refuted),
            Quantifier::Exists => once,
            Quantifier::ExistsUnique => {
                let not = self.terms.not(twice);
                self.terms.and([once, not])
            }
        };
        Ok(Symbol::boolean(value))
    }

    /// The connectives evaluate their right operand only if it matters; `pre` reads the state before the step.
    fn evaluate_builtin(&mut self, builtin: Builtin, arguments: &[TermId], id: TermId) -> Result {
        match (builtin, arguments) {
            (Builtin::And | Builtin::Or | Builtin::Implies, [left, right]) => {
                let left = self.evaluate(*left)?;
                let (mut holds, mut fails) = self.truths(&left);
                if builtin == Builtin::Implies {
                    (holds, fails) = (fails, holds);
                }
                let conjunction = builtin == Builtin::And;
                let decided = if conjunction { fails } else { holds };
                let open = self.terms.not(decided);
                let right = self.under(open, |this| this.evaluate(*right))?;
                let Some(right) = right else { return Ok(Symbol::Known(Value::Boolean(!conjunction))) };
                let (right_holds, right_fails) = self.truths(&right);
                let (value, decided) = if conjunction {
                    (self.terms.and([holds, right_holds]), self.terms.or([fails, right_fails]))
                } else {
                    let either = self.terms.or([holds, right_holds]);
                    (either, either)
                };
                let both = [self.defined(&left), self.defined(&right)];
                let both = self.terms.and(both);
                let defined = self.terms.or([both, decided]);
                Ok(self.symbol(Open { shape: Shape::Boolean, value, defined }))
            }
            (builtin, _) if self.free.is_some() && free::depends_on_more(builtin) => {
                let span = self.program.term_span(id);
                self.outside(format!("the function `{}`", builtin.name()), span)
            }
            (
                Builtin::SetContains | Builtin::SetNotIn | Builtin::SeqContains | Builtin::BagContains,
                [collection, element],
            ) if self.free.is_some() => {
                if let Some(within) = self.is_written_in(*collection, *element)? {
                    return match builtin {
                        Builtin::SetNotIn => self.apply(Builtin::Not, &[within], id),
                        _ => Ok(within),
                    };
                }
                let operands = [self.evaluate(*collection)?, self.evaluate(*element)?];
                self.apply(builtin, &operands, id)
            }
            (Builtin::Pre, [term]) => {
                let former = std::mem::replace(&mut self.before, true);
                let value = self.evaluate(*term);
                self.before = former;
                value
            }
            _ => {
                let operands = arguments.iter().map(|term| self.evaluate(*term)).collect::<Result<Vec<_>>>()?;
                self.apply(builtin, &operands, id)
            }
        }
    }

    /// The conditions that a truth value is true and that it is false.
    pub fn truths(&mut self, symbol: &Symbol) -> (Node, Node) {
        match symbol {
            Symbol::Known(Value::Boolean(truth)) => (self.terms.boolean(*truth), self.terms.boolean(!truth)),
            Symbol::Open(Open { shape: Shape::Boolean, value, defined }) => {
                let not = self.terms.not(*value);
                (self.terms.and([*value, *defined]), self.terms.and([not, *defined]))
            }
            _ => (Terms::FALSE, Terms::FALSE),
        }
    }
}

fn free_in(program: &program::Program, id: TermId) -> Arc<[Slot]> {
    let (mut used, mut bound, mut open) = (BTreeSet::new(), BTreeSet::new(), vec![id]);
    while let Some(id) = open.pop() {
        match program.term(id) {
            Term::Slot(slot) => _ = used.insert(*slot),
            Term::Let { slot, .. } => _ = bound.insert(*slot),
            Term::Comprehension { binders, .. } | Term::Quantified { binders, .. } => {
                bound.extend(program.binder_list(*binders).iter().map(|binder| binder.slot));
            }
            Term::Constant(_)
            | Term::Read { .. }
            | Term::Define { .. }
            | Term::Builtin { .. }
            | Term::Domain(_)
            | Term::Tuple(_)
            | Term::Project { .. }
            | Term::Collection { .. }
            | Term::Range { .. }
            | Term::If { .. }
            | Term::Switch { .. }
            | Term::Rule(_)
            | Term::Unbound
            | Term::Missing(_)
            | Term::Coerce(_) => {}
        }
        program.each_child_of_term(id, &mut |child| open.push(child));
    }
    used.difference(&bound).copied().collect()
}
