//! Rules → updates (Börger & Stärk 2003, table 2.2; section 4.1 for turbo rules).
//!
//! Running a rule adds its updates to the current unit of the update set. The units of [`crate::update`] make `par`
//! consistent and give `seq` its intermediate states.

use std::borrow::Cow;
use std::ops::ControlFlow;

use model::Basic;
use program::{
    Binder, BinderList, DomainId, DomainKind, FunctionId, FunctionKind, ProcedureId, Rule, RuleId, RuleList, Slot,
    Term, TermId, TermList,
};
use syntax::Span;

use crate::environment::{Choice, Draw};
use crate::execute::{Executor, Outcome};
use crate::fault::{ClashSide, FaultKind};
use crate::layout::LocationIndex;
use crate::location::Location;
use crate::observe::Observation;
use crate::piece::Edit;
use crate::print::Show;
use crate::store::Store;
use crate::update::Clash;
use crate::value::Value;

impl<'a> Executor<'a> {
    /// Runs a rule.
    pub fn perform(&mut self, id: RuleId) -> Outcome<()> {
        let program = self.program;
        self.core.ran(id);
        match program.rule(id) {
            Rule::Skip => Ok(()),
            Rule::Update { function, arguments, value } => {
                if self.core.in_pieces && self.perform_edit(id)? {
                    return Ok(());
                }
                let value = self.evaluate(*value)?;
                let start = self.gather(*arguments)?;
                self.update(*function, start, (value, None), id)
            }
            Rule::Call { procedure, arguments } => self.call(*procedure, *arguments, id),
            Rule::TurboCall { procedure, arguments } => {
                let unit = self.core.updates.open();
                self.call(*procedure, *arguments, id)?;
                let joined = self.core.updates.join(unit, None);
                self.consistent(joined).map(drop)
            }
            Rule::Return { function, target, procedure, arguments } => {
                self.perform_return((*function, *target), *procedure, *arguments, id)
            }
            Rule::RunValue { rule, arguments } => self.run_value(*rule, *arguments, id),
            Rule::RunAgent { agent } => self.run_agent(*agent, id),
            Rule::Par(rules) => {
                for rule in program.rule_list(*rules) {
                    self.perform(*rule)?;
                }
                Ok(())
            }
            Rule::Seq(rules) => self.sequence(id, |this| {
                for rule in program.rule_list(*rules) {
                    this.perform_part(*rule)?;
                }
                Ok(())
            }),
            Rule::If { guards, rules } => {
                let rules = program.rule_list(*rules);
                let guards = program.term_list(*guards);
                for (guard, rule) in guards.iter().zip(rules) {
                    if self.decide(*guard)? {
                        return self.take(id, Some(*rule));
                    }
                }
                self.take(id, rules.get(guards.len()).copied())
            }
            Rule::Switch { subject, values, rules } => {
                let subject = self.evaluate(*subject)?;
                let rules = program.rule_list(*rules);
                let values = program.term_list(*values);
                for (value, rule) in values.iter().zip(rules) {
                    if self.evaluate(*value)? == subject {
                        return self.take(id, Some(*rule));
                    }
                }
                self.take(id, rules.get(values.len()).copied())
            }
            Rule::Let { slot, value, body } => {
                let value = self.evaluate(*value)?;
                self.bind(*slot, value);
                self.perform(*body)
            }
            Rule::Choose { binders, condition, body, if_none } => {
                self.perform_choose(id, *binders, *condition, *body, *if_none)
            }
            Rule::Forall { binders, condition, body } => self.perform_forall(id, *binders, *condition, *body),
            Rule::Extend { domain, first, count, body } => {
                for offset in 0..*count {
                    let element = self.create(*domain, program.rule_span(id))?;
                    self.bind(Slot(first.0 + offset), element);
                }
                self.perform(*body)
            }
            Rule::Iterate(body) => self.sequence(id, |this| {
                while this.perform_part(*body)? {
                    this.count_iteration(program.rule_span(id))?;
                }
                Ok(())
            }),
            Rule::While { condition, body } => self.sequence(id, |this| {
                while this.decide(*condition)? && this.perform_part(*body)? {
                    this.count_iteration(program.rule_span(id))?;
                }
                Ok(())
            }),
            Rule::RecursiveWhile { condition, body } => self.sequence(id, |this| {
                while this.decide(*condition)? {
                    this.perform_part(*body)?;
                    this.count_iteration(program.rule_span(id))?;
                }
                Ok(())
            }),
            Rule::Local { start, len, initialisations, body } => {
                let locals = &program.function_lists[*start as usize..(*start + *len) as usize];
                self.perform_local(id, locals, *initialisations, *body)
            }
        }
    }

