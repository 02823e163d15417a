//! Terms → values, in the current (intermediate) state (Börger & Stärk 2003, definition 2.4.10).
//!
//! `and`, `or`, `not`, `implies` are Kleene's. They evaluate from the left, and the right operand only if it matters.
//! Equality is total. Every other operation on undef is a fault, and so is a guard that is undef.

use std::ops::ControlFlow;
use std::sync::Arc;

use program::{
    BinderList, Builtin, CollectionKind, DomainKind, FunctionId, Literal, Quantifier, Term, TermId, TermList,
};
use syntax::Span;

use crate::execute::{Executor, Outcome};
use crate::fault::FaultKind;
use crate::value::{Real, Value};

impl<'a> Executor<'a> {
    /// The value of a term. What most terms are stands here; the rest in [`Executor::evaluate_other`], so that
    /// this stays small.
    pub fn evaluate(&mut self, id: TermId) -> Outcome<Value> {
        let program = self.program;
        match program.term(id) {
            Term::Constant(index) => Ok(self.core.constants[*index as usize].clone()),
            Term::Slot(slot) => Ok(self.slot(*slot).clone()),
            Term::Read { function, arguments } => self.evaluate_read(*function, *arguments, id),
            Term::Define { function, arguments } => self.evaluate_definition(*function, *arguments, id),
            Term::Builtin { builtin, arguments } => self.evaluate_builtin(*builtin, program.term_list(*arguments), id),
            Term::If { branches, otherwise } => {
                for branch in program.term_list(*branches).chunks_exact(2) {
                    if self.holds(branch[0])? {
                        return self.evaluate(branch[1]);
                    }
                }
                otherwise.map_or(Ok(Value::Undef), |otherwise| self.evaluate(otherwise))
            }
            _ => self.evaluate_other(id),
        }
    }

    #[inline(never)]
    fn evaluate_other(&mut self, id: TermId) -> Outcome<Value> {
        let program = self.program;
        match program.term(id) {
            Term::Domain(domain) => {
                let elements = self.listed(*domain, program.term_span(id))?;
                Ok(Value::Set(elements))
            }
            Term::Tuple(components) => {
                let components = self.evaluate_all(*components)?;
                self.made(Value::tuple(components), program.term_span(id))
            }
            Term::Project { tuple, index } => match self.evaluate(*tuple)? {
                Value::Tuple(components) => Ok(components[*index as usize].clone()),
                _ => self.undefined_operand("taking a component", program.term_span(id)),
            },
            Term::Collection { kind, elements } => {
                let elements = self.evaluate_all(*elements)?;
                self.made(collection(*kind, elements), program.term_span(id))
            }
            Term::Range { kind, low, high, step } => {
                let (low, high) = (self.evaluate(*low)?, self.evaluate(*high)?);
                let step = step.map(|step| self.evaluate(step)).transpose()?;
                let elements = self.range(&low, &high, step.as_ref(), program.term_span(id))?;
                self.made(collection(*kind, elements), program.term_span(id))
            }
            Term::Comprehension { kind, binders, condition, body } => {
                self.evaluate_comprehension(*kind, *binders, *condition, *body)
            }
            Term::Quantified { quantifier, binders, condition } => {
                self.evaluate_quantified(*quantifier, *binders, *condition)
            }
            Term::Switch { subject, cases, otherwise } => {
                let subject = self.evaluate(*subject)?;
                for case in program.term_list(*cases).chunks_exact(2) {
                    if self.evaluate(case[0])? == subject {
                        return self.evaluate(case[1]);
                    }
                }
                otherwise.map_or(Ok(Value::Undef), |otherwise| self.evaluate(otherwise))
            }
            Term::Let { slot, value, body } => {
                let value = self.evaluate(*value)?;
                self.bind(*slot, value);
                self.evaluate(*body)
            }
            Term::Rule(procedure) => Ok(Value::Rule(*procedure)),
            Term::Unbound => self.fault(program.term_span(id), FaultKind::Unbound),
            Term::Missing(function) => {
                self.fault(program.term_span(id), FaultKind::NoDefinition { function: *function })
            }
            Term::Coerce(operand) => {
                let value = self.evaluate(*operand)?;
                Ok(self.coerce(value, &program.domain(program.term_domain(id)).kind))
            }
            Term::Constant(_)
            | Term::Slot(_)
            | Term::Read { .. }
            | Term::Define { .. }
            | Term::Builtin { .. }
            | Term::If { .. } => self.evaluate(id),
        }
    }

