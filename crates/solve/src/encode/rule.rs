//! Encodes rules as conditional updates, like `machine/src/perform.rs`.
//!
//! SYNC(perform): units, the parts of a sequence, and the order of faults. LIMIT: the rounds of a loop.

use std::sync::Arc;

use machine::Value;
use model::Basic;
use program::{Binder, DomainKind, FunctionId, FunctionKind, ProcedureId, Rule, RuleId, Term, TermId, TermList};
use syntax::Span;

use super::number::INTEGERS;
use super::{Choice, Encoder, FaultClass, InputKind, Result, Unit};
use crate::shared::{Node, Terms};
use crate::symbol::{Open, Shape, Symbol};

const ROUNDS: usize = 64;

/// The values of places before a sequence.
type Log = Vec<(usize, Symbol)>;

impl Encoder {
    /// Executes a rule.
    pub(super) fn perform(&mut self, id: RuleId) -> Result<()> {
        let span = self.program.rule_span(id);
        self.count(span)?;
        Encoder::placed(stacker::maybe_grow(128 << 10, 4 << 20, || self.perform_here(id)), span)
    }

    fn perform_here(&mut self, id: RuleId) -> Result<()> {
        let program = Arc::clone(&self.program);
        let span = program.rule_span(id);
        match program.rule(id) {
            Rule::Skip => Ok(()),
            Rule::Update { function, arguments, value } => {
                let value = self.evaluate(*value)?;
                let arguments = self.evaluate_all(*arguments)?;
                self.update(*function, &arguments, &value, span)
            }
            Rule::Call { procedure, arguments } => self.call(*procedure, *arguments, span),
            Rule::TurboCall { procedure, arguments } => self.turbo(*procedure, *arguments, span).map(drop),
            Rule::Return { function, target, procedure, arguments } => {
                self.perform_return((*function, *target), *procedure, *arguments, span)
            }
            Rule::RunValue { rule, arguments } => match self.evaluate(*rule)? {
                Symbol::Known(Value::Rule(procedure)) => {
                    let declared = program.procedure(procedure);
                    if declared.parameters.len() != arguments.len as usize {
                        self.fault(FaultClass::Undefined, Terms::TRUE);
                        return Ok(());
                    }
                    match declared.turbo {
                        true => self.turbo(procedure, *arguments, span).map(drop),
                        false => self.call(procedure, *arguments, span),
                    }
                }
                Symbol::Known(_) => {
                    self.fault(FaultClass::Undefined, Terms::TRUE);
                    Ok(())
                }
                _ => self.outside("a rule that is not known", span),
            },
            Rule::RunAgent { agent } => self.run_agent(*agent, span),
            Rule::Par(rules) => program.rule_list(*rules).iter().try_for_each(|rule| self.perform(*rule)),
            Rule::Seq(rules) => self.sequence(&[], |this, log| {
                program.rule_list(*rules).iter().try_for_each(|rule| this.perform_part(*rule, log).map(drop))
            }),
            Rule::If { guards, rules } => self.perform_if(program.term_list(*guards), program.rule_list(*rules)),
            Rule::Switch { subject, values, rules } => {
                let subject = self.evaluate(*subject)?;
                self.perform_cases(&subject, program.term_list(*values), program.rule_list(*rules))
            }
            Rule::Let { slot, value, body } => {
                let value = self.evaluate(*value)?;
                self.bind(*slot, value);
                self.perform(*body)
            }
            Rule::Choose { binders, condition, body, if_none } => {
                self.perform_choose(program.binder_list(*binders), *condition, (*body, *if_none))
            }
            Rule::Forall { binders, condition, body } => {
                let binders = program.binder_list(*binders);
                for (present, values) in self.bindings(binders)? {
                    self.bind_all(binders, &values);
                    self.under(present, |this| {
                        let holds = condition.map_or(Ok(Terms::TRUE), |condition| this.holds(condition))?;
                        this.under(holds, |this| this.perform(*body)).map(drop)
                    })?;
                }
                Ok(())
            }
            Rule::Extend { .. } => self.outside("`extend`", span),
            Rule::Iterate(body) => self.repeat(None, *body, true, span),
            Rule::While { condition, body } => self.repeat(Some(*condition), *body, true, span),
            Rule::RecursiveWhile { condition, body } => self.repeat(Some(*condition), *body, false, span),
            Rule::Local { start, len, initialisations, body } => {
                let locals = &program.function_lists[*start as usize..(*start + *len) as usize];
                self.perform_local(locals, program.rule_list(*initialisations), *body)
            }
        }
    }

    fn perform_if(&mut self, guards: &[TermId], rules: &[RuleId]) -> Result<()> {
        let Some((guard, guards)) = guards.split_first() else {
            return rules.first().map_or(Ok(()), |rule| self.perform(*rule));
        };
        let holds = self.holds(*guard)?;
        self.under(holds, |this| this.perform(rules[0]))?;
        let not = self.terms.not(holds);
        self.under(not, |this| this.perform_if(guards, &rules[1..])).map(drop)
    }