    /// Runs the branch of an if or switch that is taken, if any.
    fn take(&mut self, id: RuleId, branch: Option<RuleId>) -> Outcome<()> {
        self.core.went(id, usize::from(branch.is_some()));
        branch.map_or(Ok(()), |branch| self.perform(branch))
    }

    /// Adds the update `function(arguments) := value`; the arguments stand on the frame stack from `start` on, and the value may
    /// be that of the state but for an edit.
    pub fn update(
        &mut self,
        function: FunctionId,
        start: usize,
        (value, edit): (Value, Option<Edit>),
        id: RuleId,
    ) -> Outcome<()> {
        if self.core.observations.is_some() {
            // Whether the update is trivial depends on the present value.
            let found = self.core.store.find(function, &self.core.frames[start..]);
            self.note_look(function, found);
        }
        if self.core.initials[function.0 as usize].is_some() {
            let found = self.core.store.find(function, &self.core.frames[start..]);
            if self.core.exploring {
                self.note_write(function, found);
            }
            if found.is_none_or(|index| self.core.store.given[index as usize] == 0) {
                // A late initial value must be there before it is overwritten. An update does not need it, so a fault in it is
                // reported only to a rule that reads the location first.
                let arguments = self.core.frames[start..].to_vec();
                if let Err(fault) = self.read(function, &arguments, self.program.rule_span(id))
                    && (value.is_undef() || !fault.kind.is_of_the_model())
                {
                    return Err(fault);
                }
            }
        }
        if !self.is_member(function, &value) {
            let location = Location { function, arguments: self.core.frames.split_off(start) };
            let domain = self.program.function(function).codomain;
            return self.fault(self.program.rule_span(id), FaultKind::OutOfDomain { location, value, domain });
        }
        let core = &mut *self.core;
        let index = core.store.number(function, &core.frames[start..]);
        core.frames.truncate(start);
        if core.in_pieces
            && let Some(alternatives) = self.environment.alternatives()
        {
            alternatives.overwrite(function, index, edit);
        }
        if core.coverage.is_some() {
            core.went(id, usize::from(core.store.values[index as usize] != value));
        }
        if core.observations.is_some() {
            core.note_update(function, index, &value);
        }
        if core.updates.len() as u64 >= self.limits.updates || core.store.len() as u64 > self.limits.locations {
            return self.limit_of_updates(id);
        }
        match core.updates.push(index, value, id) {
            Ok(()) => Ok(()),
            Err(clash) => self.clashed(*clash),
        }
    }

    /// A clash of two updates ends the step, unless somebody watches for others. What runs in parallel does not see it; what
    /// comes in sequence after it would.
    #[cold]
    fn clashed(&mut self, clash: Clash) -> Outcome<()> {
        let fault = self.inconsistent::<()>(clash);
        let outermost = self.core.updates.is_outermost();
        match (&mut self.core.observations, fault) {
            (Some(observations), Err(fault)) if observations.is_on() && outermost => {
                observations.clash.get_or_insert(fault);
                Ok(())
            }
            (_, fault) => fault,
        }
    }

    #[cold]
    fn limit_of_updates(&self, id: RuleId) -> Outcome<()> {
        let (limit, value) = if self.core.updates.len() as u64 >= self.limits.updates {
            ("updates in one step", self.limits.updates)
        } else {
            ("locations", self.limits.locations)
        };
        self.fault(self.program.rule_span(id), FaultKind::Limit { limit, value })
    }

