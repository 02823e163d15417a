//! The value ⟦t⟧ of a term in a state 𝔄 under an assignment ζ (Börger & Stärk 2003, definitions 2.4.9 and 2.4.10),
//! one case a kind of term.
//!
//! A term that has no value is a fault. Operands are evaluated from left to right; `and`, `or`, `implies` and the
//! quantifiers stop as soon as they are decided, which only a fault or an input not asked for can show.

use std::ops::ControlFlow;

use model::{
    Binder, CollectionKind, DomainId, DomainKind, Domains, Function, FunctionId, FunctionKind, Literal, Quantifier,
    Term, TermKind,
};

use crate::builtin;
use crate::environment::Tick;
use crate::fault::Fault;
use crate::interpreter::{Assignment, Interpreter};
use crate::state::{Location, State, Symbol};
use crate::value::{Double, Value};

/// What is done under each assignment.
type Visitor<'v, I> = dyn FnMut(&mut I, &Assignment) -> Result<ControlFlow<()>, Fault> + 'v;

impl Interpreter<'_> {
    /// ⟦t⟧.
    pub fn value(&mut self, term: &Term, state: &State, zeta: &Assignment) -> Result<Value, Fault> {
        match &term.kind {
            TermKind::Literal(literal) => Ok(constant(literal)),
            // ⟦x⟧ = ζ(x)
            TermKind::Variable(variable) => Ok(zeta.get(*variable)),
            // ⟦f(t₁,…,tₙ)⟧ = f^𝔄(⟦t₁⟧,…,⟦tₙ⟧)
            TermKind::Apply { function, arguments } => self.apply(*function, arguments, term.domain, state, zeta),
            TermKind::Domain(domain) => Ok(Value::Set(self.elements(*domain, state)?.into_iter().collect())),
            TermKind::Tuple(parts) => Ok(Value::Tuple(self.values(parts, state, zeta)?)),
            TermKind::Project { tuple, index } => match self.value(tuple, state, zeta)? {
                Value::Tuple(parts) => Ok(parts[*index as usize].clone()),
                _ => Err(Fault::UndefinedOperand("projection".to_string())),
            },
            TermKind::Collection { kind, elements } => Ok(collection(*kind, self.values(elements, state, zeta)?)),
            TermKind::Range { kind, low, high, step } => {
                let low = self.value(low, state, zeta)?;
                let high = self.value(high, state, zeta)?;
                let step = step.as_ref().map(|step| self.value(step, state, zeta)).transpose()?;
                Ok(collection(*kind, builtin::range(&low, &high, step.as_ref(), self.bounds.elements)?))
            }
            // { t | x₁ ∈ s₁, …, xₙ ∈ sₙ, φ }
            TermKind::Comprehension { kind, binders, condition, body } => {
                let mut elements = Vec::new();
                let _ = self.each(binders, state, zeta, &mut |this, zeta| {
                    if condition.as_ref().map_or(Ok(true), |condition| this.guard(condition, state, zeta))? {
                        elements.push(this.value(body, state, zeta)?);
                    }
                    Ok(ControlFlow::Continue(()))
                })?;
                Ok(collection(*kind, elements))
            }
            TermKind::Quantified { quantifier, binders, condition } => {
                self.quantified(*quantifier, binders, condition.as_deref(), state, zeta)
            }
            TermKind::If { branches, otherwise } => {
                for (guard, then) in branches {
                    if self.guard(guard, state, zeta)? {
                        return self.value(then, state, zeta);
                    }
                }
                self.value_or_undef(otherwise.as_deref(), state, zeta)
            }
            TermKind::Switch { subject, cases, otherwise } => {
                let subject = self.value(subject, state, zeta)?;
                for (case, then) in cases {
                    if self.value(case, state, zeta)? == subject {
                        return self.value(then, state, zeta);
                    }
                }
                self.value_or_undef(otherwise.as_deref(), state, zeta)
            }
            // ⟦let x = s in t⟧ζ = ⟦t⟧ζ[x ↦ ⟦s⟧ζ]
            TermKind::Let { bindings, body } => {
                let mut zeta = zeta.clone();
                for (variable, term) in bindings {
                    let value = self.value(term, state, &zeta)?;
                    zeta = zeta.with(*variable, value);
                }
                self.value(body, state, &zeta)
            }
            TermKind::Rule(rule) => Ok(Value::Rule(*rule)),
            TermKind::Coerce(inner) => {
                Ok(builtin::coerce(self.value(inner, state, zeta)?, term.domain == Domains::COMPLEX))
            }
            TermKind::Unbound(_) => Err(Fault::Unbound),
            TermKind::Error => panic!("the oracle runs models without faults only"),
        }
    }

    /// ⟦t₁⟧, …, ⟦tₙ⟧.
    pub fn values(&mut self, terms: &[Term], state: &State, zeta: &Assignment) -> Result<Vec<Value>, Fault> {
        terms.iter().map(|term| self.value(term, state, zeta)).collect()
    }

    /// A formula that must be true or false for the rule or term.
    pub fn guard(&mut self, formula: &Term, state: &State, zeta: &Assignment) -> Result<bool, Fault> {
        match self.value(formula, state, zeta)? {
            Value::Boolean(truth) => Ok(truth),
            _ => Err(Fault::UndefinedGuard),
        }
    }

    fn value_or_undef(&mut self, term: Option<&Term>, state: &State, zeta: &Assignment) -> Result<Value, Fault> {
        term.map_or(Ok(Value::Undef), |term| self.value(term, state, zeta))
    }

    fn apply(
        &mut self,
        id: FunctionId,
        terms: &[Term],
        domain: DomainId,
        state: &State,
        zeta: &Assignment,
    ) -> Result<Value, Fault> {
        let function = self.model.function(id);
        if let Some(definition) = &function.definition {
            let values = self.values(terms, state, zeta)?;
            let inner = zeta.parameters(&definition.parameters, values);
            return self.call(|this| this.value(&definition.body, state, &inner));
        }
        if function.library
            && function.parameters.is_empty()
            && function.name == "self"
            && let Some(agent) = &zeta.agent
        {
            return Ok(agent.clone());
        }
        if function.library
            && function.name == "result"
            && let Some(location) = &zeta.result
        {
            return self.read(location.clone(), state);
        }
        if matches!(function.kind, FunctionKind::Static | FunctionKind::Derived) {
            return match function.library {
                true => self.library(function, terms, domain, state, zeta),
                false => self.element(id).ok_or(Fault::NoDefinition),
            };
        }
        let values = self.values(terms, state, zeta)?;
        self.read(Location::function(id, values), state)
    }

    fn library(
        &mut self,
        function: &Function,
        terms: &[Term],
        domain: DomainId,
        state: &State,
        zeta: &Assignment,
    ) -> Result<Value, Fault> {
        let name = function.name.as_str();
        match (name, terms) {
            ("and" | "or" | "implies", [left, right]) => {
                let left = self.value(left, state, zeta)?;
                if let Some(decided) = builtin::decided_by_left(name, &left) {
                    return Ok(decided);
                }
                let right = self.value(right, state, zeta)?;
                return Ok(builtin::connective(name, &left, &right));
            }
            ("pre", [term]) => {
                let before = self.before.clone();
                return self.value(term, &before, zeta);
            }
            _ => {}
        }
        let values = self.values(terms, state, zeta)?;
        // A library function is defined on its parameters' domains, and undef is in none of these. A type variable
        // stands for any value, undef included.
        for (parameter, value) in function.parameters.iter().zip(&values) {
            let any = matches!(self.model.domains.kind(*parameter), DomainKind::Any);
            if value.is_undef() && !any && !TOTAL.contains(&name) {
                return Err(Fault::UndefinedOperand(name.to_string()));
            }
        }
        match (name, values.as_slice()) {
            ("program", [agent]) => Ok(self.program_of(agent, state)?.map_or(Value::Undef, Value::Rule)),
            ("chooseone", [Value::Set(elements)]) => match elements.is_empty() {
                true => Ok(Value::Undef),
                false => Ok(self.choose(elements.iter().map(|element| vec![element.clone()]).collect())?.remove(0)),
            },
            ("currTimeNanosecs", []) => self.time(Tick::Nanoseconds),
            ("currTimeMillisecs", []) => self.time(Tick::Milliseconds),
            ("currTimeSecs", []) => self.time(Tick::Seconds),
            (_, values) => builtin::apply(self.model, function, domain, values),
        }
    }

    /// The clock, which stands still during a step.
    fn time(&mut self, unit: Tick) -> Result<Value, Fault> {
        if let Some((_, time)) = self.clock.iter().find(|(known, _)| *known == unit) {
            return Ok(Value::Integer(*time));
        }
        let time = self.environment.time(unit).map_err(Fault::Environment)?;
        self.clock.push((unit, time));
        Ok(Value::Integer(time))
    }

    /// The content of a location. The environment gives that of a monitored one, once a step whatever the substate, and
    /// that of a shared one that has none yet.
    pub(crate) fn read(&mut self, location: Location, state: &State) -> Result<Value, Fault> {
        let Symbol::Function(id) = location.symbol else { return Ok(state.get(&location)) };
        if let Some(value) = self.initial_value(id, &location, state)? {
            return Ok(value);
        }
        if !state.has(&location)
            && let Some(value) = self.late_initial_value(id, &location)?
        {
            return Ok(value);
        }
        let asked = match self.model.function(id).kind {
            FunctionKind::Monitored => true,
            FunctionKind::Shared => !state.has(&location),
            _ => false,
        };
        if !asked {
            return Ok(state.get(&location));
        }
        if let Some(value) = self.inputs.get(&location) {
            return Ok(value.clone());
        }
        let value = self.environment.monitored(self.model, &location).map_err(Fault::Environment)?;
        self.inputs.insert(location, value.clone());
        Ok(value)
    }

    /// All ζ[x₁ ↦ a₁]…[xₙ ↦ aₙ] with aᵢ in the range of xᵢ, the leftmost slowest, until the visitor stops.
    pub fn each(
        &mut self,
        binders: &[Binder],
        state: &State,
        zeta: &Assignment,
        visit: &mut Visitor<'_, Self>,
    ) -> Result<ControlFlow<()>, Fault> {
        let Some((binder, rest)) = binders.split_first() else { return visit(self, zeta) };
        for value in self.range(&binder.range, state, zeta)? {
            if self.each(rest, state, &zeta.with(binder.variable, value), visit)?.is_break() {
                return Ok(ControlFlow::Break(()));
            }
        }
        Ok(ControlFlow::Continue(()))
    }

    /// range(x, φ, 𝔄, ζ) of table 2.2, as assignments: those for which the condition holds.
    pub fn satisfying(
        &mut self,
        binders: &[Binder],
        condition: Option<&Term>,
        state: &State,
        zeta: &Assignment,
    ) -> Result<Vec<Assignment>, Fault> {
        let mut found = Vec::new();
        let _ = self.each(binders, state, zeta, &mut |this, zeta| {
            if condition.map_or(Ok(true), |condition| this.guard(condition, state, zeta))? {
                found.push(zeta.clone());
            }
            Ok(ControlFlow::Continue(()))
        })?;
        Ok(found)
    }

    fn range(&mut self, range: &Term, state: &State, zeta: &Assignment) -> Result<Vec<Value>, Fault> {
        if let TermKind::Domain(domain) = &range.kind {
            return self.elements(*domain, state);
        }
        let value = self.value(range, state, zeta)?;
        value.elements().ok_or_else(|| Fault::UndefinedOperand("range".to_string()))
    }

    /// (∀x ∈ s) φ, (∃x ∈ s) φ, (∃!x ∈ s) φ (definition 2.4.10).
    fn quantified(
        &mut self,
        quantifier: Quantifier,
        binders: &[Binder],
        condition: Option<&Term>,
        state: &State,
        zeta: &Assignment,
    ) -> Result<Value, Fault> {
        let (mut witnesses, mut counterexamples) = (0, 0);
        let _ = self.each(binders, state, zeta, &mut |this, zeta| {
            match condition.map_or(Ok(true), |condition| this.guard(condition, state, zeta))? {
                true => witnesses += 1,
                false => counterexamples += 1,
            }
            let decided = match quantifier {
                Quantifier::Forall => counterexamples > 0,
                Quantifier::Exists => witnesses > 0,
                Quantifier::ExistsUnique => witnesses > 1,
            };
            Ok(if decided { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
        })?;
        Ok(Value::Boolean(match quantifier {
            Quantifier::Forall => counterexamples == 0,
            Quantifier::Exists => witnesses > 0,
            Quantifier::ExistsUnique => witnesses == 1,
        }))
    }
}

/// The library functions that take undef as an argument like any other value.
const TOTAL: [&str; 10] =
    ["eq", "neq", "equality", "isDef", "isUndef", "not", "toString", "print", "program", "getAgent"];

fn constant(literal: &Literal) -> Value {
    let double = |number: f64| Double::new(number).expect("a literal is a number");
    match literal {
        Literal::Undef => Value::Undef,
        Literal::Boolean(truth) => Value::Boolean(*truth),
        Literal::Integer(number) => Value::Integer(*number),
        Literal::Real(number) => Value::Real(double(*number)),
        Literal::Complex(re, im) => Value::Complex(double(*re), double(*im)),
        Literal::Char(char) => Value::Char(*char),
        Literal::String(text) => Value::String(text.clone()),
        Literal::Enum(domain, place) => Value::Literal(*domain, *place),
    }
}

/// A collection of these elements. Those of a map are pairs; of equal keys, the last counts.
fn collection(kind: CollectionKind, elements: Vec<Value>) -> Value {
    match kind {
        CollectionKind::Set => Value::Set(elements.into_iter().collect()),
        CollectionKind::Seq => Value::Seq(elements),
        CollectionKind::Bag => Value::bag(elements),
        CollectionKind::Map => {
            let pairs = elements.into_iter().map(|pair| match pair {
                Value::Tuple(mut parts) if parts.len() == 2 => {
                    let value = parts.pop().expect("two parts");
                    (parts.pop().expect("two parts"), value)
                }
                _ => panic!("the checker has pairs in every map"),
            });
            Value::Map(pairs.collect())
        }
    }
}