    fn perform_cases(&mut self, subject: &Symbol, values: &[TermId], rules: &[RuleId]) -> Result<()> {
        let Some((value, values)) = values.split_first() else {
            return rules.first().map_or(Ok(()), |rule| self.perform(*rule));
        };
        let value = self.evaluate(*value)?;
        let holds = self.equal(&value, subject)?;
        self.under(holds, |this| this.perform(rules[0]))?;
        let not = self.terms.not(holds);
        self.under(not, |this| this.perform_cases(subject, values, &rules[1..])).map(drop)
    }

    fn call(&mut self, procedure: ProcedureId, arguments: TermList, span: Span) -> Result<()> {
        let arguments = self.evaluate_all(arguments)?;
        self.enter(procedure, arguments, span)
    }

    fn enter(&mut self, procedure: ProcedureId, arguments: Vec<Symbol>, span: Span) -> Result<()> {
        let program = Arc::clone(&self.program);
        let procedure = program.procedure(procedure);
        self.in_frame(arguments, procedure.frame, span, |this| this.perform(procedure.body))
    }

    /// A call whose updates are a unit, which joins the current one; returns what it writes to `result`.
    fn turbo(&mut self, procedure: ProcedureId, arguments: TermList, span: Span) -> Result<Option<(Node, Symbol)>> {
        self.units.push(Unit::new());
        let outcome = self.call(procedure, arguments, span);
        let mut unit = self.units.pop().unwrap_or_default();
        outcome?;
        let mut result = None;
        if let Some(function) = self.program.result_function {
            let of_result = unit.keys().copied().find(|place| self.places[*place].location.function == function);
            result = of_result.and_then(|place| unit.remove(&place));
        }
        self.join(unit)?;
        Ok(result)
    }

    fn join(&mut self, unit: Unit) -> Result<()> {
        unit.into_iter().try_for_each(|(place, (guard, value))| self.push(place, guard, &value))
    }

    fn perform_return(
        &mut self,
        (function, target): (FunctionId, TermList),
        procedure: ProcedureId,
        arguments: TermList,
        span: Span,
    ) -> Result<()> {
        let Some((guard, value)) = self.turbo(procedure, arguments, span)? else { return Ok(()) };
        if self.program.function(function).kind == FunctionKind::Monitored {
            return Ok(());
        }
        self.under(guard, |this| {
            let target = this.evaluate_all(target)?;
            this.update(function, &target, &value, span)
        })
        .map(drop)
    }

    /// Executes the program of an agent; `self` is the agent in it.
    fn run_agent(&mut self, agent: TermId, span: Span) -> Result<()> {
        let agent = match self.evaluate(agent)? {
            Symbol::Known(agent) => agent,
            _ => return self.outside("an agent that is not known", span),
        };
        let Some(procedure) = self.agent_program(&agent) else {
            self.fault(FaultClass::Undefined, Terms::TRUE);
            return Ok(());
        };
        let former = std::mem::replace(&mut self.agent, Symbol::Known(agent));
        let outcome = self.enter(procedure, Vec::new(), span);
        self.agent = former;
        outcome
    }

    /// The program of an agent: that of its most specific domain, which comes first.
    pub(super) fn agent_program(&mut self, agent: &Value) -> Option<ProcedureId> {
        let program = Arc::clone(&self.program);
        let fitting = |entry: &&program::AgentProgram| !agent.is_undef() && self.machine.contains(entry.domain, agent);
        program.agents.iter().find(fitting).map(|entry| entry.procedure)
    }

    /// Executes parts in sequence; their net effect, except on some functions, joins the current unit.
    fn sequence(
        &mut self,
        without: &[FunctionId],
        parts: impl FnOnce(&mut Self, &mut (Unit, Log)) -> Result<()>,
    ) -> Result<()> {
        let mut effect = (Unit::new(), Log::new());
        let outcome = parts(self, &mut effect);
        let (mut unit, log) = effect;
        for (place, value) in log.into_iter().rev() {
            self.values[place] = value;
        }
        outcome?;
        unit.retain(|place, _| !without.contains(&self.places[*place].location.function));
        self.join(unit)
    }

    /// Executes one part of a sequence; returns the condition that it has any update.
    fn perform_part(&mut self, rule: RuleId, (net, log): &mut (Unit, Log)) -> Result<Node> {
        self.units.push(Unit::new());
        let outcome = self.perform(rule);
        let unit = self.units.pop().unwrap_or_default();
        outcome?;
        let any = self.terms.or(unit.values().map(|(guard, _)| *guard));
        for (place, (guard, value)) in unit {
            log.push((place, self.values[place].clone()));
            let old = self.values[place].clone();
            self.values[place] = self.merge(guard, &value, &old)?;
            let entry = match net.remove(&place) {
                None => (guard, value),
                Some((before, former)) => (self.terms.or([before, guard]), self.merge(guard, &value, &former)?),
            };
            net.insert(place, entry);
        }
        Ok(any)
    }