    /// Turns a clash into a fault that names both rules.
    #[inline]
    fn consistent<T>(&mut self, outcome: Result<T, Box<Clash>>) -> Outcome<T> {
        match outcome {
            Ok(value) => Ok(value),
            Err(clash) => self.inconsistent(*clash),
        }
    }

    #[cold]
    fn inconsistent<T>(&mut self, clash: Clash) -> Outcome<T> {
        self.core.note(Observation::Clashed(clash.first.1, clash.second.1));
        let side = |(value, rule): (Value, RuleId)| ClashSide { value, span: self.program.rule_span(rule) };
        let location = self.core.store.location(clash.location);
        let span = self.program.rule_span(clash.second.1);
        let (first, second) = (side(clash.first), side(clash.second));
        self.fault(span, FaultKind::InconsistentUpdate { location, first, second })
    }

    fn call(&mut self, procedure: ProcedureId, arguments: TermList, id: RuleId) -> Outcome<()> {
        let start = self.gather(arguments)?;
        self.enter(procedure, start, self.program.rule_span(id))
    }

    /// Runs a procedure on the arguments that stand on the frame stack from `start` on.
    pub fn enter(&mut self, procedure: ProcedureId, start: usize, span: Span) -> Outcome<()> {
        let procedure = self.program.procedure(procedure);
        self.in_frame(start, procedure.frame, span, |this| this.perform(procedure.body))
    }

    /// `target <- procedure(arguments)`: what the body writes to `result` becomes an update of the target.
    fn perform_return(
        &mut self,
        (function, target): (FunctionId, TermList),
        procedure: ProcedureId,
        arguments: TermList,
        id: RuleId,
    ) -> Outcome<()> {
        let result = self.program.result_function.map(|function| self.core.store.number(function, &[]));
        let unit = self.core.updates.open();
        self.call(procedure, arguments, id)?;
        let joined = self.core.updates.join(unit, result);
        // The target replaces `result`: if nothing writes to that, the target stays as it is.
        match self.consistent(joined)? {
            // The environment alone decides the value of a monitored location, so this one is lost.
            Some(_) if self.program.function(function).kind == FunctionKind::Monitored => Ok(()),
            Some(value) => {
                let start = self.gather(target)?;
                self.update(function, start, (value, None), id)
            }
            None => Ok(()),
        }
    }

    fn run_value(&mut self, rule: TermId, arguments: TermList, id: RuleId) -> Outcome<()> {
        let span = self.program.rule_span(id);
        let procedure = match self.evaluate(rule)? {
            Value::Rule(procedure) => procedure,
            value => return self.fault(span, FaultKind::NotARule { value }),
        };
        let declared = self.program.procedure(procedure);
        let (given, expected) = (arguments.len as usize, declared.parameters.len());
        if given != expected {
            return self.fault(span, FaultKind::WrongArguments { given, expected });
        }
        if !declared.turbo {
            return self.call(procedure, arguments, id);
        }
        let unit = self.core.updates.open();
        self.call(procedure, arguments, id)?;
        let joined = self.core.updates.join(unit, None);
        self.consistent(joined).map(drop)
    }

    /// Runs the program of an agent; `self` is the agent within it, and what it was before after it.
    fn run_agent(&mut self, agent: TermId, id: RuleId) -> Outcome<()> {
        let span = self.program.rule_span(id);
        let agent = self.evaluate(agent)?;
        let Some(procedure) = self.agent_program(&agent) else {
            return self.fault(span, FaultKind::NotARule { value: agent });
        };
        let Some(function) = self.program.self_function else {
            return self.enter(procedure, self.core.frames.len(), span);
        };
        let index = self.core.store.number(function, &[]) as usize;
        let former = std::mem::replace(&mut self.core.store.values[index], agent);
        let outcome = self.enter(procedure, self.core.frames.len(), span);
        self.core.store.values[index] = former;
        outcome
    }

    /// The program of an agent: that of the most specific domain it is in, which comes first.
    pub fn agent_program(&mut self, agent: &Value) -> Option<ProcedureId> {
        let program = self.program;
        let fitting = |entry: &&program::AgentProgram| !agent.is_undef() && self.contains(entry.domain, agent);
        program.agents.iter().find(fitting).map(|entry| entry.procedure)
    }