    /// The truth of a guard; a fault where it is undef.
    #[inline]
    pub fn holds(&mut self, id: TermId) -> Outcome<bool> {
        match self.evaluate(id)? {
            Value::Boolean(truth) => Ok(truth),
            _ => self.fault(self.program.term_span(id), FaultKind::UndefinedGuard),
        }
    }

    /// The values of a list of terms.
    pub fn evaluate_all(&mut self, list: TermList) -> Outcome<Vec<Value>> {
        self.program.term_list(list).iter().map(|term| self.evaluate(*term)).collect()
    }

    /// Puts the values of a list of terms on the frame stack; gives where they start.
    #[inline]
    pub fn gather(&mut self, list: TermList) -> Outcome<usize> {
        let start = self.core.frames.len();
        for term in self.program.term_list(list) {
            let value = self.evaluate(*term)?;
            self.core.frames.push(value);
        }
        Ok(start)
    }

    fn evaluate_read(&mut self, function: FunctionId, arguments: TermList, id: TermId) -> Outcome<Value> {
        if self.core.plain[function.0 as usize] {
            if let [argument] = self.program.term_list(arguments) {
                let argument = self.evaluate(*argument)?;
                return self.read_plain(function, std::slice::from_ref(&argument), id);
            }
            let start = self.gather(arguments)?;
            if let Some(index) = self.core.store.find(function, &self.core.frames[start..])
                && !self.core.store.values[index as usize].is_undef()
            {
                self.core.frames.truncate(start);
                return Ok(self.core.store.values[index as usize].clone());
            }
            let arguments: Vec<Value> = self.core.frames.drain(start..).collect();
            return self.read_plain(function, &arguments, id);
        }
        let start = self.gather(arguments)?;
        let arguments: Vec<Value> = self.core.frames.drain(start..).collect();
        if self.core.observations.is_some() {
            self.core.note_read(function, &arguments);
        }
        self.read(function, &arguments, self.program.term_span(id))
    }

    /// A location that is not an input. If it is undef, its initial value may not have been evaluated yet.
    #[inline]
    fn read_plain(&mut self, function: FunctionId, arguments: &[Value], id: TermId) -> Outcome<Value> {
        let found = self.core.store.find(function, arguments);
        let value = found.map_or(Value::Undef, |index| self.core.store.values[index as usize].clone());
        if value.is_undef() && self.core.initials[function.0 as usize].is_some() {
            return self.read_initial(function, arguments, self.program.term_span(id));
        }
        Ok(value)
    }

    fn evaluate_definition(&mut self, function: FunctionId, arguments: TermList, id: TermId) -> Outcome<Value> {
        let program = self.program;
        let (start, place) = match program.term_list(arguments) {
            // A single argument can be looked up without being put on the stack.
            [argument] => {
                let argument = self.evaluate(*argument)?;
                let place = self.core.memo.place(function, std::slice::from_ref(&argument));
                if let Some(value) = place.and_then(|place| self.core.memo.get(place)) {
                    return Ok(value.clone());
                }
                self.core.frames.push(argument);
                (self.core.frames.len() - 1, place)
            }
            _ => {
                let start = self.gather(arguments)?;
                let place = self.core.memo.place(function, &self.core.frames[start..]);
                if let Some(value) = place.and_then(|place| self.core.memo.get(place)) {
                    let value = value.clone();
                    self.core.frames.truncate(start);
                    return Ok(value);
                }
                (start, place)
            }
        };
        let Some(definition) = &program.functions[function.0 as usize].definition else {
            self.core.frames.truncate(start);
            return Ok(Value::Undef);
        };
        let span = program.term_span(id);
        let value = self.in_frame(start, definition.frame, span, |this| this.evaluate(definition.body))?;
        if let Some(place) = place {
            self.core.memo.keep(place, value.clone());
        }
        Ok(value)
    }