    /// A loop: repeats while a condition holds and, with `fixpoint`, while there are updates.
    fn repeat(&mut self, condition: Option<TermId>, body: RuleId, fixpoint: bool, span: Span) -> Result<()> {
        self.sequence(&[], |this, effect| {
            let path = this.path;
            let mut outcome = Ok(());
            for round in 0.. {
                let holds = condition.map_or(Ok(Terms::TRUE), |condition| this.holds(condition));
                let Ok(holds) = holds else {
                    outcome = holds.map(drop);
                    break;
                };
                this.path = this.terms.and([this.path, holds, this.live]);
                if this.path == Terms::FALSE {
                    break;
                }
                if round == ROUNDS {
                    this.beyond(Terms::TRUE, "a loop of many rounds", span);
                    break;
                }
                match this.perform_part(body, effect) {
                    Ok(any) if fixpoint => this.path = this.terms.and([this.path, any]),
                    Ok(_) => {}
                    Err(outside) => {
                        outcome = Err(outside);
                        break;
                    }
                }
            }
            this.path = path;
            outcome
        })
    }

    fn perform_local(&mut self, locals: &[FunctionId], initialisations: &[RuleId], body: RuleId) -> Result<()> {
        let mut outer = Vec::new();
        for function in locals {
            self.know(*function)?;
            for place in 0..self.places.len() {
                if self.places[place].location.function == *function {
                    outer.push((place, std::mem::replace(&mut self.values[place], Symbol::UNDEF)));
                }
            }
        }
        let outcome = self.sequence(locals, |this, effect| {
            for rule in initialisations.iter().chain([&body]) {
                this.perform_part(*rule, effect)?;
            }
            Ok(())
        });
        for (place, value) in outer {
            self.values[place] = value;
        }
        outcome
    }

    fn perform_choose(
        &mut self,
        binders: &[Binder],
        condition: Option<TermId>,
        (body, if_none): (RuleId, Option<RuleId>),
    ) -> Result<()> {
        let draws = self.draws(binders, condition)?;
        let listed: Vec<Binder> = binders.iter().filter(|binder| self.numbers(binder).is_none()).copied().collect();
        let mut candidates = Vec::new();
        for (present, values) in self.bindings(&listed)? {
            self.bind_all(&listed, &values);
            let holds =
                self.under(present, |this| condition.map_or(Ok(Terms::TRUE), |condition| this.holds(condition)))?;
            let here = self.terms.and([present, holds.unwrap_or(Terms::FALSE)]);
            if here != Terms::FALSE {
                candidates
                    .push((here, binders.iter().map(|binder| self.frame[binder.slot.0 as usize].clone()).collect()));
            }
        }
        let any = self.terms.or(candidates.iter().map(|(here, _): &(Node, Vec<Symbol>)| *here));
        if !candidates.is_empty() {
            let taken = self.pick(&candidates);
            let made = self.terms.and([self.path, any]);
            let rows: Vec<(Node, Vec<Symbol>)> =
                taken.into_iter().zip(candidates.into_iter().map(|(_, values)| values)).collect();
            self.choices.push(Choice { made, candidates: rows.clone(), draws });
            for (taken, values) in rows {
                self.bind_all(binders, &values);
                self.under(taken, |this| this.perform(body))?;
            }
        }
        let none = self.terms.not(any);
        self.under(none, |this| if_none.map_or(Ok(()), |rule| this.perform(rule))).map(drop)
    }

    /// The kind of numbers that a binder ranges over, if it ranges over all numbers of a kind.
    fn numbers(&self, binder: &Binder) -> Option<Basic> {
        let Term::Domain(domain) = self.program.term(binder.range) else { return None };
        match self.program.domain(*domain).kind {
            DomainKind::Basic(basic @ (Basic::Integer | Basic::Natural | Basic::Real)) => Some(basic),
            _ => None,
        }
    }

    /// Binds variables over all numbers to arbitrary numbers.
    fn draws(&mut self, binders: &[Binder], condition: Option<TermId>) -> Result<Vec<Symbol>> {
        let mut draws = Vec::new();
        for binder in binders {
            let Some(basic) = self.numbers(binder) else { continue };
            let unguarded = match condition {
                None => true,
                Some(condition) => self.evaluate(condition)? == Symbol::Known(Value::Boolean(true)),
            };
            if !unguarded {
                let span = self.program.term_span(binder.range);
                return self.outside("a choice among all numbers with a guard", span);
            }
            let (shape, bounds) = match basic {
                Basic::Natural => (Shape::Integer, (Some(0), INTEGERS.1)),
                Basic::Real => (Shape::Real, (None, None)),
                _ => (Shape::Integer, INTEGERS),
            };
            let value = self.input("number", shape.kind(), bounds, InputKind::Number);
            let symbol = Symbol::Open(Open { shape, value, defined: Terms::TRUE });
            self.bind(binder.slot, symbol.clone());
            draws.push(symbol);
        }
        Ok(draws)
    }
}