    /// Runs `parts` as a sequence and joins its net effect to the current unit.
    fn sequence(&mut self, id: RuleId, parts: impl FnOnce(&mut Self) -> Outcome<()>) -> Outcome<()> {
        self.sequence_without(id, &[], parts)
    }

    fn sequence_without(
        &mut self,
        _id: RuleId,
        locals: &[FunctionId],
        parts: impl FnOnce(&mut Self) -> Outcome<()>,
    ) -> Outcome<()> {
        let version = self.core.memo.version();
        let sequence = self.core.updates.begin_sequence();
        parts(self)?;
        let core = &mut *self.core;
        core.memo.back_to(version);
        let is_local =
            |store: &Store, index: LocationIndex| !locals.is_empty() && locals.contains(&store.function_of(index));
        let ended = core.updates.end_sequence(sequence, &mut core.store, &is_local);
        self.consistent(ended)
    }

    /// Runs one part of a sequence, whose updates make the next intermediate state; returns whether there were any.
    fn perform_part(&mut self, rule: RuleId) -> Outcome<bool> {
        let unit = self.core.updates.open();
        self.perform(rule)?;
        let any = !self.core.updates.is_empty(unit);
        self.core.updates.apply(unit, &mut self.core.store);
        if any {
            self.core.memo.changed();
        }
        Ok(any)
    }

    /// Runs a body with local functions that start undefined and leave no trace.
    fn perform_local(
        &mut self,
        id: RuleId,
        locals: &[FunctionId],
        initialisations: RuleList,
        body: RuleId,
    ) -> Outcome<()> {
        debug_assert!(locals.iter().all(|f| self.program.function(*f).kind == FunctionKind::Local));
        let mut outer = Vec::new();
        let version = self.core.memo.version();
        self.core.memo.changed();
        for function in locals {
            for index in self.core.store.indices_of(*function) {
                let value = std::mem::take(&mut self.core.store.values[index as usize]);
                if !value.is_undef() {
                    outer.push((index, value));
                }
            }
        }
        let program = self.program;
        let outcome = self.sequence_without(id, locals, |this| {
            for rule in program.rule_list(initialisations) {
                this.perform_part(*rule)?;
            }
            this.perform_part(body).map(drop)
        });
        for (index, value) in outer {
            self.core.store.values[index as usize] = value;
        }
        self.core.memo.back_to(version);
        outcome
    }

    fn perform_forall(
        &mut self,
        id: RuleId,
        binders: BinderList,
        condition: Option<TermId>,
        body: RuleId,
    ) -> Outcome<()> {
        let program = self.program;
        let mut count = 0usize;
        let _ = self.for_each_binding(program.binder_list(binders), &mut |this| {
            let taken = match condition {
                Some(condition) => this.decide(condition)?,
                None => true,
            };
            if taken {
                count += 1;
                this.perform(body)?;
            }
            Ok(ControlFlow::Continue(()))
        })?;
        self.core.went(id, count.min(2));
        Ok(())
    }