    fn evaluate_comprehension(
        &mut self,
        kind: CollectionKind,
        binders: BinderList,
        condition: Option<TermId>,
        body: TermId,
    ) -> Outcome<Value> {
        let program = self.program;
        let mut elements = Vec::new();
        // Sorting compares shared parts again and again, so the size is checked against the limit before.
        let mut leaves = 0u64;
        let _ = self.for_each_binding(program.binder_list(binders), &mut |this| {
            if match condition {
                Some(condition) => this.holds(condition)?,
                None => true,
            } {
                let element = this.evaluate(body)?;
                leaves = leaves.saturating_add(element.weight().leaves);
                elements.push(element);
                this.check_size(leaves, program.term_span(body))?;
            }
            Ok(ControlFlow::Continue(()))
        })?;
        self.made(collection(kind, elements), program.term_span(body))
    }

    /// A value that was made, within the limits of size.
    #[inline]
    pub fn made(&mut self, value: Value, span: Span) -> Outcome<Value> {
        self.check_made(&value, span)?;
        Ok(value)
    }

    fn evaluate_quantified(
        &mut self,
        quantifier: Quantifier,
        binders: BinderList,
        condition: Option<TermId>,
    ) -> Outcome<Value> {
        let program = self.program;
        let (mut satisfied, mut refuted) = (0u64, false);
        let binders = program.binder_list(binders);
        // Whether there is a fault must not depend on which element comes first.
        let looks_at_all = binders.iter().any(|binder| self.is_unordered(binder.range));
        let _ = self.for_each_binding(binders, &mut |this| {
            let holds = match condition {
                Some(condition) => this.holds(condition)?,
                None => true,
            };
            satisfied += u64::from(holds);
            refuted |= !holds;
            let decided = match quantifier {
                Quantifier::Forall => refuted,
                Quantifier::Exists => satisfied > 0,
                Quantifier::ExistsUnique => satisfied > 1,
            };
            Ok(if decided && !looks_at_all { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
        })?;
        Ok(Value::Boolean(match quantifier {
            Quantifier::Forall => !refuted,
            Quantifier::Exists => satisfied > 0,
            Quantifier::ExistsUnique => satisfied == 1,
        }))
    }

    /// The connectives, which do not evaluate all their operands; every other builtin is applied to values.
    fn evaluate_builtin(&mut self, builtin: Builtin, arguments: &'a [TermId], id: TermId) -> Outcome<Value> {
        use Value::{Boolean, Integer};
        if self.core.in_pieces
            && let Some(value) = self.evaluate_piece(builtin, arguments, id)?
        {
            return Ok(value);
        }
        match (builtin, arguments) {
            (Builtin::And | Builtin::Or, [left, right]) => self.and_or(builtin, *left, *right, Self::evaluate),
            (Builtin::Implies, [premise, conclusion]) => self.implication(*premise, *conclusion, Self::evaluate),
            (Builtin::Pre, [term]) => self.evaluate_before(*term),
            (_, [left, right]) => {
                let left = self.evaluate(*left)?;
                let right = self.evaluate(*right)?;
                // Most models spend their time in these operations.
                match (builtin, &left, &right) {
                    (Builtin::Eq | Builtin::Neq, a, b) => {
                        self.work_of_comparing(a, b, self.program.term_span(id))?;
                        return Ok(Boolean((a == b) == (builtin == Builtin::Eq)));
                    }
                    (Builtin::Lt, Integer(a), Integer(b)) => return Ok(Boolean(a < b)),
                    (Builtin::Le, Integer(a), Integer(b)) => return Ok(Boolean(a <= b)),
                    (Builtin::Gt, Integer(a), Integer(b)) => return Ok(Boolean(a > b)),
                    (Builtin::Ge, Integer(a), Integer(b)) => return Ok(Boolean(a >= b)),
                    (Builtin::IntAdd, Integer(a), Integer(b)) => {
                        if let Some(sum) = a.checked_add(*b) {
                            return Ok(Integer(sum));
                        }
                    }
                    (Builtin::IntSub, Integer(a), Integer(b)) => {
                        if let Some(difference) = a.checked_sub(*b) {
                            return Ok(Integer(difference));
                        }
                    }
                    _ => {}
                }
                self.apply(builtin, &[left, right], id)
            }
            (_, [operand]) => match (builtin, self.evaluate(*operand)?) {
                (Builtin::Not, Boolean(truth)) => Ok(Boolean(!truth)),
                (Builtin::IsUndef, operand) => Ok(Boolean(operand.is_undef())),
                (Builtin::IsDef, operand) => Ok(Boolean(!operand.is_undef())),
                (_, operand) => self.apply(builtin, &[operand], id),
            },
            _ => {
                let operands: Vec<Value> = arguments.iter().map(|term| self.evaluate(*term)).collect::<Outcome<_>>()?;
                self.apply(builtin, &operands, id)
            }
        }
    }

    /// Kleene's `and` and `or`; `evaluate` evaluates an operand.
    #[inline]
    pub fn and_or(
        &mut self,
        builtin: Builtin,
        left: TermId,
        right: TermId,
        evaluate: impl Fn(&mut Self, TermId) -> Outcome<Value>,
    ) -> Outcome<Value> {
        let deciding = Value::Boolean(builtin == Builtin::Or);
        let left = evaluate(self, left)?;
        if left == deciding {
            return Ok(left);
        }
        let right = evaluate(self, right)?;
        Ok(if right == deciding || !left.is_undef() { right } else { left })
    }

    /// Kleene's implication: `false` implies anything, anything implies `true`.
    #[inline]
    pub fn implication(
        &mut self,
        premise: TermId,
        conclusion: TermId,
        evaluate: impl Fn(&mut Self, TermId) -> Outcome<Value>,
    ) -> Outcome<Value> {
        let premise = evaluate(self, premise)?;
        if premise == Value::Boolean(false) {
            return Ok(Value::Boolean(true));
        }
        let conclusion = evaluate(self, conclusion)?;
        Ok(match (premise, conclusion) {
            (_, Value::Boolean(true)) => Value::Boolean(true),
            (Value::Boolean(true), conclusion) => conclusion,
            _ => Value::Undef,
        })
    }

    /// `pre(t)`: the value of a term in the state before the step.
    fn evaluate_before(&mut self, term: TermId) -> Outcome<Value> {
        if self.core.updates.shows_original() {
            return self.evaluate(term);
        }
        let version = self.core.memo.version();
        self.core.memo.changed();
        self.core.updates.swap_original(&mut self.core.store, false);
        let value = self.evaluate(term);
        self.core.updates.swap_original(&mut self.core.store, true);
        self.core.memo.back_to(version);
        value
    }

    fn coerce(&self, value: Value, to: &DomainKind) -> Value {
        let complex = matches!(to, DomainKind::Basic(model::Basic::Complex));
        match value {
            Value::Integer(n) if complex => complex_of(n as f64),
            Value::Real(r) if complex => complex_of(r.get()),
            Value::Integer(n) => Value::Real(Real::new(n as f64).expect("an integer is a number")),
            other => other,
        }
    }

    fn range(&mut self, low: &Value, high: &Value, step: Option<&Value>, span: Span) -> Outcome<Vec<Value>> {
        let one = Value::Integer(1);
        match (low, high, step.unwrap_or(&one)) {
            (Value::Integer(low), Value::Integer(high), Value::Integer(step)) => {
                if *step <= 0 {
                    return self
                        .fault(span, FaultKind::BadOperand { reason: format!("the step {step} is not positive") });
                }
                let size = (i128::from(*high) - i128::from(*low)).max(-1) / i128::from(*step) + 1;
                if low > high {
                    return Ok(Vec::new());
                }
                self.check_size(u64::try_from(size).unwrap_or(u64::MAX), span)?;
                Ok((0..size as i64).map(|i| Value::Integer(low + i * step)).collect())
            }
            (Value::Real(low), Value::Real(high), step) => {
                let step = match step {
                    Value::Real(step) => step.get(),
                    Value::Integer(step) => *step as f64,
                    _ => return self.undefined_operand("a range", span),
                };
                self.real_range(low.get(), high.get(), step, span)
            }
            (Value::Undef, ..) | (_, Value::Undef, _) | (.., Value::Undef) => self.undefined_operand("a range", span),
            _ => self
                .fault(span, FaultKind::BadOperand { reason: "the bounds of a range are numbers of one kind".into() }),
        }
    }

    /// `low`, `low + step`, … each rounded to the decimals of `low` and `step`, so that 0.1 steps stay exact.
    fn real_range(&mut self, low: f64, high: f64, step: f64, span: Span) -> Outcome<Vec<Value>> {
        if step <= 0.0 {
            return self.fault(span, FaultKind::BadOperand { reason: format!("the step {step:?} is not positive") });
        }
        let decimals = |x: f64| format!("{x}").split_once('.').map_or(0, |(_, fraction)| fraction.len()).min(15) as i32;
        let scale = 10f64.powi(decimals(low).max(decimals(step)));
        let size = (((high - low) / step) * (1.0 + 1e-12) + 1e-9).floor();
        if size < 0.0 {
            return Ok(Vec::new());
        }
        self.check_size(size as u64, span)?;
        let number = |i: u64| ((low + i as f64 * step) * scale).round() / scale;
        Ok((0..=size as u64).filter_map(|i| Real::new(number(i)).map(Value::Real)).collect())
    }

    /// The fault of an operation on undef.
    #[cold]
    pub fn undefined_operand<T>(&self, operation: &str, span: Span) -> Outcome<T> {
        self.fault(span, FaultKind::UndefinedOperand { operation: operation.to_string() })
    }
}

fn complex_of(re: f64) -> Value {
    let part = |x| Real::new(x).expect("a coerced number is a number");
    Value::Complex(Arc::new((part(re), part(0.0))))
}

/// The value of a literal.
pub(crate) fn constant(literal: &Literal) -> Value {
    match literal {
        Literal::Undef => Value::Undef,
        Literal::Boolean(b) => Value::Boolean(*b),
        Literal::Integer(n) => Value::Integer(*n),
        Literal::Real(r) => Real::new(*r).map_or(Value::Undef, Value::Real),
        Literal::Complex(re, im) => match (Real::new(*re), Real::new(*im)) {
            (Some(re), Some(im)) => Value::Complex(Arc::new((re, im))),
            _ => Value::Undef,
        },
        Literal::Char(c) => Value::Char(*c),
        Literal::String(text) => Value::string(text.as_str()),
        Literal::Enum(domain, index) => Value::Enum(*domain, *index),
    }
}

/// A collection of a kind; the elements of a map are pairs.
pub(crate) fn collection(kind: CollectionKind, elements: Vec<Value>) -> Value {
    match kind {
        CollectionKind::Set => Value::set(elements),
        CollectionKind::Seq => Value::seq(elements),
        CollectionKind::Bag => Value::bag(elements),
        CollectionKind::Map => Value::map(elements.into_iter().filter_map(|pair| match pair {
            Value::Tuple(parts) if parts.len() == 2 => Some((parts[0].clone(), parts[1].clone())),
            _ => None,
        })),
    }
}
