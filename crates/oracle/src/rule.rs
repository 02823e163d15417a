//! yields(R, 𝔄, ζ, U): the update set a rule yields in a state under an assignment (Börger & Stärk 2003, table 2.2 for
//! basic ASMs, section 4.1 for turbo ASMs), one case for each kind of rule.
//!
//! The calculus is written as a function: it returns U, or stops where no rule of the calculus applies because a term
//! has no value. Whether U is consistent is checked where U is fired: at the end of the step and of each substep.

use std::ops::ControlFlow;

use model::{
    Basic, Binder, Call, DomainId, DomainKind, FunctionKind, Literal, RuleKind, RuleNode, Target, Term, TermKind,
    VariableId,
};

use crate::fault::{Fault, Stop, consistent, join};
use crate::interpreter::{Assignment, Interpreter};
use crate::state::{Location, State, UpdateSet};
use crate::substitution::Substitution;
use crate::value::Value;

/// The outcome of `yields`.
pub type Yield = Result<UpdateSet, Stop>;

impl Interpreter<'_> {
    /// yields(R, 𝔄, ζ, U).
    pub fn yields(&mut self, rule: &RuleNode, state: &State, zeta: &Assignment) -> Yield {
        match &rule.kind {
            // yields(skip, 𝔄, ζ, ∅)
            RuleKind::Skip => Ok(UpdateSet::empty()),
            // yields(f(s₁,…,sₙ) := t, 𝔄, ζ, {(l, v)}) where l = (f, (⟦s₁⟧,…,⟦sₙ⟧)) and v = ⟦t⟧
            RuleKind::Update { target, value } => {
                let value = self.value(value, state, zeta)?;
                let location = self.location(target, state, zeta)?;
                self.update(location, value, state)
            }
            // yields(P, 𝔄, ζ, U), yields(Q, 𝔄, ζ, V) ⊢ yields(P par Q, 𝔄, ζ, U ∪ V)
            RuleKind::Par(rules) => {
                let mut updates = UpdateSet::empty();
                for rule in rules {
                    updates = join(updates, self.yields(rule, state, zeta))?;
                }
                Ok(updates)
            }
            // yields(P, 𝔄, ζ, U), U consistent, yields(Q, 𝔄 + U, ζ, V) ⊢ yields(P seq Q, 𝔄, ζ, U ⊕ V)
            RuleKind::Seq(rules) => {
                let mut updates = UpdateSet::empty();
                for rule in rules {
                    updates = self.then(updates, rule, state, zeta)?;
                }
                Ok(updates)
            }
            // if ⟦φ⟧ = true then that of P, if ⟦φ⟧ = false then that of Q
            RuleKind::If { branches, otherwise } => {
                for (guard, rule) in branches {
                    if self.guard(guard, state, zeta)? {
                        return self.yields(rule, state, zeta);
                    }
                }
                self.yields_or_skip(otherwise.as_deref(), state, zeta)
            }
            RuleKind::Switch { subject, cases, otherwise } => {
                let subject = self.value(subject, state, zeta)?;
                for (case, rule) in cases {
                    if self.value(case, state, zeta)? == subject {
                        return self.yields(rule, state, zeta);
                    }
                }
                self.yields_or_skip(otherwise.as_deref(), state, zeta)
            }
            // yields(P, 𝔄, ζ[x ↦ a], U), a = ⟦t⟧ ⊢ yields(let x = t in P, 𝔄, ζ, U)
            RuleKind::Let { bindings, body } => {
                let mut zeta = zeta.clone();
                for (variable, term) in bindings {
                    let value = self.value(term, state, &zeta)?;
                    zeta = zeta.with(*variable, value);
                }
                self.yields(body, state, &zeta)
            }
            // yields(P, 𝔄, ζ[x ↦ a], U) for some a ∈ range(x, φ, 𝔄, ζ); if it is empty, yields what ifnone yields, else ∅
            RuleKind::Choose { binders, condition, body, if_none } => {
                let (zeta, listed) = &self.numbers_drawn(binders, condition.as_ref(), zeta)?;
                let found = self.satisfying(listed, condition.as_ref(), state, zeta)?;
                if found.is_empty() {
                    return self.yields_or_skip(if_none.as_deref(), state, zeta);
                }
                let tuple = |zeta: &Assignment| binders.iter().map(|binder| zeta.get(binder.variable)).collect();
                let chosen = self.choose(found.iter().map(tuple).collect())?;
                self.yields(body, state, &bind(zeta, binders, chosen))
            }
            // yields(P, 𝔄, ζ[x ↦ a], Uₐ) for each a ∈ I = range(x, φ, 𝔄, ζ) ⊢ the union of all Uₐ
            RuleKind::Forall { binders, condition, body } => {
                self.forall(binders, condition.as_ref(), body, state, zeta)
            }
            // import x do (Domain(D)(x) := true par P): section 2.4.4, "reserve"
            RuleKind::Extend { domain, variables, body } => self.extend(*domain, variables, body, state, zeta),
            // r(x₁,…,xₙ) = P; yields(P[t₁/x₁,…,tₙ/xₙ], 𝔄, ζ, U) ⊢ yields(r(t₁,…,tₙ), 𝔄, ζ, U): by name
            RuleKind::MacroCall(call) => {
                let instance = self.instance(call);
                self.call(|this| this.yields(&instance, state, zeta))
            }
            RuleKind::TurboCall(call) => {
                let values = self.values(&call.arguments, state, zeta)?;
                let inner = zeta.parameters(&self.model.rule(call.rule).parameters, values);
                Ok(self.turbo(call.rule, state, &inner.returning(zeta.result.clone()))?)
            }
            RuleKind::Return { target, call } => self.returned(target, call, state, zeta),
            RuleKind::RunValue { rule, arguments } => {
                let rule = self.value(rule, state, zeta)?;
                self.run_value(rule, arguments, state, zeta)
            }
            // The program of a with `self` denoting a, and nowhere else (definition 6.1.1).
            RuleKind::RunAgent { agent } => {
                let agent = self.value(agent, state, zeta)?;
                let program = match self.program_of(&agent, state)? {
                    Some(program) => &self.model.rule(program).body,
                    None => return Err(Fault::NotARule(agent).into()),
                };
                let inner = Assignment::of_agent(agent);
                self.call(|this| this.yields(program, state, &inner))
            }
            // iterate R = limit of Rⁿ, reached when R yields the empty set (section 4.1.1)
            RuleKind::Iterate(body) => self.iterate(None, body, state, zeta),
            // while (φ) R = iterate (if φ then R)
            RuleKind::While { condition, body } => self.iterate(Some(condition), body, state, zeta),
            // whilerec (φ) R = if φ then (R seq whilerec (φ) R)
            RuleKind::RecursiveWhile { condition, body } => self.recursive_while(condition, body, state, zeta),
            RuleKind::Local { locals, body } => {
                let functions: Vec<_> = locals.iter().map(|(function, _)| *function).collect();
                let inner = functions.iter().fold(state.clone(), |state, function| state.without(*function));
                let mut updates = UpdateSet::empty();
                for rule in locals.iter().map(|(_, rule)| rule).chain([body.as_ref()]) {
                    updates = self.then(updates, rule, &inner, zeta)?;
                }
                // U \ Updates(f): local updates are not seen outside (section 4.1.2).
                Ok(functions.into_iter().fold(updates, UpdateSet::without))
            }
            RuleKind::Error => panic!("the oracle runs models without faults only"),
        }
    }

    fn yields_or_skip(&mut self, rule: Option<&RuleNode>, state: &State, zeta: &Assignment) -> Yield {
        rule.map_or(Ok(UpdateSet::empty()), |rule| self.yields(rule, state, zeta))
    }

    /// U ⊕ V, where V is what the rule yields in 𝔄 + U.
    fn then(
        &mut self,
        updates: UpdateSet,
        rule: &RuleNode,
        state: &State,
        zeta: &Assignment,
    ) -> Result<UpdateSet, Fault> {
        let later = consistent(self.yields(rule, &state.fire(&updates), zeta))?;
        Ok(updates.then(later))
    }

    /// The location that a target denotes.
    fn location(&mut self, target: &Target, state: &State, zeta: &Assignment) -> Result<Location, Fault> {
        match target {
            Target::Location { function, .. } if self.is_result(*function) && zeta.result.is_some() => {
                Ok(zeta.result.clone().expect("there is one"))
            }
            Target::Location { function, arguments, .. } => {
                Ok(Location::function(*function, self.values(arguments, state, zeta)?))
            }
            Target::Parameter(..) => {
                Err(Fault::BadOperand("the rule has a location parameter and is called by value".into()))
            }
        }
    }

    /// The update of a location to a value, which must be in the codomain.
    fn update(&mut self, location: Location, value: Value, state: &State) -> Yield {
        // In a domain of tuples or collections, the parts of a value are not checked.
        if let crate::state::Symbol::Function(function) = location.symbol
            && let codomain = self.model.function(function).codomain
            && matches!(self.model.domains.kind(codomain), DomainKind::Basic(_) | DomainKind::Concrete { .. })
            && !self.contains(codomain, &value, state)?
        {
            return Err(Fault::OutOfDomain { location, value }.into());
        }
        Ok(UpdateSet::one(location, value))
    }

    /// A number is drawn for each variable that ranges over all numbers of a kind, if no guard must be searched for;
    /// gives the other binders.
    fn numbers_drawn(
        &mut self,
        binders: &[Binder],
        condition: Option<&Term>,
        zeta: &Assignment,
    ) -> Result<(Assignment, Vec<Binder>), Fault> {
        let free = condition.is_none_or(|guard| matches!(guard.kind, TermKind::Literal(Literal::Boolean(true))));
        let (mut zeta, mut listed) = (zeta.clone(), Vec::new());
        for (place, binder) in binders.iter().enumerate() {
            let kind = match &binder.range.kind {
                TermKind::Domain(domain) => match self.model.domains.kind(*domain) {
                    DomainKind::Basic(basic @ (Basic::Integer | Basic::Natural | Basic::Real)) => Some(*basic),
                    _ => None,
                },
                _ => None,
            };
            match kind.filter(|_| free) {
                Some(basic) => {
                    let value = self.environment.number(self.model, place, basic).map_err(Fault::Environment)?;
                    zeta = zeta.with(binder.variable, value);
                }
                None => listed.push(binder.clone()),
            }
        }
        Ok((zeta, listed))
    }

    fn forall(
        &mut self,
        binders: &[Binder],
        condition: Option<&Term>,
        body: &RuleNode,
        state: &State,
        zeta: &Assignment,
    ) -> Yield {
        let mut updates = UpdateSet::empty();
        let mut stop = None;
        let walked = self.each(binders, state, zeta, &mut |this, zeta| {
            if !condition.map_or(Ok(true), |condition| this.guard(condition, state, zeta))? {
                return Ok(ControlFlow::Continue(()));
            }
            match join(std::mem::take(&mut updates), this.yields(body, state, zeta)) {
                Ok(joined) => updates = joined,
                Err(stopped) => {
                    stop = Some(stopped);
                    return Ok(ControlFlow::Break(()));
                }
            }
            Ok(ControlFlow::Continue(()))
        });
        match (walked, stop) {
            (Err(fault), _) => Err(Stop { fault, before: updates }),
            (_, Some(stop)) => Err(stop),
            _ => Ok(updates),
        }
    }

    fn extend(
        &mut self,
        domain: DomainId,
        variables: &[VariableId],
        body: &RuleNode,
        state: &State,
        zeta: &Assignment,
    ) -> Yield {
        let base = self.model.domains.type_domain(domain);
        let mut updates = UpdateSet::empty();
        let mut zeta = zeta.clone();
        for variable in variables {
            let element = self.import(base);
            zeta = zeta.with(*variable, element.clone());
            for domain in [base, domain] {
                self.imported.push((domain, element.clone()));
                let member = Location::member(domain, element.clone());
                updates = updates.union(UpdateSet::one(member, Value::Boolean(true)));
            }
        }
        join(updates, self.yields(body, state, &zeta))
    }

    /// An element of the reserve that no other rule of this step imports.
    fn import(&mut self, base: DomainId) -> Value {
        debug_assert!(matches!(self.model.domains.kind(base), DomainKind::Abstract { .. }));
        let in_use = self.before.members(base).count() as u32;
        let next = self.reserve.entry(base).or_insert(in_use);
        *next += 1;
        Value::Element(base, *next - 1)
    }

    /// The body of a macro rule with the arguments in the place of the parameters.
    fn instance(&mut self, call: &Call) -> RuleNode {
        let rule = self.model.rule(call.rule);
        let substitution = Substitution::new(&rule.parameters, &call.arguments, self.fresh_variable);
        self.fresh_variable += rule.variables.len() as u32;
        substitution.rule(&rule.body)
    }

    /// The update set of a turbo rule whose parameters are bound, which is fired as one.
    fn turbo(&mut self, rule: model::RuleId, state: &State, inner: &Assignment) -> Result<UpdateSet, Fault> {
        let body = &self.model.rule(rule).body;
        self.call(|this| consistent(this.yields(body, state, inner)))
    }

    fn is_result(&self, function: model::FunctionId) -> bool {
        let function = self.model.function(function);
        function.library && function.name == "result"
    }

    /// l ← r(t₁,…,tₙ): what r yields with l in the place of `result` (section 4.1.2). A rule that runs through a rule
    /// value, or as an agent's program, writes `result` itself, and l is written at the end.
    fn returned(&mut self, target: &Target, call: &Call, state: &State, zeta: &Assignment) -> Yield {
        let values = self.values(&call.arguments, state, zeta)?;
        let kind = match target {
            Target::Location { function, .. } => self.model.function(*function).kind,
            Target::Parameter(..) => FunctionKind::Controlled,
        };
        // A monitored l is the environment's to write. The called rule knows no local function but its own, even if that is the
        // same one.
        let stands = match kind {
            FunctionKind::Monitored | FunctionKind::Local => None,
            _ => Some(self.location(target, state, zeta)?),
        };
        let inner = zeta.parameters(&self.model.rule(call.rule).parameters, values).returning(stands.clone());
        let updates = self.turbo(call.rule, state, &inner)?;
        let result = self.model.functions().find(|(_, function)| function.library && function.name == "result");
        let Some((result, _)) = result else { return Ok(updates) };
        let Some(value) = updates.value(&Location::function(result, Vec::new())).cloned() else { return Ok(updates) };
        let updates = updates.without(result);
        if kind == FunctionKind::Monitored {
            return Ok(updates);
        }
        let location = match stands {
            Some(location) => Ok(location),
            None => self.location(target, state, zeta),
        };
        let update = location.map_err(Stop::from).and_then(|location| self.update(location, value, state));
        join(updates, update)
    }

    /// A rule value is called by value.
    fn run_value(&mut self, rule: Value, arguments: &[Term], state: &State, zeta: &Assignment) -> Yield {
        let Value::Rule(id) = rule else { return Err(Fault::NotARule(rule).into()) };
        let rule = self.model.rule(id);
        if rule.parameters.len() != arguments.len() {
            return Err(Fault::WrongArguments.into());
        }
        let values = self.values(arguments, state, zeta)?;
        let inner = zeta.parameters(&rule.parameters, values);
        if rule.turbo {
            return Ok(self.turbo(id, state, &inner)?);
        }
        self.call(|this| this.yields(&rule.body, state, &inner))
    }

    fn iterate(&mut self, condition: Option<&Term>, body: &RuleNode, state: &State, zeta: &Assignment) -> Yield {
        let mut updates = UpdateSet::empty();
        loop {
            let state = state.fire(&updates);
            if !condition.map_or(Ok(true), |condition| self.guard(condition, &state, zeta))? {
                return Ok(updates);
            }
            let round = consistent(self.yields(body, &state, zeta))?;
            if round.is_empty() {
                return Ok(updates);
            }
            self.round()?;
            updates = updates.then(round);
        }
    }

    fn recursive_while(&mut self, condition: &Term, body: &RuleNode, state: &State, zeta: &Assignment) -> Yield {
        let mut updates = UpdateSet::empty();
        loop {
            let state = state.fire(&updates);
            if !self.guard(condition, &state, zeta)? {
                return Ok(updates);
            }
            updates = updates.then(consistent(self.yields(body, &state, zeta))?);
            self.round()?;
        }
    }
}

fn bind(zeta: &Assignment, binders: &[Binder], values: Vec<Value>) -> Assignment {
    binders.iter().zip(values).fold(zeta.clone(), |zeta, (binder, value)| zeta.with(binder.variable, value))
}