    fn perform_choose(
        &mut self,
        id: RuleId,
        binders: BinderList,
        condition: Option<TermId>,
        body: RuleId,
        if_none: Option<RuleId>,
    ) -> Outcome<()> {
        let program = self.program;
        let binders = program.binder_list(binders);
        if self.core.exploring && self.asks_first(id, binders, condition) {
            return self.perform_alternative(id, binders, condition, body, if_none);
        }
        let span = program.rule_span(id);
        let start = self.core.frames.len();
        let listed = self.draw_numbers(binders, condition, span)?;
        let gathered = self.for_each_binding(&listed, &mut |this| {
            let fits = match condition {
                Some(condition) => this.holds(condition)?,
                None => true,
            };
            if fits {
                for binder in binders {
                    let value = this.slot(binder.slot).clone();
                    this.core.frames.push(value);
                }
                this.check_size((this.core.frames.len() - start) as u64, span)?;
            }
            Ok(ControlFlow::Continue(()))
        });
        if let Err(fault) = gathered {
            return if self.core.exploring { self.endless_choice(fault, span) } else { Err(fault) };
        }
        let candidates = (self.core.frames.len() - start) / binders.len().max(1);
        self.core.went(id, candidates.min(2));
        if candidates == 0 {
            if let Err(reason) = self.environment.no_candidate(program, span) {
                return self.fault(span, FaultKind::Environment { reason });
            }
            return if_none.map_or(Ok(()), |rule| self.perform(rule));
        }
        let Executor { core, environment, .. } = self;
        let choice = Choice { span, values: &core.frames[start..], variables: binders.len() };
        let chosen = match core.choices.choose(*environment, program, &choice) {
            Ok(chosen) if chosen < candidates => chosen,
            Ok(chosen) => {
                let reason = format!("choice {chosen} of {candidates} candidates does not exist");
                return self.fault(span, FaultKind::Environment { reason });
            }
            Err(reason) => return self.fault(span, FaultKind::Environment { reason }),
        };
        for (offset, binder) in binders.iter().enumerate() {
            let value = std::mem::take(&mut self.core.frames[start + chosen * binders.len() + offset]);
            self.bind(binder.slot, value);
        }
        self.core.frames.truncate(start);
        self.perform(body)
    }

    /// Binds the variables that range over all numbers of a kind, where there is no guard that the numbers would have
    /// to be searched for; gives the other binders.
    fn draw_numbers(
        &mut self,
        binders: &'a [Binder],
        condition: Option<TermId>,
        span: Span,
    ) -> Outcome<Cow<'a, [Binder]>> {
        let program = self.program;
        let numbers = |binder: &Binder| match program.term(binder.range) {
            Term::Domain(domain) => match &program.domain(*domain).kind {
                DomainKind::Basic(basic @ (Basic::Integer | Basic::Natural | Basic::Real)) => Some(*basic),
                _ => None,
            },
            _ => None,
        };
        let guarded = condition.is_some_and(|condition| match program.term(condition) {
            Term::Constant(index) => self.core.constants[*index as usize] != Value::Boolean(true),
            _ => true,
        });
        let mut draws = Vec::new();
        for (variable, binder) in binders.iter().enumerate() {
            draws.extend(numbers(binder).map(|basic| (Draw { span, variable, basic }, binder.slot)));
        }
        if draws.is_empty() || (guarded && !draws.iter().all(|(draw, _)| self.environment.picks(draw))) {
            return Ok(Cow::Borrowed(binders));
        }
        for (draw, slot) in draws {
            match self.core.choices.number(self.environment, program, &draw) {
                Ok(value) if draw.admits(&value) => self.bind(slot, value),
                Ok(value) => {
                    let reason = format!("{} is no {:?}", value.show(program), draw.basic);
                    return self.fault(span, FaultKind::Environment { reason });
                }
                Err(reason) => return self.fault(span, FaultKind::Environment { reason }),
            }
        }
        Ok(Cow::Owned(binders.iter().filter(|binder| numbers(binder).is_none()).copied().collect()))
    }

    /// Makes a fresh element of a dynamic domain.
    pub fn create(&mut self, domain: DomainId, span: Span) -> Outcome<Value> {
        let base = self.program.base_domain(domain);
        let carrier = &mut self.core.store.carriers[base.0 as usize];
        if u64::from(carrier.fresh) >= self.limits.locations.min(u64::from(u32::MAX - 1)) {
            return self
                .fault(span, FaultKind::Limit { limit: "elements of one domain", value: self.limits.locations });
        }
        let element = Value::Element(base, carrier.fresh);
        carrier.fresh += 1;
        self.core.updates.create(base, element.clone());
        if domain != base {
            self.core.updates.create(domain, element.clone());
        }
        self.core.iterations += 1;
        if self.core.iterations > self.limits.iterations.saturating_mul(10) {
            return self
                .fault(span, FaultKind::Limit { limit: "iterations in one step", value: self.limits.iterations });
        }
        Ok(element)
    }
}
